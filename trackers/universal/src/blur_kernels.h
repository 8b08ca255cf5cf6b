// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <opencv2/core/mat.hpp>

namespace anneal6d {

/// Blurs `window` of an image of 8 bits a channel by a Gaussian of sigma 1 px, cut off at 2 px,
/// into `smooth`, which has the window's size; of it only the rows from `from_row` to `to_row`
/// (exclusive) are written. Pixels around the window count; beyond the image's border it goes on as
/// at the border. As OpenCV's GaussianBlur, to a grey level, in a fifth of its time.
void blur_rows(const cv::Mat& image, const cv::Rect& window, int from_row, int to_row,
               cv::Mat& smooth);

}  // namespace anneal6d
