// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <opencv2/core/mat.hpp>

#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/shading.h"

namespace anneal6d {

/// Port: draws the object as the camera would see it, without distortion. Mesh and camera are given
/// at construction. Used by the simulation and by overlays.
class ObjectRenderer {
 public:
  virtual ~ObjectRenderer() = default;

  /// `color_bgr`: CV_8UC3 of the camera's size, black where there is no object. `depth_mm`:
  /// CV_32FC1, z in the camera frame, 0 where there is no object. Both are (re)allocated as needed.
  virtual void render(const Pose& camera_from_object, const Shading& shading, cv::Mat& color_bgr,
                      cv::Mat& depth_mm) = 0;
};

}  // namespace anneal6d
