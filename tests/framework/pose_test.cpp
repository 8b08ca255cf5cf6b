// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/pose.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/random.h"
#include "special_numbers.h"

namespace anneal6d {
namespace {

using test::kInfinity;
using test::kNaN;
using test::kPi;

constexpr double kDegree = kPi / 180.0;

double distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm(); }

Eigen::Quaterniond negated(const Eigen::Quaterniond& q) { return {-q.w(), -q.x(), -q.y(), -q.z()}; }

/// Evenly spread over SO(3): a quaternion of four normals, normalised.
Eigen::Quaterniond random_rotation(std::uint32_t index) {
  const auto a = random_normals({.seed = 3, .particle = index}, 0);
  const auto b = random_normals({.seed = 3, .particle = index}, 1);
  return Eigen::Quaterniond(a[0], a[1], b[0], b[1]).normalized();
}

// Thesis, figure A.1: v turned by 180 degrees about a.
const Eigen::Vector3d kVector(0.1, 0.4, 1.1);
const Eigen::Vector3d kAxis(0.143, 0.858, 0.493);
const Eigen::Vector3d kTurned(0.157, 1.144, -0.212);
constexpr double kPrinted = 1e-3;  // the figures have three decimals

TEST(AxisAngle, TurnsTheThesissVector) {
  const Eigen::Quaterniond rotation = rotation_from_axis_angle(kAxis, kPi);
  EXPECT_LT(distance(rotation * kVector, kTurned), kPrinted);
  Eigen::Matrix3d printed;
  printed << -0.959, 0.245, 0.141, 0.245, 0.472, 0.846, 0.141, 0.846, -0.514;
  EXPECT_LT((rotation.toRotationMatrix() - printed).cwiseAbs().maxCoeff(), kPrinted);
}

TEST(AxisAngle, TakesAnAxisOfAnyLength) {
  EXPECT_LT(angle_between(rotation_from_axis_angle(kAxis, 1.0),
                          rotation_from_axis_angle(1000 * kAxis, 1.0)),
            1e-12);
}

TEST(AxisAngle, TurnsCounterclockwiseSeenFromTheAxisTip) {
  const auto quarter = rotation_from_axis_angle(Eigen::Vector3d::UnitZ(), kPi / 2);
  EXPECT_LT(distance(quarter * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()), 1e-12);
}

TEST(AxisAngle, RefusesAnAxisThatIsZeroOrNotFinite) {
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, kNaN, 1), Eigen::Vector3d(kInfinity, 0, 0)}) {
    EXPECT_THROW(rotation_from_axis_angle(axis, 1.0), ConfigError) << axis.transpose();
  }
  EXPECT_THROW(rotation_from_axis_angle(kAxis, kNaN), ConfigError);
}

// Thesis, figure A.2: another rotation that takes v to the same place.
TEST(EulerZxz, TurnsTheThesissVector) {
  const auto rotation = rotation_from_euler({10 * kDegree, -90 * kDegree, -45 * kDegree});
  EXPECT_LT(distance(rotation * kVector, kTurned), kPrinted);
}

TEST(EulerZxz, ComesBackFromARotation) {
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Eigen::Quaterniond rotation = random_rotation(i);
    const EulerZxz angles = euler_from(rotation);
    EXPECT_GE(angles.theta_rad, 0);
    EXPECT_LE(angles.theta_rad, kPi);
    EXPECT_LT(angle_between(rotation_from_euler(angles), rotation), 1e-9) << "rotation " << i;
  }
}

TEST(EulerZxz, ComesBackWithItsOwnAngles) {
  const EulerZxz angles = euler_from(rotation_from_euler({0.3, 1.2, -2.1}));
  EXPECT_NEAR(angles.psi_rad, 0.3, 1e-12);
  EXPECT_NEAR(angles.theta_rad, 1.2, 1e-12);
  EXPECT_NEAR(angles.phi_rad, -2.1, 1e-12);
}

