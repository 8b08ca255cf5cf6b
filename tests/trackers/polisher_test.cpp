// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "polisher.h"

#include <gtest/gtest.h>

#include "box_scene.h"

namespace anneal6d {
namespace {

using test::beside;
using test::center_distance_mm;

/// A box before a plain background, which polishing alone finds from a pixel or so beside it.
class PolishingABox : public test::BoxScene {
 protected:
  PolishingABox() : BoxScene(3, 5) { show(test::photograph(model_, camera_, truth_)); }

  ScorerSetup setup() const {
    ScorerSetup setup;
    setup.mesh = model_.mesh;
    setup.camera = camera_;
    setup.edges.threshold = 40;
    return setup;
  }

  /// So many pixels to the right of the truth.
  Pose aside(double shift_px) const {
    const double mm = shift_px * truth_.translation_mm.z() / camera_.fx_px;
    return beside(mesh(), truth_, {0, 0, 0}, {mm, 0, 0});
  }

  /// How far from the truth polishing ends, millimetres.
  double polished_mm(const Pose& start, const Pose& guess) {
    Refiner::Result refined = refiner_.refine(truth_, truth_, 3, appearance_);  // weak motions
    refined.camera_from_object = start;
    exact_.draw(start, test::workers());
    const Refiner::Result polished =
        polisher_.polish(refined, {exact_, expected_, guess, Twist::Zero(), appearance_});
    return center_distance_mm(mesh(), polished.camera_from_object, truth_);
  }

  Neighbourhood neighbourhood_{mesh().center_mm().cast<double>(), mesh().radius_mm(),
                               camera_.fx_px};
  ExactContour exact_{setup()};
  Polisher polisher_{refiner_, search_, neighbourhood_, test::workers(), true};
};

TEST_F(PolishingABox, FindsItsPlaceNearBy) { EXPECT_LT(polished_mm(aside(0.5), aside(0.5)), 0.05); }

TEST_F(PolishingABox, LeavesAFalseBottomPixelsAside) {
  for (const double shift_px : {-5.5, 5.5}) {
    EXPECT_LT(polished_mm(aside(shift_px), aside(3 * shift_px)), 0.05) << shift_px;
  }
}

TEST_F(PolishingABox, PrefersTheMotionModelsGuessIfThatFitsBetter) {
  EXPECT_LT(polished_mm(aside(12), aside(1)), 0.05);
  EXPECT_GT(polished_mm(aside(12), aside(12)), 1) << "too easy to show anything";
}

TEST_F(PolishingABox, DoesNotJumpToAPlaceThatTheMotionModelFindsStrange) {
  expected_.sigma *= 1e-9;
  expected_.camera_from_center = filter_.to_center(aside(4));
  EXPECT_GT(polished_mm(aside(4), aside(4)), 1);
}

TEST_F(PolishingABox, IsTheSameOnAnyNumberOfThreads) {
  Workers three(3);
  Polisher together(refiner_, search_, neighbourhood_, three, true);
  Refiner::Result refined = refiner_.refine(aside(2), truth_, 3, appearance_);
  exact_.draw(refined.camera_from_object, three);
  const Polisher::Scene scene{exact_, expected_, truth_, Twist::Zero(), appearance_};
  EXPECT_EQ(polisher_.polish(refined, scene).camera_from_object.translation_mm,
            together.polish(refined, scene).camera_from_object.translation_mm);
}

}  // namespace
}  // namespace anneal6d
