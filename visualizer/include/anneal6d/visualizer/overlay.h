// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/edge_detector.h"
#include "anneal6d/framework/frame.h"
#include "anneal6d/framework/object_renderer.h"
#include "anneal6d/framework/rigid_object_tracker.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// Edges of the object drawn in a pose (thesis Fig. 4.6). Thresholds of `options` should be given.
EdgeImage rendered_edges(ObjectRenderer& renderer, const Pose& camera_from_object,
                         const Shading& shading, const EdgeOptions& options);

/// Edges of the object in each of many poses, one over the other (thesis Fig. 4.4).
EdgeImage particle_edges(ObjectRenderer& renderer, std::span<const Pose> camera_from_object,
                         const Shading& shading, const EdgeOptions& options);

/// Edges that both images have (thesis Fig. 4.7). Throws ConfigError for different sizes.
EdgeImage matched_edges(const EdgeImage& frame, const EdgeImage& rendered);

/// White edges on black, CV_8UC3, as pictures are written (thesis Fig. 4.3).
cv::Mat edge_picture(const EdgeImage& edges);

/// Colours `picture_bgr` (CV_8UC3) where there is an edge. Throws ConfigError for different sizes.
void draw_edges(cv::Mat& picture_bgr, const EdgeImage& edges, const cv::Vec3b& color_bgr);

/// Draws the object's axes, x red, y green, z blue, from the object's origin, `length_mm` long.
/// Axes that come closer than the near plane are left out.
void draw_tripod(cv::Mat& picture_bgr, const CameraModel& camera, const Pose& camera_from_object,
                 double length_mm);

/// Writes "frame 12  quality 0.83  tracking" into the upper left corner; red when lost.
void draw_status(cv::Mat& picture_bgr, std::int64_t frame, double quality, TrackStatus status);

/// Draws a tracker's results over its frames (thesis Fig. 4.8): the edges of the object in the
/// estimated pose (green, red when lost), its axes and a line of text.
class OverlayPainter {
 public:
  /// `renderer` draws `mesh` for `camera`. Throws ConfigError: no renderer, no mesh, bad camera.
  OverlayPainter(std::unique_ptr<ObjectRenderer> renderer, std::shared_ptr<const TriangleMesh> mesh,
                 const CameraModel& camera);

  /// The picture: CV_8UC3 of the camera's size, over the frame with its distortion removed. Valid
  /// until the next call. Throws ConfigError for a frame of another size or type, and what the
  /// renderer throws.
  const cv::Mat& paint(const Frame& frame, const TrackResult& result);

 private:
  std::unique_ptr<ObjectRenderer> renderer_;
  CameraModel camera_;
  Undistorter undistort_;
  double axis_length_mm_ = 0;
  cv::Mat picture_, color_, depth_mm_, mask_, outline_;
};

}  // namespace anneal6d
