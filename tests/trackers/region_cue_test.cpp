// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "region_cue.h"

#include <gtest/gtest.h>

#include "refiner.h"
#include "synthetic.h"

namespace anneal6d {
namespace {

/// A box of one colour before a background of another.
class ColouredBox : public testing::Test {
 protected:
  ColouredBox() : image_(camera_.height_px, camera_.width_px, CV_8UC3, cv::Scalar(120, 80, 30)) {
    const test::Drawing drawing = test::draw(model(), camera_, truth_);
    image_.setTo(cv::Scalar(30, 60, 180), drawing.depth_mm > 0);
    refiner_.set_image(image_, {0, 0, image_.cols, image_.rows});
    cue_.set_image(refiner_.picture(), appearance_);
  }

  static const test::SharedMesh& mesh() {
    static const auto box = test::make_box(90, 60, 75);
    return box;
  }
  static const RasterModel& model() {
    static const RasterModel model(mesh(), false);
    return model;
  }
  static const ViewModel& views() {
    static const ViewModel views(model(), {.threshold = 40}, Shading{}, 0, {});
    return views;
  }

  void teach() {
    refiner_.teach(truth_, appearance_);
    cue_.set_image(refiner_.picture(), appearance_);
  }
  double score(const Pose& pose) const {
    double score = 0;
    cue_.score({&pose, 1}, {&score, 1});
    return score;
  }

  CameraModel camera_ = test::small_camera();
  Pose truth_{rotation_from_axis_angle({1, 1, 0}, 0.8), {5, -3, 320}};
  cv::Mat image_;
  Appearance appearance_{3};
  Workers workers_{1};
  Refiner refiner_{views(), camera_, workers_};
  RegionCue cue_{views(), camera_, workers_};
};

TEST_F(ColouredBox, SaysNothingBeforeColoursAreLearned) { EXPECT_EQ(score(truth_), 0); }

TEST_F(ColouredBox, SaysNothingOutsideThePicture) {
  teach();
  refiner_.set_image(image_, {0, 0, 3, 100});  // too narrow to be looked at
  ASSERT_TRUE(refiner_.picture().smooth.empty());
  cue_.set_image(refiner_.picture(), appearance_);
  EXPECT_EQ(score(truth_), 0);
}

TEST_F(ColouredBox, FitsBestWhereItIs) {
  teach();
  const double best = score(truth_);
  EXPECT_GT(best, 0.8);
  EXPECT_LE(best, 1.0);
  for (const double sign : {-1.0, 1.0}) {
    double last = best;
    for (const double shift_mm : {12.0, 24.0, 36.0}) {
      const double here =
          score(test::beside(*mesh(), truth_, {0, 0, 0}, {sign * shift_mm, sign * shift_mm, 0}));
      EXPECT_LT(here, last) << sign * shift_mm << " mm aside";
      last = here;
    }
    EXPECT_LT(score(test::beside(*mesh(), truth_, {0, 0, sign * 20}, {0, 0, 0})), best) << "turned";
    EXPECT_LT(score(test::beside(*mesh(), truth_, {0, 0, 0}, {0, 0, sign * 60})), best) << "far";
  }
}

TEST_F(ColouredBox, SaysNothingOfPosesOutsideThePicture) {
  teach();
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(5000, 0, 320), Eigen::Vector3d(0, 0, -320), Eigen::Vector3d(0, 0, 0)}) {
    const double here = score({truth_.rotation, place});
    EXPECT_TRUE(std::isfinite(here)) << place.transpose();
    EXPECT_LT(std::abs(here), 0.5) << place.transpose();
  }
}

}  // namespace
}  // namespace anneal6d