TEST(EulerZxz, HasNoLastAngleWhereOnlySumOrDifferenceIsKnown) {
  for (const double theta_rad : {0.0, kPi}) {
    for (const double psi_rad : {0.0, 0.7, -3.0}) {
      const auto rotation = rotation_from_euler({psi_rad, theta_rad, 0.4});
      const EulerZxz angles = euler_from(rotation);
      EXPECT_EQ(angles.phi_rad, 0.0);
      EXPECT_NEAR(angles.theta_rad, theta_rad, 1e-9);
      EXPECT_LT(angle_between(rotation_from_euler(angles), rotation), 1e-9);
    }
  }
}

TEST(EulerZxz, StaysAccurateCloseToTheSingularTurns) {
  for (const double theta_rad : {1e-10, 1e-8, 1e-6, kPi - 1e-6, kPi - 1e-8, kPi - 1e-10}) {
    const auto rotation = rotation_from_euler({0.7, theta_rad, 0.4});
    EXPECT_LT(angle_between(rotation_from_euler(euler_from(rotation)), rotation), 1e-8)
        << theta_rad;
  }
}

TEST(RotationVector, ComesBackAtAnyLengthUpToPi) {
  for (const double angle_rad :
       {0.0, 1e-300, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3, 1.0, 3.0, kPi - 1e-9, kPi - 1e-14}) {
    const Eigen::Vector3d vector = angle_rad * kAxis.normalized();
    const Eigen::Vector3d back = rotation_vector_from(rotation_from_vector(vector));
    EXPECT_LT(distance(back, vector), 1e-12 * angle_rad + 1e-14) << angle_rad;
  }
}

TEST(RotationVector, TakesTheShortWayRound) {
  const auto rotation = rotation_from_vector(1.5 * kPi * Eigen::Vector3d::UnitX());
  EXPECT_LT(distance(rotation_vector_from(rotation), -0.5 * kPi * Eigen::Vector3d::UnitX()), 1e-12);
}

TEST(RotationVector, IsTheSameForBothSignsOfAQuaternion) {
  for (std::uint32_t i = 0; i < 50; ++i) {
    const Eigen::Quaterniond q = random_rotation(i);
    EXPECT_LT(distance(rotation_vector_from(q), rotation_vector_from(negated(q))), 1e-12);
  }
}

TEST(RotationVector, HasAtMostHalfATurn) {
  const auto half = rotation_from_axis_angle(kAxis, kPi);
  EXPECT_NEAR(rotation_vector_from(half).norm(), kPi, 1e-12);
  EXPECT_NEAR(rotation_vector_from(negated(half)).norm(), kPi, 1e-12);
}

TEST(AngleBetween, IsExactForTinyAndForHalfTurns) {
  const Eigen::Quaterniond q = random_rotation(1);
  EXPECT_EQ(angle_between(q, negated(q)), 0.0);
  for (const double angle_rad : {1e-12, 1e-9, 0.5, kPi - 1e-9, kPi}) {
    EXPECT_NEAR(angle_between(q, q * rotation_from_axis_angle(kAxis, angle_rad)), angle_rad, 1e-15)
        << angle_rad;
  }
}

TEST(PoseOf, ChainsLikeMatrices) {
  const Pose a{random_rotation(1), {1, 2, 3}}, b{random_rotation(2), {-4, 5, 6}};
  const Eigen::Vector3d point(7, -8, 9);
  EXPECT_LT(distance((a * b) * point, a * (b * point)), 1e-12);
  EXPECT_LT(distance(a.inverse() * (a * point), point), 1e-12);
}

TEST(PoseOf, StaysARotationInALongChain) {
  Pose pose;
  const Pose step{rotation_from_axis_angle(kAxis, 0.1), {1, 0, 0}};
  for (int i = 0; i < 100000; ++i) pose = pose * step;
  EXPECT_NEAR(pose.rotation.norm(), 1.0, 1e-12);
}

