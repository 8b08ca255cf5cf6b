// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "pose_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "box_scene.h"

namespace anneal6d {
namespace {

using test::beside;

/// A box before a fence of slats, a board in front of a third of it.
class HoppingOnABoxAmongClutter : public test::BoxScene {
 protected:
  HoppingOnABoxAmongClutter() : BoxScene(6, 10) { show(image_); }

  static cv::Mat picture(const RasterModel& model, const CameraModel& camera, const Pose& pose) {
    cv::Mat image = test::photograph(model, camera, pose, 120, 1.0);
    const cv::Mat background = test::draw(model, camera, pose).depth_mm == 0;
    cv::Mat slats = image.clone();
    for (int x = -200; x < image.cols; x += 22) {
      cv::line(slats, {x, 0}, {x + 150, image.rows}, cv::Scalar(x % 4 == 0 ? 60 : 200), 6,
               cv::LINE_AA);
    }
    slats.copyTo(image, background);
    const int middle = static_cast<int>(camera.cx_px);
    cv::rectangle(image, {middle + 10, 0, 60, image.rows}, cv::Scalar(150), cv::FILLED);
    return image;
  }

  /// Ten pixels or so beside the truth.
  Pose start(std::uint32_t i) const {
    const Twist noise = random_twist({.seed = 5, .particle = i});
    return beside(mesh(), truth_, 4.0 * noise.head<3>(), 4.0 * noise.tail<3>());
  }

  Refiner::Result hop(const Refiner::Result& from, std::uint32_t i = 0) {
    return search_.hop_from(from, expected_, appearance_, {.seed = 3, .frame = i}, camera_.fx_px);
  }

  const cv::Mat image_ = picture(model_, camera_, truth_);
};

TEST_F(HoppingOnABoxAmongClutter, LeadsOutOfFalseBasins) {
  const auto found = [&](const Refiner::Result& result) {
    return test::center_distance_mm(mesh(), result.camera_from_object, truth_) < 2 &&
           test::angle_deg(result.camera_from_object, truth_) < 1;
  };
  int refined = 0, hopped = 0;
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Refiner::Result first = refiner_.refine(start(i), truth_, 10, appearance_);
    refined += found(first);
    const Refiner::Result then = hop(first, i);
    hopped += found(then);
    EXPECT_GE(search_.likelihood(then, expected_), search_.likelihood(first, expected_)) << i;
  }
  EXPECT_LE(refined, 12) << "too easy to show anything";
  EXPECT_GE(hopped, 15);
}

TEST_F(HoppingOnABoxAmongClutter, StaysWhereNothingIsBetter) {
  Refiner::Result best = refiner_.refine(truth_, truth_, 3, appearance_);
  best.support = best.fit = 1;
  const Refiner::Result stayed = hop(best);
  EXPECT_EQ(test::angle_deg(stayed.camera_from_object, best.camera_from_object), 0);
  EXPECT_EQ(stayed.camera_from_object.translation_mm, best.camera_from_object.translation_mm);
}

TEST_F(HoppingOnABoxAmongClutter, IsTheSameOnAnyNumberOfThreads) {
  const Refiner::Result first = refiner_.refine(start(1), truth_, 10, appearance_);
  const Pose alone = hop(first).camera_from_object;
  Workers three(3);
  PoseSearch search(filter_, refiner_, three, {1, 1}, mesh().radius_mm());
  const Pose together =
      search.hop_from(first, expected_, appearance_, {.seed = 3}, camera_.fx_px).camera_from_object;
  EXPECT_EQ(alone.translation_mm, together.translation_mm);
  EXPECT_EQ(alone.rotation.coeffs(), together.rotation.coeffs());
}

/// The same box and fence, the box of a colour that the fence has not.
class SearchingForAColouredBox : public HoppingOnABoxAmongClutter {
 protected:
  SearchingForAColouredBox() { show(coloured_); }

  cv::Mat coloured() const {
    const cv::Mat object = test::draw(model_, camera_, truth_).depth_mm > 0;
    cv::Mat blue = image_.clone();
    cv::Mat(0.5 * image_).copyTo(blue, object & (image_ != 150));  // but for the board
    cv::Mat image;
    cv::merge(std::vector{blue, image_, image_}, image);
    return image;
  }

  /// Of searches from eight places, `shift_px` beside the truth, those that find it.
  int found_from(double shift_px, const Appearance& appearance) {
    int found = 0;
    for (int i = 0; i < 8; ++i) {
      const double angle = i * std::numbers::pi / 4;
      const double mm = shift_px * truth_.translation_mm.z() / camera_.fx_px;
      expected_.camera_from_center = filter_.to_center(truth_);
      expected_.camera_from_center.translation_mm +=
          mm * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      const Refiner::Result result = search_.run(expected_, {appearance, 0}, {}, camera_.fx_px);
      found += test::center_distance_mm(mesh(), result.camera_from_object, truth_) < 2;
    }
    return found;
  }

  const cv::Mat coloured_ = coloured();
  Appearance learned_{3};
};

TEST_F(SearchingForAColouredBox, IsLedByColoursFromFartherThanEdgesReach) {
  constexpr double kShift_px = 18;
  refiner_.teach(truth_, learned_);
  EXPECT_LE(found_from(kShift_px, Appearance(3)), 3) << "too easy to show anything";
  EXPECT_GE(found_from(kShift_px, learned_), 6);
}

TEST_F(SearchingForAColouredBox, HopsFartherWhereColoursLead) {
  constexpr double kShift_mm = 30;  // nearly sixty pixels, of which a hop is six
  refiner_.teach(truth_, learned_);
  int found = 0;
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Pose far = beside(mesh(), truth_, {0, 0, 0}, {i % 2 ? kShift_mm : -kShift_mm, 0, 0});
    const Refiner::Result first = refiner_.examine(far, learned_);
    const Refiner::Result then =
        search_.hop_from(first, expected_, learned_, {.seed = 3, .frame = i}, camera_.fx_px);
    found += test::center_distance_mm(mesh(), then.camera_from_object, truth_) < 2;
  }
  EXPECT_GE(found, 15);
}

// A motion three times as large as expected is strange, but not nine times as strange.
TEST(Strangeness, GrowsSlowerFarOut) {
  Expectation expected;
  expected.sigma.setConstant(2);
  const auto of = [&](double mm) {
    Pose pose;
    pose.translation_mm.x() = mm;
    return expected.strangeness(pose);
  };
  EXPECT_EQ(of(0), 0);
  EXPECT_GT(of(2), 0);
  EXPECT_GT(of(8), of(4));
  EXPECT_LT(of(30), 4 * of(10));
  EXPECT_NEAR(of(4) / of(2), 4, 0.7);
}

}  // namespace
}  // namespace anneal6d
