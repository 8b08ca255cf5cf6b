// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "exact_contour.h"

#include <algorithm>
#include <numbers>

#include "refiner.h"

namespace anneal6d {
namespace {

// Between viewpoints that see nearly the same contour, as a share of the distance.
constexpr double kSameView = 1.5 * (std::numbers::pi / 180.0);

}  // namespace

ExactContour::ExactContour(const ScorerSetup& setup)
    : model_(setup.mesh, setup.textured),
      painter_(model_, setup.edges, setup.shading, setup.camera),
      feigned_share_(
          std::clamp(16.0 / static_cast<double>(setup.mesh->triangles().size()), 0.001, 0.003)) {}

void ExactContour::draw(const Pose& camera_from_object, Workers& workers) {
  if (drawn_near_by(camera_from_object)) return;
  contour_ = painter_.paint_contour(camera_from_object, Refiner::kMostPolished, 0, workers);
  // What the image's border cuts off may come into sight with a shift.
  if (painter_.all_in_image()) {
    drawn_ = camera_from_object;
  } else {
    drawn_.reset();
  }
}

bool ExactContour::drawn_near_by(const Pose& camera_from_object) const {
  if (!drawn_) return false;
  const Eigen::Vector3d drawn_from_mm = drawn_->inverse().translation_mm;
  const Eigen::Vector3d seen_from_mm = camera_from_object.inverse().translation_mm;
  const double distance_mm = (seen_from_mm - model_.mesh->center_mm().cast<double>()).norm();
  return (drawn_from_mm - seen_from_mm).norm() < kSameView * distance_mm;
}

}  // namespace anneal6d
