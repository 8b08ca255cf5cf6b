// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/symmetry.h"

#include <gtest/gtest.h>

#include "special_numbers.h"

namespace anneal6d {
namespace {

using test::kPi;

const Eigen::Quaterniond kReference = rotation_from_axis_angle({1, 2, 3}, 0.8);

Eigen::Quaterniond about_z(double angle_rad) {
  return rotation_from_axis_angle(Eigen::Vector3d::UnitZ(), angle_rad);
}

Symmetry half_turns_of_a_box() {
  Symmetry symmetry;
  for (int axis = 0; axis < 3; ++axis) {
    symmetry.rotations.push_back(rotation_from_axis_angle(Eigen::Vector3d::Unit(axis), kPi));
  }
  return symmetry;
}

TEST(NoSymmetry, LeavesRotationsAsTheyAre) {
  const Symmetry none;
  EXPECT_TRUE(none.is_none());
  const auto rotation = kReference * about_z(2.5);
  EXPECT_LT(angle_between(none.fold(rotation, kReference), rotation), 1e-12);
}

TEST(AxisOfRevolution, UndoesAnyTurnAboutIt) {
  Symmetry symmetry;
  symmetry.axis = Eigen::Vector3d::UnitZ();
  EXPECT_FALSE(symmetry.is_none());
  for (const double angle_rad : {0.0, 0.1, 2.0, kPi, -3.0, 5.0}) {
    EXPECT_LT(angle_between(symmetry.fold(kReference * about_z(angle_rad), kReference), kReference),
              1e-9)
        << angle_rad;
  }
}

TEST(AxisOfRevolution, KeepsTheTilt) {
  Symmetry symmetry;
  symmetry.axis = Eigen::Vector3d::UnitZ();
  const auto tilted = kReference * rotation_from_axis_angle({1, 1, 0}, 0.2);
  const auto folded = symmetry.fold(tilted * about_z(1.7), kReference);
  EXPECT_LT(angle_between(folded, tilted), 1e-9);
  EXPECT_LT((folded * Eigen::Vector3d::UnitZ() - tilted * Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(AxisOfRevolution, LeavesNothingCloserToTheReference) {
  Symmetry symmetry;
  symmetry.axis = Eigen::Vector3d(1, -2, 0.5).normalized();
  const auto rotation = rotation_from_axis_angle({3, -1, 2}, 1.9);
  const double folded_rad = angle_between(symmetry.fold(rotation, kReference), kReference);
  for (int i = 0; i < 360; ++i) {
    const auto turn = rotation_from_axis_angle(symmetry.axis, i * kPi / 180);
    EXPECT_GE(angle_between(rotation * turn, kReference), folded_rad - 1e-9) << i;
  }
}

TEST(DiscreteSymmetry, ChoosesTheEquivalentClosestToTheReference) {
  const Symmetry box = half_turns_of_a_box();
  const auto near = kReference * rotation_from_axis_angle({2, -1, 1}, 0.3);
  for (const Eigen::Quaterniond& turn : box.rotations) {
    EXPECT_LT(angle_between(box.fold(near * turn, kReference), near), 1e-9);
  }
  EXPECT_LT(angle_between(box.fold(near, kReference), near), 1e-12);
}

TEST(DiscreteSymmetry, CombinesWithAnAxis) {
  // A plain cylinder: any turn about z, and upside down.
  Symmetry cylinder = half_turns_of_a_box();
  cylinder.axis = Eigen::Vector3d::UnitZ();
  const auto flipped = kReference * rotation_from_axis_angle(Eigen::Vector3d::UnitX(), kPi);
  EXPECT_LT(angle_between(cylinder.fold(flipped * about_z(0.9), kReference), kReference), 1e-9);
}

TEST(Folding, GivesUnitQuaternions) {
  Symmetry symmetry = half_turns_of_a_box();
  symmetry.axis = Eigen::Vector3d::UnitY();
  EXPECT_NEAR(symmetry.fold(kReference * about_z(3), kReference).norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace anneal6d
