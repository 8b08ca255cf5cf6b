// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace anneal6d {

/// One image and where it comes from.
struct Frame {
  cv::Mat image;                 ///< CV_8UC1 (grey) or CV_8UC3 (BGR), as captured (distorted)
  std::int64_t index = 0;        ///< position in the source, from 0; for a sequence, of the file
  double timestamp_s = 0;        ///< seconds since the source's first frame
  std::int64_t lost_before = 0;  ///< frames the source lost between the previous one and this
};

}  // namespace anneal6d
