// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "progress.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <utility>

#include "anneal6d/framework/log.h"

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace anneal6d {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBarInterval = std::chrono::milliseconds(100);
constexpr auto kLineInterval = std::chrono::seconds(5);
constexpr std::int64_t kBarWidth = 30;

/// A bar stands on the terminal's last line and must be wiped before anything else is written.
std::atomic<bool> bar_drawn = false;

bool stderr_is_terminal() {
#ifdef _WIN32
  static const bool is_terminal = _isatty(_fileno(stderr)) != 0;
#else
  static const bool is_terminal = isatty(STDERR_FILENO) != 0;
#endif
  return is_terminal;
}

void wipe_bar() {
  if (bar_drawn.exchange(false)) std::fputs("\r\x1b[K", stderr);
}

}  // namespace

Progress::Progress(std::string what, std::optional<std::int64_t> total)
    : what_(std::move(what)), total_(total), shown_(Clock::now()) {}

Progress::~Progress() { wipe_bar(); }

std::string Progress::line(const std::string& note) const {
  std::string text = what_ + ": " + std::to_string(done_);
  if (total_) text += "/" + std::to_string(*total_);
  if (!note.empty()) text += ", " + note;
  return text;
}

void Progress::advance(std::int64_t steps, const std::string& note) {
  const std::lock_guard lock(mutex_);
  done_ += steps;
  const bool terminal = stderr_is_terminal();
  const auto now = Clock::now();
  if (now - shown_ < (terminal ? Clock::duration(kBarInterval) : Clock::duration(kLineInterval))) {
    return;
  }
  shown_ = now;
  if (!terminal) {
    log(LogLevel::info, line(note));
    return;
  }
  std::string bar;
  if (total_ && *total_ > 0) {
    const std::int64_t filled = std::clamp<std::int64_t>(kBarWidth * done_ / *total_, 0, kBarWidth);
    bar = "[" + std::string(static_cast<std::size_t>(filled), '#') +
          std::string(static_cast<std::size_t>(kBarWidth - filled), '.') + "] ";
  }
  std::fprintf(stderr, "\r\x1b[K%s%s", bar.c_str(), line(note).c_str());
  std::fflush(stderr);
  bar_drawn = true;
}

std::function<void(double)> preparation_progress() {
  struct Preparing {
    Progress progress{"preparing the model, percent", 100};
    std::int64_t percent = 0;
  };
  return [preparing = std::shared_ptr<Preparing>()](double share) mutable {
    if (!preparing) preparing = std::make_shared<Preparing>();
    const auto now = static_cast<std::int64_t>(100 * share);
    if (now > preparing->percent) {
      preparing->progress.advance(now - std::exchange(preparing->percent, now));
    }
  };
}

void log_to_stderr() {
  spdlog::set_default_logger(spdlog::stderr_color_mt("anneal6d"));
  spdlog::set_pattern("%^%l%$: %v");
  set_log_sink([](LogLevel level, std::string_view message) {
    constexpr spdlog::level::level_enum kLevels[] = {spdlog::level::debug, spdlog::level::info,
                                                     spdlog::level::warn, spdlog::level::err};
    wipe_bar();
    spdlog::log(kLevels[static_cast<int>(level)], message);
  });
}

}  // namespace anneal6d
