// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "pose_output.h"

#include <cstdio>

#include "anneal6d/framework/error.h"

namespace anneal6d {

PoseOutput::PoseOutput(const std::string& path) {
  if (!path.empty()) file_.emplace(path);
}

void PoseOutput::write(const PoseRow& row) {
  if (file_) {
    file_->write(row);
    return;
  }
  if (!header_printed_) print(pose_row_header());
  header_printed_ = true;
  print(to_csv(row));
}

void PoseOutput::commit() {
  if (file_) file_->commit();
}

void PoseOutput::print(std::string_view line) {
  std::fwrite(line.data(), 1, line.size(), stdout);
  std::fputc('\n', stdout);
  if (std::fflush(stdout) != 0) throw Error("standard output cannot be written");
}

}  // namespace anneal6d