TEST(PoseOf, KnowsWhetherItIsFinite) {
  EXPECT_TRUE(Pose{}.is_finite());
  Pose pose;
  pose.translation_mm.y() = kInfinity;
  EXPECT_FALSE(pose.is_finite());
  pose = {};
  pose.rotation.z() = kNaN;
  EXPECT_FALSE(pose.is_finite());
}

TEST(MeanRotation, OfTwoIsHalfway) {
  const Eigen::Quaterniond a = random_rotation(5);
  const Eigen::Quaterniond b = a * rotation_from_axis_angle(kAxis, 2.0);
  const std::array weights{0.5, 0.5};
  const Eigen::Quaterniond mean = weighted_mean(std::array{a, b}, weights);
  EXPECT_NEAR(angle_between(mean, a), 1.0, 1e-12);
  EXPECT_NEAR(angle_between(mean, b), 1.0, 1e-12);
}

TEST(MeanRotation, IgnoresTheSignOfEachQuaternion) {
  std::vector<Eigen::Quaterniond> rotations, some_negated;
  std::vector<double> weights;
  for (std::uint32_t i = 0; i < 20; ++i) {
    rotations.push_back(rotation_from_vector(0.3 * rotation_vector_from(random_rotation(i))));
    some_negated.push_back(i % 3 == 0 ? negated(rotations.back()) : rotations.back());
    weights.push_back(1.0 + i);
  }
  EXPECT_LT(angle_between(weighted_mean(rotations, weights), weighted_mean(some_negated, weights)),
            1e-12);
}

TEST(MeanRotation, AgreesWithTheMeanRotationVectorForASmallSpread) {
  const Eigen::Quaterniond middle = random_rotation(9);
  std::vector<Eigen::Quaterniond> rotations;
  std::vector<double> weights;
  Eigen::Vector3d mean_vector = Eigen::Vector3d::Zero();
  double sum = 0;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const Eigen::Vector3d vector_rad = 0.01 / kPi * rotation_vector_from(random_rotation(100 + i));
    weights.push_back(1.0 + i % 7);
    rotations.push_back(middle * rotation_from_vector(vector_rad));
    mean_vector += weights.back() * vector_rad;
    sum += weights.back();
  }
  const Eigen::Quaterniond expected = middle * rotation_from_vector(mean_vector / sum);
  // Both agree to second order in the spread of at most 0.01 rad.
  EXPECT_LT(angle_between(weighted_mean(rotations, weights), expected), 1e-6);
}

TEST(MeanRotation, LeansTowardsTheHeavier) {
  const Eigen::Quaterniond a = Eigen::Quaterniond::Identity();
  const Eigen::Quaterniond b = rotation_from_axis_angle(kAxis, 0.1);
  const Eigen::Quaterniond mean = weighted_mean(std::array{a, b}, std::array{3.0, 1.0});
  EXPECT_NEAR(angle_between(mean, a), 0.025, 1e-4);
}

TEST(MeanRotation, IsUnitWithAPositiveScalarPart) {
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Eigen::Quaterniond mean = weighted_mean(std::array{random_rotation(i)}, std::array{0.2});
    EXPECT_NEAR(mean.norm(), 1.0, 1e-12);
    EXPECT_GE(mean.w(), 0);
    EXPECT_LT(angle_between(mean, random_rotation(i)), 1e-9);
  }
}

TEST(MeanPose, AveragesTranslationsByWeightsOfAnySum) {
  const Pose a{Eigen::Quaterniond::Identity(), {0, 0, 100}};
  const Pose b{rotation_from_axis_angle(kAxis, 0.2), {40, 0, 200}};
  const Pose mean = weighted_mean(std::array{a, b}, std::array{6.0, 2.0});
  EXPECT_LT(distance(mean.translation_mm, {10, 0, 125}), 1e-12);
  EXPECT_NEAR(angle_between(mean.rotation, a.rotation), 0.05, 1e-3);
}

}  // namespace
}  // namespace anneal6d
