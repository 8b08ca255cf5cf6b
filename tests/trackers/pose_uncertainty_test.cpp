// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "pose_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace anneal6d {
namespace {

using Map = PoseUncertainty::Covariance;

constexpr double kTurn_rad = 0.02, kShift_mm = 5;  // a frame's unseen motion
constexpr double kWithin_mm = 10, kWithin_rad = 0.035;
const Eigen::Vector3d kNoAxis = Eigen::Vector3d::Zero();
const Map kNoError = Map::Zero();

Twist sigmas(double turn_rad, double shift_mm) {
  Twist sigma;
  sigma << Eigen::Vector3d::Constant(turn_rad), Eigen::Vector3d::Constant(shift_mm);
  return sigma;
}

/// Of a normal deviation: the probability that it is smaller.
double normal_within(double limit, double sigma) {
  return std::erf(limit / (sigma * std::numbers::sqrt2));
}

TEST(PoseUncertainty, IsNoneAtFirstAndAfterAReset) {
  PoseUncertainty uncertainty;
  EXPECT_EQ(uncertainty.probability_within(kWithin_mm, kWithin_rad, kNoAxis), 1);
  uncertainty.update(sigmas(kTurn_rad, kShift_mm), Map::Identity(), kNoError);
  EXPECT_LT(uncertainty.probability_within(kWithin_mm, kWithin_rad, kNoAxis), 1);
  uncertainty.reset();
  EXPECT_EQ(uncertainty.probability_within(kWithin_mm, kWithin_rad, kNoAxis), 1);
}

TEST(PoseUncertainty, OfAFrameWithNothingSeenIsThatOfTheMotion) {
  PoseUncertainty turned, shifted, both;
  turned.update(sigmas(kTurn_rad, 0), Map::Identity(), kNoError);
  shifted.update(sigmas(0, kShift_mm), Map::Identity(), kNoError);
  both.update(sigmas(kTurn_rad, kShift_mm), Map::Identity(), kNoError);
  const double right_angle = normal_within(kWithin_rad, kTurn_rad);
  const double right_place = normal_within(kWithin_mm, kShift_mm);
  EXPECT_NEAR(right_place, 0.954, 0.001) << "two standard deviations";
  EXPECT_NEAR(turned.probability_within(kWithin_mm, kWithin_rad, kNoAxis), right_angle, 1e-9);
  EXPECT_NEAR(shifted.probability_within(kWithin_mm, kWithin_rad, kNoAxis), right_place, 1e-9);
  EXPECT_NEAR(both.probability_within(kWithin_mm, kWithin_rad, kNoAxis), right_angle * right_place,
              1e-9);
}

TEST(PoseUncertainty, GrowsWithTheRootOfTheFrames) {
  PoseUncertainty uncertainty;
  for (int frame = 1; frame <= 20; ++frame) {
    uncertainty.update(sigmas(kTurn_rad, 0), Map::Identity(), kNoError);
    EXPECT_NEAR(uncertainty.probability_within(kWithin_mm, kWithin_rad, kNoAxis),
                normal_within(kWithin_rad, kTurn_rad * std::sqrt(frame)), 1e-9)
        << "frame " << frame;
  }
}

TEST(PoseUncertainty, EndsWhenThePoseIsSeen) {
  PoseUncertainty uncertainty;
  for (int frame = 0; frame < 5; ++frame) {
    uncertainty.update(sigmas(kTurn_rad, kShift_mm), Map::Identity(), kNoError);
  }
  uncertainty.update(sigmas(kTurn_rad, kShift_mm), Map::Zero(), kNoError);
  EXPECT_EQ(uncertainty.probability_within(kWithin_mm, kWithin_rad, kNoAxis), 1);
}

TEST(PoseUncertainty, StaysWhereTheImageHalvesWhatEachFrameAdds) {
  PoseUncertainty uncertainty;
  for (int frame = 0; frame < 60; ++frame) {
    uncertainty.update(sigmas(kTurn_rad, 0), 0.5 * Map::Identity(), kNoError);
  }
  // v = (v + s^2) / 4
  EXPECT_NEAR(uncertainty.probability_within(kWithin_mm, kWithin_rad, kNoAxis),
              normal_within(kWithin_rad, kTurn_rad / std::sqrt(3.0)), 1e-9);
}

TEST(PoseUncertainty, IsThatOfTheDirectionLeastSeen) {
  PoseUncertainty uncertainty;
  Map unseen = Map::Zero();
  unseen(1, 1) = 1;  // the turn about y
  for (int frame = 0; frame < 4; ++frame) {
    uncertainty.update(sigmas(kTurn_rad, kShift_mm), unseen, kNoError);
  }
  EXPECT_NEAR(uncertainty.probability_within(kWithin_mm, kWithin_rad, kNoAxis),
              normal_within(kWithin_rad, 2 * kTurn_rad), 1e-9);
}

TEST(PoseUncertainty, DoesNotCountTurnsAboutTheAxisOfSymmetry) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 2) / 3;
  Map unseen = Map::Zero();
  unseen.topLeftCorner<3, 3>() = axis * axis.transpose();
  PoseUncertainty uncertainty;
  for (int frame = 0; frame < 9; ++frame)
    uncertainty.update(sigmas(kTurn_rad, 0), unseen, kNoError);
  EXPECT_NEAR(uncertainty.probability_within(kWithin_mm, kWithin_rad, kNoAxis),
              normal_within(kWithin_rad, 3 * kTurn_rad), 1e-9);
  EXPECT_NEAR(uncertainty.probability_within(kWithin_mm, kWithin_rad, axis), 1, 1e-9);
  EXPECT_NEAR(uncertainty.probability_within(kWithin_mm, kWithin_rad, -axis), 1, 1e-9);
  EXPECT_LT(uncertainty.probability_within(kWithin_mm, kWithin_rad, axis.unitOrthogonal()), 0.5)
      << "turns about another axis do";
}

TEST(PoseUncertainty, IsAtLeastTheErrorOfWhatIsSeen) {
  Map error = Map::Zero();
  error(1, 1) = kTurn_rad * kTurn_rad;
  PoseUncertainty uncertainty;
  for (int frame = 0; frame < 5; ++frame) {
    uncertainty.update(sigmas(kTurn_rad, kShift_mm), Map::Zero(), error);
    EXPECT_NEAR(uncertainty.probability_within(kWithin_mm, kWithin_rad, kNoAxis),
                normal_within(kWithin_rad, kTurn_rad), 1e-9)
        << "it does not add up, frame " << frame;
  }
  EXPECT_EQ(uncertainty.probability_within(kWithin_mm, kWithin_rad, Eigen::Vector3d::UnitY()), 1);
}

}  // namespace
}  // namespace anneal6d
