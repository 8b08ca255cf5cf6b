// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

#include "contour.h"
#include "rasterizer.h"
#include "view_model.h"

namespace anneal6d {

/// The camera of a `ViewModel`'s pictures.
CameraModel view_camera();

/// Makes one view at a time: draws the object, finds its contour and the edge pixels of the
/// drawing, and says of each what tracking wants to know. For one caller at a time; a copy made
/// before anything was painted is independent. The model outlives it.
class ViewPainter {
 public:
  ViewPainter(const RasterModel& model, const EdgeOptions& edges, const Shading& shading,
              const CameraModel& camera);

  /// The view of a `ViewModel` from `direction` (unit, object frame), where `camera` was
  /// `view_camera()`; `seed` decides the order of the points.
  ModelView paint(const Eigen::Vector3d& direction, std::uint32_t seed);

  /// Just the contour of the object at a pose, at most so many samples of it; `seed` decides which,
  /// and their order. `workers` share the work.
  ModelView paint_contour(const Pose& camera_from_object, std::size_t most_samples,
                          std::uint32_t seed, Workers& workers);

  /// Whether nothing of the object was beyond the image's border in the last picture.
  bool all_in_image() const;

 private:
  void take_samples(std::span<const ContourPoint> points, const Pose& camera_from_object,
                    std::span<ContourSample> samples) const;
  /// What the geometry says; turns the normal to the far side.
  ContourSample sample_of(const ContourPoint& point, const Pose& camera_from_object,
                          const Eigen::Vector3d& camera_mm, const Eigen::Vector2d& image_px,
                          Eigen::Vector2d& normal) const;
  void sample_edges(const Pose& camera_from_object, std::uint32_t seed, ModelView& view);
  /// Depth of the picture, millimetres, 0 outside the object; pixels from the region's first.
  float depth_at(float x, float y) const;

  const RasterModel& model_;
  EdgeOptions edges_;
  CameraModel camera_;
  Rasterizer rasterizer_;
  ContourExtractor extractor_;
  Region region_;
  cv::Mat grey_, depth_mm_, smooth_grey_;
  cv::Mat flat_, smooth_flat_;  ///< the object in one brightness, without shading
  std::vector<ContourPoint> points_;
};

}  // namespace anneal6d
