// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace anneal6d {

/// Pinhole camera with radial and tangential distortion (thesis 3.1). Pixel centres lie at integer
/// coordinates, as in OpenCV: the image covers [-0.5, width - 0.5) x [-0.5, height - 0.5).
struct CameraModel {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;
  std::array<double, 5> distortion{};  ///< OpenCV's k1 k2 p1 p2 k3

  bool has_distortion() const;

  /// Pinhole projection, pixels, of a camera-frame point with z > 0, *without* distortion: scorers
  /// and renderers work on images whose distortion was removed.
  Eigen::Vector2d project(const Eigen::Vector3d& point_mm) const {
    return {fx_px * point_mm.x() / point_mm.z() + cx_px,
            fy_px * point_mm.y() / point_mm.z() + cy_px};
  }

  /// The same view sampled `factor` times as densely (or coarsely, below 1).
  CameraModel scaled(double factor) const;

  cv::Matx33d matrix() const;

  /// Throws ConfigError naming the first absurd value: sizes outside 16..16384, focal lengths not
  /// positive or non-finite, principal point further than one image size outside the image.
  void validate() const;
};

/// Reads a calibration; the content decides which of three formats it is: OpenCV FileStorage YAML,
/// ROS camera_info YAML, or IVT text (first camera of the file). Throws FileError.
CameraModel load_camera(const std::filesystem::path& path);

/// Writes OpenCV FileStorage YAML, atomically. Throws FileError.
void save_camera(const CameraModel& camera, const std::filesystem::path& path);

/// Removes lens distortion from frames; maps are computed once. For a camera without distortion the
/// frame is passed through without a copy.
class Undistorter {
 public:
  explicit Undistorter(const CameraModel& camera);
  /// `image` has the calibration's size; the result may share its memory.
  cv::Mat operator()(const cv::Mat& image) const;
  /// The same, of the part `region` of the image only, which lies inside it. `undistorted` gets the
  /// image's size and type; outside of the region it keeps what it had.
  void undistort(const cv::Mat& image, const cv::Rect& region, cv::Mat& undistorted) const;

 private:
  cv::Mat map_x_, map_y_;  // empty without distortion
};

}  // namespace anneal6d
