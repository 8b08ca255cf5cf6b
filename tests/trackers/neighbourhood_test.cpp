// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "neighbourhood.h"

#include <gtest/gtest.h>

#include "confirmation.h"
#include "twist.h"

namespace anneal6d {
namespace {

constexpr double kRadius_mm = 50, kFocal_px = 600;
const Eigen::Vector3d kCenter_mm(30, -20, 10);

/// An object whose centre is 600 mm away: a pixel is a millimetre.
Refiner::Result refined() {
  Refiner::Result result;
  result.camera_from_object.rotation = rotation_from_vector(Eigen::Vector3d(0.3, -0.2, 0.5));
  result.camera_from_object.translation_mm =
      Eigen::Vector3d(15, 5, 600) - result.camera_from_object.rotation * kCenter_mm;
  result.weak_motions = {0.01 * Twist::Unit(1), 2.0 * Twist::Unit(5)};
  return result;
}
const Neighbourhood& neighbourhood() {
  static const Neighbourhood around(kCenter_mm, kRadius_mm, kFocal_px);
  return around;
}
/// How the object moves about its centre from the refined pose to this one.
Twist motion_to(const Pose& pose) {
  return twist_between(with_origin_at(kCenter_mm, refined().camera_from_object),
                       with_origin_at(kCenter_mm, pose));
}

TEST(NeighboursOfAPose, LieOnBothSidesAlongItsWeakMotions) {
  for (const std::uint32_t motion : {0U, 2U}) {
    const Twist weak = refined().weak_motions[motion / 2];
    for (const double steps : {1.0, 2.0}) {
      const auto [before, behind] = neighbourhood().beside(refined(), motion, steps);
      EXPECT_LT((motion_to(before) + 4 * steps * weak).norm(), 1e-9);
      EXPECT_LT((motion_to(behind) - 4 * steps * weak).norm(), 1e-9);
    }
  }
}

TEST(NeighboursOfAPose, LieThreePixelsAside) {
  const auto [above, below] = neighbourhood().beside(refined(), 1);
  EXPECT_LT((motion_to(above) + 3 * Twist::Unit(4)).norm(), 1e-9);
  EXPECT_LT((motion_to(below) - 3 * Twist::Unit(4)).norm(), 1e-9);
  const auto [left, right] = neighbourhood().beside(refined(), 3);
  EXPECT_LT((motion_to(left) + 3 * Twist::Unit(3)).norm(), 1e-9);
  EXPECT_LT((motion_to(right) - 3 * Twist::Unit(3)).norm(), 1e-9);
}

TEST(NeighboursOfAPose, AreInOnePlaceIfTheyAreLessThanAPixelApart) {
  const Pose here = refined().camera_from_object;
  const auto moved_by = [&](const Twist& motion) {
    return with_origin_at(-kCenter_mm, moved(with_origin_at(kCenter_mm, here), motion));
  };
  EXPECT_TRUE(neighbourhood().same_place(here, here));
  EXPECT_TRUE(neighbourhood().same_place(here, moved_by(0.9 * Twist::Unit(3))));
  EXPECT_FALSE(neighbourhood().same_place(here, moved_by(1.1 * Twist::Unit(3))));
  EXPECT_TRUE(neighbourhood().same_place(here, moved_by(0.9 / kRadius_mm * Twist::Unit(0))));
  EXPECT_FALSE(neighbourhood().same_place(here, moved_by(1.1 / kRadius_mm * Twist::Unit(0))));
}

TEST(UnseenShareOfAPose, IsThatOfItsWeakestMotion) {
  Refiner::Result result = refined();
  EXPECT_NEAR(neighbourhood().unseen_share(result), 1, 1e-12) << "nothing is seen";
  result.unseen(1, 1) = 0.25;
  EXPECT_NEAR(neighbourhood().unseen_share(result), 0.25, 1e-12);
}

TEST(ConfirmationOfAPose, GrowsWithSupportBeyondChance) {
  EXPECT_LT(confirmation_of(0.3, 0.3), 0.2);
  EXPECT_GT(confirmation_of(0.3 + 0.7 * 0.25, 0.3), 0.9);
  EXPECT_EQ(confirmation_of(1, 0.3), 1);
  EXPECT_EQ(confirmation_of(0.1, 0.9), 0);
  EXPECT_LT(confirmation_of(1, 1), 0.2) << "nothing is beyond a chance of 1";
  double last = 0;
  for (double support = 0; support <= 1; support += 0.05) {
    const double here = confirmation_of(support, 0.2);
    EXPECT_GE(here, last);
    last = here;
  }
}

}  // namespace
}  // namespace anneal6d
