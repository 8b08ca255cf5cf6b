// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/symmetry.h"

#include <cmath>

namespace anneal6d {
namespace {

/// The turn of `rotation` about the object's axis that brings it closest to `reference`.
Eigen::Quaterniond turned_about_axis(const Eigen::Quaterniond& rotation,
                                     const Eigen::Quaterniond& reference,
                                     const Eigen::Vector3d& axis) {
  // Of reference^-1 * rotation * turn(phi) = d * turn(phi) the scalar part is largest where phi
  // undoes d's twist about the axis (swing-twist decomposition).
  const Eigen::Quaterniond difference = reference.conjugate() * rotation;
  const double half_twist = std::atan2(difference.vec().dot(axis), difference.w());
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-2.0 * half_twist, axis));
  return (rotation * turn).normalized();
}

}  // namespace

Eigen::Quaterniond Symmetry::fold(const Eigen::Quaterniond& rotation,
                                  const Eigen::Quaterniond& reference) const {
  const bool revolution = !axis.isZero();
  const auto candidate = [&](const Eigen::Quaterniond& equivalent) {
    return revolution ? turned_about_axis(equivalent, reference, axis) : equivalent;
  };
  Eigen::Quaterniond best = candidate(rotation);
  for (const Eigen::Quaterniond& symmetric : rotations) {
    const Eigen::Quaterniond other = candidate((rotation * symmetric).normalized());
    if (angle_between(other, reference) < angle_between(best, reference)) best = other;
  }
  return best;
}

}  // namespace anneal6d
