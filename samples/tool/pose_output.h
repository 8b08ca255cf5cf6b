// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <optional>
#include <string>

#include "anneal6d/framework/pose_file.h"

namespace anneal6d {

/// Where `track` writes its poses: a file, which appears at the end, or standard output, line by
/// line, for programs that follow along.
class PoseOutput {
 public:
  /// Empty: standard output. Throws FileError.
  explicit PoseOutput(const std::string& path);

  void write(const PoseRow& row);
  void commit();

 private:
  void print(std::string_view line);

  std::optional<PoseWriter> file_;
  bool header_printed_ = false;
};

}  // namespace anneal6d
