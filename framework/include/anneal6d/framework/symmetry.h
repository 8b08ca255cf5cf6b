// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <vector>

#include "anneal6d/framework/pose.h"

namespace anneal6d {

/// Rotations of the object about its own origin that leave its appearance unchanged.
struct Symmetry {
  /// Unit axis (object frame) of an object of revolution; zero: none.
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  /// Discrete symmetries beside the identity, object frame.
  std::vector<Eigen::Quaterniond> rotations;

  bool is_none() const { return axis.isZero() && rotations.empty(); }

  /// The equivalent of `rotation` (camera_from_object) that is closest to `reference`.
  Eigen::Quaterniond fold(const Eigen::Quaterniond& rotation,
                          const Eigen::Quaterniond& reference) const;
};

}  // namespace anneal6d
