// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "image_pool.h"

namespace anneal6d::dc1394 {
namespace {

// Who holds more frames than this pays for further ones.
constexpr std::size_t kMostKept = 16;

// Read as OpenCV writes it, atomically: another thread may just be letting go.
bool is_free(cv::Mat& image) { return CV_XADD(&image.u->refcount, 0) == 1; }

}  // namespace

cv::Mat ImagePool::take(const cv::Size& size, int type) {
  if (!images_.empty() && (images_.front().size() != size || images_.front().type() != type)) {
    images_.clear();
  }
  for (cv::Mat& image : images_) {
    if (is_free(image)) return image;
  }
  cv::Mat image(size, type);
  if (images_.size() < kMostKept) images_.push_back(image);
  return image;
}

}  // namespace anneal6d::dc1394
