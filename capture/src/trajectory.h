// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <vector>

#include "anneal6d/capture/simulation_options.h"
#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// The part of space in which a simulated object's centre stays: its bounding sphere is seen whole
/// (or as much of it as fits), between 0.7 and 1.4 of the start's distance.
class VisibleVolume {
 public:
  VisibleVolume(const TriangleMesh& mesh, const CameraModel& camera, const Pose& start);

  /// How far, per axis and with its sign, a place of the centre (camera frame) is out of it, mm.
  Eigen::Vector3d excess_mm(const Eigen::Vector3d& place_mm) const;

  /// The centre in the object frame.
  const Eigen::Vector3d& center_mm() const { return center_mm_; }

 private:
  CameraModel camera_;
  Eigen::Vector3d center_mm_;
  double radius_mm_;
  double near_mm_, far_mm_;
};

/// The pose of each frame, camera_from_object; the first is `start`.
std::vector<Pose> simulate_trajectory(const SimulationOptions& options, const Pose& start,
                                      const VisibleVolume& volume);

/// The pose at `time`, in frames, between the trajectory's poses; held at both ends.
Pose pose_at(const std::vector<Pose>& trajectory, double time);

}  // namespace anneal6d
