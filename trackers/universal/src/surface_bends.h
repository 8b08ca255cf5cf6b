// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "anneal6d/framework/camera_model.h"

namespace anneal6d {

/// Finds where a surface bends sharply, though without a crease of the mesh: the rounded edges of
/// boxes, of bricks, of everything that was scanned. Light falls differently on both sides, so that
/// an image has an edge there.
class SurfaceBends {
 public:
  struct Bend {
    Eigen::Vector2d place_px;  ///< in the depth image, between pixels
    Eigen::Vector2d across;    ///< unit, the direction in which the surface turns fastest
  };

  /// `depth_mm`: CV_32FC1, 0 outside the object; its first pixel is at `origin` of the camera's
  /// image. A step of more than `jump_mm` between neighbours is no surface. The bends are valid
  /// until the next call.
  const std::vector<Bend>& find(const cv::Mat& depth_mm, const cv::Point& origin,
                                const CameraModel& camera, double jump_mm);

 private:
  Eigen::Vector3f normal_at(int x, int y) const;

  int columns_ = 0;
  // See BendJob.
  std::array<std::vector<float>, 3> normals_;
  std::vector<float> turns_;
  std::vector<Bend> bends_;
};

}  // namespace anneal6d
