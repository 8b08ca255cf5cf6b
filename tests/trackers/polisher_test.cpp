// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "polisher.h"

#include <gtest/gtest.h>

#include "synthetic.h"

namespace anneal6d {
namespace {

using test::beside;
using test::center_distance_mm;

/// A box before a plain background, which polishing alone finds from a pixel or so beside it.
class PolishingABox : public testing::Test {
 protected:
  PolishingABox() {
    refiner_.set_image(image_, {0, 0, image_.cols, image_.rows});
    expected_.camera_from_center = filter_.to_center(truth_);
    expected_.sigma << Eigen::Vector3d::Constant(3 * test::kDegree), 5, 5, 5;
  }

  static ScorerSetup setup(const std::shared_ptr<const TriangleMesh>& mesh,
                           const CameraModel& camera) {
    ScorerSetup setup;
    setup.mesh = mesh;
    setup.camera = camera;
    setup.edges.threshold = 40;
    return setup;
  }

  /// So many pixels to the right of the truth.
  Pose aside(double shift_px) const {
    const double mm = shift_px * truth_.translation_mm.z() / camera_.fx_px;
    return beside(*model_.mesh, truth_, {0, 0, 0}, {mm, 0, 0});
  }

  /// How far from the truth polishing ends, millimetres.
  double polished_mm(const Pose& start, const Pose& guess) {
    Refiner::Result refined = refiner_.refine(truth_, truth_, 3, appearance_);  // weak motions
    refined.camera_from_object = start;
    exact_.draw(start, test::workers());
    const Refiner::Result polished =
        polisher_.polish(refined, {exact_, expected_, guess, Twist::Zero(), appearance_});
    return center_distance_mm(*model_.mesh, polished.camera_from_object, truth_);
  }

  const CameraModel camera_ = test::small_camera().scaled(2);
  const Pose truth_ = test::corner_view();
  const RasterModel model_{test::make_box(90, 60, 75), false};
  const ViewModel views_ = test::views_near(model_, truth_);
  const cv::Mat image_ = test::photograph(model_, camera_, truth_);
  const Appearance appearance_{1};
  test::NoScorer scorer_;
  Refiner refiner_{views_, camera_, test::workers()};
  PoseFilter filter_{scorer_, {}, model_.mesh->center_mm().cast<double>(), test::workers()};
  PoseSearch search_{filter_, refiner_, test::workers(), {1, 1}, model_.mesh->radius_mm()};
  Neighbourhood neighbourhood_{model_.mesh->center_mm().cast<double>(), model_.mesh->radius_mm(),
                               camera_.fx_px};
  ExactContour exact_{setup(model_.mesh, camera_)};
  Polisher polisher_{refiner_, search_, neighbourhood_, test::workers(), true};
  Expectation expected_;
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
