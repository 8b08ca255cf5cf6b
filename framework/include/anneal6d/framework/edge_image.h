// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <opencv2/core/mat.hpp>

namespace anneal6d {

/// What the edge detector found in one frame, distortion removed.
struct EdgeImage {
  cv::Mat binary;  ///< CV_8UC1, 255 on an edge, 0 elsewhere
};

}  // namespace anneal6d
