// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/random.h"
#include "anneal6d/framework/shading.h"

namespace anneal6d {

/// A small motion in the camera frame: rotation vector (rad) about the moving frame's origin in
/// entries 0..2, translation of that origin (mm) in entries 3..5.
using Twist = Eigen::Matrix<double, 6, 1>;

inline Pose moved(const Pose& pose, const Twist& twist) {
  return {(rotation_from_vector(twist.head<3>()) * pose.rotation).normalized(),
          pose.translation_mm + twist.tail<3>()};
}

/// The pose of axes parallel to the object's whose origin is at `place_mm` in its frame.
inline Pose with_origin_at(const Eigen::Vector3d& place_mm, const Pose& pose) {
  return {pose.rotation, pose * place_mm};
}

/// The twist that moves `from` to `to`.
inline Twist twist_between(const Pose& from, const Pose& to) {
  Twist twist;
  twist << rotation_vector_from(to.rotation * from.rotation.conjugate()),
      to.translation_mm - from.translation_mm;
  return twist;
}

/// How far a motion moves the points of an object of that radius about the moving frame's origin,
/// by and large, mm.
inline double displacement_mm(const Twist& twist, double radius_mm) {
  return twist.head<3>().norm() * radius_mm + twist.tail<3>().norm();
}

/// How far apart pixels are on an object at a pose, mm; no nearer than the near plane. `focal_px`:
/// focal length.
inline double mm_per_px(const Pose& camera_from_center, double focal_px) {
  return std::max(kNearPlane_mm, camera_from_center.translation_mm.z()) / focal_px;
}

/// Six independent standard normals.
inline Twist random_twist(const RandomKey& key) {
  Twist twist;
  for (std::uint32_t pair = 0; pair < 3; ++pair) {
    const auto normals = random_normals(key, pair);
    twist[2 * pair] = normals[0];
    twist[2 * pair + 1] = normals[1];
  }
  return twist;
}

}  // namespace anneal6d
