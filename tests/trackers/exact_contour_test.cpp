// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "exact_contour.h"

#include <gtest/gtest.h>

#include "synthetic.h"

namespace anneal6d {
namespace {

using test::beside;
using test::corner_view;

class ContourDrawnWhileTracking : public testing::Test {
 protected:
  ContourDrawnWhileTracking() : exact(setup()) { exact.draw(corner_view(), workers); }

  static ScorerSetup setup() {
    ScorerSetup setup;
    setup.mesh = test::make_box(90, 60, 75);
    setup.camera = test::small_camera();
    setup.edges.threshold = 40;
    return setup;
  }

  /// Somewhere on the contour, object frame: another place after each drawing from elsewhere.
  Eigen::Vector3f place_mm() const { return exact.contour().contour.at(0).object_mm; }

  Pose turned_deg(const Eigen::Vector3d& angles) const {
    return beside(*setup().mesh, corner_view(), angles, {0, 0, 0});
  }

  Workers workers{1};
  ExactContour exact;
};

TEST_F(ContourDrawnWhileTracking, IsDrawnAgainWhereTheObjectLooksDifferent) {
  const Eigen::Vector3f before_mm = place_mm();
  exact.draw(turned_deg({0, 2, 0}), workers);
  EXPECT_NE(place_mm(), before_mm);
  ExactContour fresh(setup());
  fresh.draw(turned_deg({0, 2, 0}), workers);
  EXPECT_EQ(place_mm(), fresh.contour().contour.at(0).object_mm);
  EXPECT_EQ(exact.contour().contour.size(), fresh.contour().contour.size());
}

TEST_F(ContourDrawnWhileTracking, ServesALittleBesideItsViewpoint) {
  const Eigen::Vector3f before_mm = place_mm();
  exact.draw(turned_deg({0, 1, 0}), workers);
  EXPECT_EQ(place_mm(), before_mm);
}

TEST_F(ContourDrawnWhileTracking, ServesWhereTheImageIsShiftedOrTurned) {
  const Eigen::Vector3f before_mm = place_mm();
  exact.draw(beside(*setup().mesh, corner_view(), {0, 0, 0}, {1, -1, 1}), workers);
  EXPECT_EQ(place_mm(), before_mm);
  Pose rolled = corner_view();
  const Eigen::Quaterniond roll = rotation_from_axis_angle(Eigen::Vector3d::UnitZ(), 0.3);
  rolled.rotation = roll * rolled.rotation;
  rolled.translation_mm = roll * rolled.translation_mm;
  exact.draw(rolled, workers);
  EXPECT_EQ(place_mm(), before_mm);
}

TEST_F(ContourDrawnWhileTracking, IsDrawnAgainNearer) {
  const Eigen::Vector3f before_mm = place_mm();
  exact.draw(beside(*setup().mesh, corner_view(), {0, 0, 0}, {0, 0, -20}), workers);
  EXPECT_NE(place_mm(), before_mm);
}

TEST_F(ContourDrawnWhileTracking, IsDrawnAgainAfterTheImageCutItOff) {
  Pose outside = corner_view();
  const Eigen::Quaterniond pan = rotation_from_axis_angle(Eigen::Vector3d::UnitY(), 0.45);
  outside.rotation = pan * outside.rotation;
  outside.translation_mm = pan * outside.translation_mm;
  exact.reset();
  exact.draw(outside, workers);
  const std::size_t half = exact.contour().contour.size();
  EXPECT_GT(half, 0U);
  exact.draw(corner_view(), workers);
  EXPECT_GT(exact.contour().contour.size(), half + 20);
}

TEST_F(ContourDrawnWhileTracking, IsForgottenAtAReset) {
  const Pose near = turned_deg({0, 0.2, 0});
  const Eigen::Vector3f before_mm = place_mm();
  exact.draw(near, workers);
  EXPECT_EQ(place_mm(), before_mm);
  exact.reset();
  exact.draw(near, workers);
  EXPECT_NE(place_mm(), before_mm);
}

TEST_F(ContourDrawnWhileTracking, IsTrustedLessWithFewerTriangles) {
  ScorerSetup fine = setup();
  fine.mesh = test::make_cylinder(100, 30, 4096);
  EXPECT_LT(ExactContour(fine).feigned_share(), exact.feigned_share());
}

}  // namespace
}  // namespace anneal6d
