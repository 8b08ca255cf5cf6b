// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "anneal6d/capture/simulation_options.h"
#include "anneal6d/framework/frame_source.h"
#include "anneal6d/framework/object_renderer.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// Makes what draws the object; the visualizer has one.
using ObjectRendererFactory = std::function<std::unique_ptr<ObjectRenderer>(
    std::shared_ptr<const TriangleMesh>, const CameraModel&)>;

/// 640x480 pixels, focal length 650 px, no distortion: what is simulated unless a calibration is
/// given.
CameraModel default_simulation_camera();

/// The start pose that SimulationOptions describes for an empty `start`.
Pose default_start_pose(const TriangleMesh& mesh, const CameraModel& camera);

/// A camera that looks at a moving object and knows its true pose (thesis, simulation mode). The
/// object stays in view: a step that would carry its centre out of the part of space in which its
/// bounding sphere is seen whole, at 0.7 to 1.4 of the start's distance, is mirrored, which leaves
/// the sizes of the steps as they are. A camera with distortion gets a distorted picture.
class SimulationSource : public FrameSource {
 public:
  /// Throws ConfigError (a bad option, no mesh, no way to draw, an absurd camera, a start pose that
  /// is not in front of the camera), FileError (the background), and what the factory throws.
  SimulationSource(std::shared_ptr<const TriangleMesh> mesh, const CameraModel& camera,
                   SimulationOptions options, const ObjectRendererFactory& make_renderer);

  /// CV_8UC3. Throws what the renderer throws.
  std::optional<Frame> next() override;
  /// Draws nothing.
  std::int64_t skip(std::int64_t count) override;
  std::string description() const override;
  std::optional<CameraModel> camera() const override { return camera_; }
  /// Exact; with motion blur, of the middle of the exposure.
  std::optional<Pose> ground_truth() const override;

 private:
  void draw_object(std::int64_t index);
  void add_view(const Pose& camera_from_object, const Shading& shading, double weight);

  std::shared_ptr<const TriangleMesh> mesh_;
  CameraModel camera_;
  SimulationOptions options_;
  std::unique_ptr<ObjectRenderer> renderer_;  // of the supersampled camera, without distortion
  std::vector<Pose> trajectory_;
  cv::Mat background_;             // CV_32FC3, linear light
  cv::Mat distort_x_, distort_y_;  // undistorted pixel of each distorted one; empty: no distortion
  double occluder_radius_px_ = 0;
  std::int64_t position_ = 0;

  // Of the frame being drawn; kept for their memory.
  cv::Mat dense_color_, dense_depth_, dense_coverage_, dense_light_;
  cv::Mat color_, coverage_;            // linear light CV_32FC3 premultiplied, CV_32FC1 in 0..1
  cv::Mat view_light_, view_coverage_;  // of one exposure, CV_32FC3, CV_8U
  cv::Mat scratch_color_, scratch_coverage_;
};

}  // namespace anneal6d
