// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "contour.h"
#include "rasterizer.h"
#include "twist.h"

namespace anneal6d {

/// Sharpens a pose that is nearly right: Gauss-Newton on the distances, along the normals, from the
/// object's visible edges to the nearest edges of the image (Drummond and Cipolla, PAMI 2002),
/// located between pixels and weighted against outliers.
class Refiner {
 public:
  /// `model` outlives the refiner.
  Refiner(const RasterModel& model, const CameraModel& camera);

  /// The frame, CV_8UC1 or CV_8UC3, distortion removed; only the surroundings of `expected` are
  /// prepared.
  void set_image(const cv::Mat& image, const Pose& expected_camera_from_object);

  struct Result {
    Pose camera_from_object;
    double support = 0;  ///< share of the visible contour points with an image edge within 2 px
    int points = 0;      ///< visible contour points
  };

  /// Starts with a search range of `reach_px` and narrows it. `sigma` (see twist.h, about the
  /// object's centre) says how far the truth may be from the start: what the edges leave open stays
  /// there.
  Result refine(const Pose& start_camera_from_object, double reach_px, const Twist& sigma);

 private:
  struct Observation {
    double offset_px;  ///< of the image's edge along the normal; NaN if there is none
    double strength;   ///< grey levels a pixel
  };
  /// A blurred picture and where its first pixel lies in the image.
  struct Picture {
    const cv::Mat& smooth;
    cv::Point origin;
  };
  struct Target {
    ContourPoint point;
    double bias_px;  ///< of where its edge appears, because of edges beside it
    double trust;
  };

  void see(const Pose& camera_from_object);
  static Observation observe(const Picture& picture, const Eigen::Vector2d& image_px,
                             const Eigen::Vector2d& normal, int reach_px, bool camera_encoded);
  /// One Gauss-Newton step; returns the share of supported points before it.
  double step(Pose& camera_from_object, double reach_px);

  Pose to_center(const Pose& camera_from_object) const;

  const RasterModel& model_;
  CameraModel camera_;
  Rasterizer rasterizer_;
  ContourExtractor contour_;
  cv::Mat smooth_;  ///< the frame in `window_`, blurred
  cv::Rect window_;
  cv::Mat grey_, depth_mm_;
  cv::Mat smooth_grey_;
  std::vector<ContourPoint> points_;
  std::vector<Target> targets_;
  Pose start_center_;      ///< camera_from_center where the refinement began
  Twist start_precision_;  ///< how firmly it is held there, per squared unit of a twist
};

}  // namespace anneal6d
