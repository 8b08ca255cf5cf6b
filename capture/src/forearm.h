// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace anneal6d {

/// A forearm in a sleeve that stands in the picture from below and sweeps to and fro sideways.
struct Forearm {
  double radius_px = 0;
  double speed_px = 0;  ///< a frame
  std::uint64_t seed = 1;
};

/// Draws the forearm as it stands in frame `index` over `image`, CV_8UC3.
void draw_forearm(const Forearm& forearm, std::int64_t index, cv::Mat& image);

}  // namespace anneal6d
