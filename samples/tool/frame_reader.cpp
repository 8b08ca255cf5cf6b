// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "frame_reader.h"

#include <string>
#include <utility>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"

namespace anneal6d {

FrameReader::FrameReader(FrameSource& source, std::int64_t start, std::int64_t stride,
                         std::optional<std::int64_t> frames)
    : source_(&source), to_skip_(start), stride_(stride), left_(frames) {}

std::optional<Frame> FrameReader::next() {
  while (!left_ || *left_ > 0) {
    const std::int64_t to_skip = std::exchange(to_skip_, stride_ - 1);
    if (left_) --*left_;
    try {
      if (source_->skip(to_skip) < to_skip) return std::nullopt;
      std::optional<Frame> frame = source_->next();
      if (frame) started_ = true;
      return frame;
    } catch (const FileError& error) {
      if (!started_) throw;
      ++broken_;
      log(LogLevel::warning, std::string(error.what()) + "; the frame is left out");
    }
  }
  return std::nullopt;
}

}  // namespace anneal6d
