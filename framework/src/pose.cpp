// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/pose.h"

#include <Eigen/Eigenvalues>
#include <cassert>
#include <cmath>

#include "anneal6d/framework/error.h"

namespace anneal6d {

Pose Pose::operator*(const Pose& other) const {
  return {(rotation * other.rotation).normalized(), *this * other.translation_mm};
}

Pose Pose::inverse() const {
  const Eigen::Quaterniond back = rotation.conjugate();
  return {back, back * -translation_mm};
}

bool Pose::is_finite() const { return rotation.coeffs().allFinite() && translation_mm.allFinite(); }

Eigen::Quaterniond rotation_from_axis_angle(const Eigen::Vector3d& axis, double angle_rad) {
  const double length = axis.norm();
  if (!(length > 0) || !std::isfinite(length) || !std::isfinite(angle_rad)) {
    throw ConfigError("a rotation needs a finite axis that is not zero and a finite angle");
  }
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis / length));
}

Eigen::Vector3d rotation_vector_from(const Eigen::Quaterniond& rotation) {
  const double sine = rotation.vec().norm();
  // Of q and -q the one with w >= 0 has the angle of at most pi.
  const double sign = rotation.w() < 0 ? -1.0 : 1.0;
  if (sine < 1e-12) return 2.0 * sign * rotation.vec();
  const double angle_rad = 2.0 * std::atan2(sine, sign * rotation.w());
  return rotation.vec() * (sign * angle_rad / sine);
}

Eigen::Quaterniond rotation_from_vector(const Eigen::Vector3d& rotation_vector_rad) {
  const double angle_rad = rotation_vector_rad.norm();
  // sin(x/2)/x, whose limit at zero is 1/2.
  const double scale = angle_rad < 1e-9 ? 0.5 : std::sin(0.5 * angle_rad) / angle_rad;
  Eigen::Quaterniond rotation;
  rotation.w() = std::cos(0.5 * angle_rad);
  rotation.vec() = scale * rotation_vector_rad;
  return rotation.normalized();
}

Eigen::Quaterniond rotation_from_euler(const EulerZxz& angles) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angles.psi_rad, Eigen::Vector3d::UnitZ()) *
                            Eigen::AngleAxisd(angles.theta_rad, Eigen::Vector3d::UnitX()) *
                            Eigen::AngleAxisd(angles.phi_rad, Eigen::Vector3d::UnitZ()));
}

EulerZxz euler_from(const Eigen::Quaterniond& rotation) {
  // R = Rz(psi) Rx(theta) Rz(phi): its last column and row hold sin(theta) times psi's and phi's
  // sines and cosines; at theta = 0 or pi only psi +- phi is determined.
  const Eigen::Matrix3d r = rotation.toRotationMatrix();
  const double sine = std::hypot(r(0, 2), r(1, 2));
  const double theta_rad = std::atan2(sine, r(2, 2));
  if (sine < 1e-9) return {std::atan2(r(1, 0), r(0, 0)), theta_rad, 0.0};
  return {std::atan2(r(0, 2), -r(1, 2)), theta_rad, std::atan2(r(2, 0), r(2, 1))};
}

double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond difference = a.conjugate() * b;
  return 2.0 * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

namespace {

template <class RotationOf>
Eigen::Quaterniond markley_mean(std::size_t count, std::span<const double> weights,
                                RotationOf&& rotation_of) {
  assert(count == weights.size() && count > 0);
  Eigen::Matrix4d moment = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector4d q = rotation_of(i).coeffs();
    moment += weights[i] * q * q.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(moment);
  Eigen::Quaterniond mean(Eigen::Vector4d(solver.eigenvectors().col(3)));
  if (mean.w() < 0) mean.coeffs() = -mean.coeffs();
  return mean;
}

}  // namespace

Eigen::Quaterniond weighted_mean(std::span<const Eigen::Quaterniond> rotations,
                                 std::span<const double> weights) {
  return markley_mean(rotations.size(), weights,
                      [&](std::size_t i) -> const Eigen::Quaterniond& { return rotations[i]; });
}

Pose weighted_mean(std::span<const Pose> poses, std::span<const double> weights) {
  Pose mean;
  mean.rotation =
      markley_mean(poses.size(), weights,
                   [&](std::size_t i) -> const Eigen::Quaterniond& { return poses[i].rotation; });
  double sum = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    mean.translation_mm += weights[i] * poses[i].translation_mm;
    sum += weights[i];
  }
  mean.translation_mm /= sum;
  return mean;
}

}  // namespace anneal6d
