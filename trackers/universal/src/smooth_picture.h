// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "line_kernels.h"

namespace anneal6d {

/// A picture that blur_rows() blurred, CV_8UC1 or CV_8UC3, and where its first pixel lies in the
/// image.
struct SmoothPicture {
  const cv::Mat& smooth;
  cv::Point origin;
};

/// Lines of which nothing but the picture is known yet.
inline LineJob lines_through(const cv::Mat& smooth, int reach_px) {
  LineJob job{};
  job.data = smooth.ptr<std::uint8_t>();
  job.stride = static_cast<std::ptrdiff_t>(smooth.step[0]);
  job.columns = smooth.cols;
  job.rows = smooth.rows;
  job.channels = smooth.channels();
  job.reach_px = reach_px;
  return job;
}

}  // namespace anneal6d
