// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "line_kernels.h"
#include "view_model.h"

namespace anneal6d {

// Inner loops over the points of a contour, compiled for several instruction sets and chosen at run
// time.

/// Contour points in an image, an entry a point, with room for a whole vector behind the last one.
struct ProjectedContour {
  float *camera_x, *camera_y, *camera_z;  ///< millimetres, camera frame
  float *image_x, *image_y;               ///< pixels of the picture
  float *normal_x, *normal_y;             ///< unit, in the image
  float *shift_px, *trust, *polarity;     ///< see ContourSample; without what is shading's
  float *inside_px, *outside_px;          ///< see LineJob
  float* shading_px;                      ///< see LineJob
};

/// A camera that looks at an object.
struct ProjectionJob {
  std::span<const ContourSample> samples;
  std::array<float, 9> rotation;  ///< camera_from_object, row-major
  std::array<float, 3> translation_mm;
  std::array<float, 3> eye_mm;  ///< the camera, object frame
  float fx, fy, cx, cy;         ///< pixels, (cx, cy) counted from the picture's origin
  float near_mm;                ///< nearer points are not seen
  float last_x, last_y;         ///< points are seen between (1, 1) and here, pixels of the picture
};

/// Writes the points that are seen, in the samples' order, and returns their number.
std::size_t project_contour(const ProjectionJob& job, const ProjectedContour& points);

/// One Gauss-Newton step: along its normal each point is to go where the best of its candidates is
/// from where the motion so far has brought it.
struct StepJob {
  ProjectedContour points;
  LineCandidates candidates;  ///< offsets without the shift of the samples
  std::size_t count;
  std::array<float, 3> center_mm;  ///< of the object, camera frame: twists turn about it
  std::array<float, 6> motion;     ///< twist, so far
  float fx, fy;
  float cutoff_px;  ///< what is as far away counts nothing
};

/// Sums over the points, weighted. A column of the Jacobian is how far the entry of a twist moves
/// a point along its normal, in pixels.
struct StepSums {
  std::array<float, 21> normal;  ///< of J J', rows of the upper triangle
  std::array<float, 6> right;    ///< of J times what is left to go
  std::array<float, 6> sweep;    ///< of the squared way of the points in both directions
  float weight;
};
StepSums sum_step(const StepJob& job);

}  // namespace anneal6d
