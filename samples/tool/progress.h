// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace anneal6d {

/// Shows how far long work has come: a bar on a terminal, a plain line every few seconds elsewhere;
/// on stderr either way. At most one at a time. Thread safe.
class Progress {
 public:
  /// `what` is a word or two: "tracking". Without a total, only counts are shown.
  Progress(std::string what, std::optional<std::int64_t> total);
  /// Ends the bar's line, if one was drawn.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `note` is shown behind the count ("quality 0.83").
  void advance(std::int64_t steps = 1, const std::string& note = {});

 private:
  std::string line(const std::string& note) const;

  std::mutex mutex_;
  std::string what_;
  std::optional<std::int64_t> total_;
  std::int64_t done_ = 0;
  std::chrono::steady_clock::time_point shown_;
};

/// For whatever prepares a model and tells the share done (0..1): shows it from the first news on.
std::function<void(double)> preparation_progress();

/// Sends the library's log to stderr ("warning: ..."), also while a bar is drawn there.
void log_to_stderr();

}  // namespace anneal6d
