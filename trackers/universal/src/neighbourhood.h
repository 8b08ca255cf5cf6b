// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cstdint>

#include "anneal6d/framework/pose.h"
#include "refiner.h"

namespace anneal6d {

/// Where refinement may have found a false bottom instead of the true one: along the motions that
/// the contour shows least, or, since edges side by side such as the two of a rim are taken for
/// each other, a few pixels aside. All poses are camera_from_object.
class Neighbourhood {
 public:
  static constexpr std::uint32_t kMotions = 4;
  static constexpr double kReach_px = 3.0;  ///< of refinement that starts there

  /// The object's centre, object frame, and its radius about it.
  Neighbourhood(const Eigen::Vector3d& center_mm, double radius_mm, double focal_px)
      : center_mm_(center_mm), radius_mm_(radius_mm), focal_px_(focal_px) {}

  /// Poses on both sides of a refined one, so many steps away: along its weak motions (`motion` 0
  /// and 2), down (1) and right (3).
  std::array<Pose, 2> beside(const Refiner::Result& refined, std::uint32_t motion,
                             double steps = 1.0) const;

  /// Whether poses are in one basin, as far as that can be told from how near they are.
  bool same_place(const Pose& a, const Pose& b) const;

  /// How much of the weakest motion edges leave open, 0..1.
  double unseen_share(const Refiner::Result& refined) const;

 private:
  Eigen::Vector3d center_mm_;
  double radius_mm_, focal_px_;
};

}  // namespace anneal6d
