// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace anneal6d::dc1394 {

/// Images that are used again once nobody else holds them, so that a camera that runs for days
/// allocates nothing after its first frames.
class ImagePool {
 public:
  /// An image of this size and type; its content is arbitrary.
  cv::Mat take(const cv::Size& size, int type);
  std::size_t size() const { return images_.size(); }

 private:
  std::vector<cv::Mat> images_;
};

}  // namespace anneal6d::dc1394
