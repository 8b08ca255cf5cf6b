// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/camera_model.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

constexpr int kMinSize_px = 16;
constexpr int kMaxSize_px = 16384;

[[noreturn]] void refuse(const std::string& what) { throw ConfigError("camera: " + what); }

}  // namespace

bool CameraModel::has_distortion() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0; });
}

CameraModel CameraModel::scaled(double factor) const {
  CameraModel result = *this;
  result.width_px = static_cast<int>(std::lround(width_px * factor));
  result.height_px = static_cast<int>(std::lround(height_px * factor));
  result.fx_px *= factor;
  result.fy_px *= factor;
  // The image's corner, at -0.5 in both, is the fixed point of the scaling.
  result.cx_px = (cx_px + 0.5) * factor - 0.5;
  result.cy_px = (cy_px + 0.5) * factor - 0.5;
  return result;
}

cv::Matx33d CameraModel::matrix() const { return {fx_px, 0, cx_px, 0, fy_px, cy_px, 0, 0, 1}; }

void CameraModel::validate() const {
  for (const int size_px : {width_px, height_px}) {
    if (size_px < kMinSize_px || size_px > kMaxSize_px) {
      refuse("the image size " + std::to_string(width_px) + "x" + std::to_string(height_px) +
             " is not between 16 and 16384 pixels a side");
    }
  }
  for (const double focal_px : {fx_px, fy_px}) {
    if (!(focal_px > 0) || !std::isfinite(focal_px)) {
      refuse("the focal length " + std::to_string(focal_px) + " px is not positive and finite");
    }
  }
  const bool centre_near = std::abs(cx_px - 0.5 * width_px) <= 1.5 * width_px &&
                           std::abs(cy_px - 0.5 * height_px) <= 1.5 * height_px;
  if (!centre_near) {
    refuse("the principal point (" + std::to_string(cx_px) + ", " + std::to_string(cy_px) +
           ") lies too far outside the image of " + std::to_string(width_px) + "x" +
           std::to_string(height_px));
  }
  if (!std::all_of(distortion.begin(), distortion.end(),
                   [](double k) { return std::isfinite(k); })) {
    refuse("a distortion coefficient is not finite");
  }
}

Undistorter::Undistorter(const CameraModel& camera) {
  if (!camera.has_distortion()) return;
  cv::initUndistortRectifyMap(camera.matrix(), camera.distortion, cv::noArray(), camera.matrix(),
                              {camera.width_px, camera.height_px}, CV_16SC2, map_x_, map_y_);
}

cv::Mat Undistorter::operator()(const cv::Mat& image) const {
  cv::Mat undistorted;
  undistort(image, {0, 0, image.cols, image.rows}, undistorted);
  return undistorted;
}

void Undistorter::undistort(const cv::Mat& image, const cv::Rect& region,
                            cv::Mat& undistorted) const {
  if (map_x_.empty()) {
    undistorted = image;
    return;
  }
  undistorted.create(image.size(), image.type());
  if (region.empty()) return;
  cv::Mat part = undistorted(region);
  cv::remap(image, part, map_x_(region), map_y_(region), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
}

}  // namespace anneal6d
