// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "refiner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "anneal6d/framework/srgb.h"
#include "synthetic.h"
#include "view_painter.h"
#include "workers.h"

namespace anneal6d {
namespace {

using test::angle_deg;
using test::beside;
using test::center_distance_mm;
using test::corner_view;
using test::SharedMesh;

CameraModel camera() { return test::small_camera().scaled(2); }

/// Views of a mesh, drawn once in a test program.
struct Object {
  explicit Object(SharedMesh of, bool textured = false)
      : mesh(std::move(of)),
        model(mesh, textured),
        views(model, {.threshold = 40}, Shading{}, 0, {}) {}

  SharedMesh mesh;
  RasterModel model;
  ViewModel views;
};

const Object& box() {
  static const Object object(test::make_box(90, 60, 75));
  return object;
}

cv::Rect whole(const cv::Mat& image) { return {0, 0, image.cols, image.rows}; }

/// Without colours, and expecting what it starts from.
Refiner::Result refine(Refiner& refiner, const Pose& start, int channels = 1) {
  return refiner.refine(start, start, 8, Appearance(channels));
}

/// Refines from beside the truth and returns what is left to it.
struct Left {
  double mm, deg, support;
};
Left left_after_refining(const Object& object, const cv::Mat& image, const Pose& truth,
                         const Eigen::Vector3d& turn_deg, const Eigen::Vector3d& shift_mm) {
  Refiner refiner(object.views, camera(), test::workers());
  refiner.set_image(image, whole(image));
  const auto result =
      refine(refiner, beside(*object.mesh, truth, turn_deg, shift_mm), image.channels());
  return {center_distance_mm(*object.mesh, result.camera_from_object, truth),
          angle_deg(result.camera_from_object, truth), result.support};
}

class RefiningABox : public testing::TestWithParam<int> {};  // the background's grey level

TEST_P(RefiningABox, FindsBackToTheTruth) {
  const Pose truth = corner_view();
  const cv::Mat image = test::photograph(box().model, camera(), truth, GetParam(), 1.0);
  for (std::uint32_t i = 0; i < 8; ++i) {
    const auto a = random_normals({.seed = 31, .particle = i}, 0);
    const auto b = random_normals({.seed = 31, .particle = i}, 1);
    const auto c = random_normals({.seed = 31, .particle = i}, 2);
    const Left left = left_after_refining(box(), image, truth, {0.7 * a[0], 0.7 * a[1], 0.7 * b[0]},
                                          {0.7 * b[1], 0.7 * c[0], 2.5 * c[1]});
    EXPECT_LT(left.mm, 0.1) << "start " << i;
    EXPECT_LT(left.deg, 0.1) << "start " << i;
    EXPECT_GT(left.support, 0.8) << "start " << i;
  }
}

// Darker than every face, and between them.
INSTANTIATE_TEST_SUITE_P(Background, RefiningABox, testing::Values(20, 120),
                         testing::PrintToStringParamName());

TEST(Refining, StaysAtTheTruth) {
  const Pose truth = corner_view();
  const cv::Mat image = test::photograph(box().model, camera(), truth, 20);
  const Left left = left_after_refining(box(), image, truth, {0, 0, 0}, {0, 0, 0});
  EXPECT_LT(left.mm, 0.1);
  EXPECT_LT(left.deg, 0.1);
}

TEST(Refining, TakesColourImages) {
  const Pose truth = corner_view();
  cv::Mat colour;
  cv::cvtColor(test::photograph(box().model, camera(), truth, 20), colour, cv::COLOR_GRAY2BGR);
  const Left left = left_after_refining(box(), colour, truth, {0.5, -0.5, 0.5}, {0.5, 0.5, 2});
  EXPECT_LT(left.mm, 0.1);
  EXPECT_LT(left.deg, 0.1);
}

TEST(Refining, UsesTheTextureWhereTheShapeSaysNothing) {
  // A sphere: only its texture tells how it is turned.
  cv::Mat patches(64, 128, CV_8UC3);
  for (int row = 0; row < patches.rows; ++row) {
    for (int column = 0; column < patches.cols; ++column) {
      patches.at<cv::Vec3b>(row, column) = cv::Vec3b::all((row / 16 + column / 16) % 2 ? 240 : 70);
    }
  }
  const Object sphere(test::make_grid(
                          48, 2 * EIGEN_PI, 24, -EIGEN_PI / 2, EIGEN_PI / 2,
                          [](double u, double v) {
                            MeshVertex vertex;
                            vertex.normal = Eigen::Vector3d(std::cos(u) * std::cos(v),
                                                            std::sin(u) * std::cos(v), std::sin(v))
                                                .cast<float>();
                            vertex.position_mm = 50 * vertex.normal;
                            return vertex;
                          },
                          patches),
                      true);
  const Pose truth{rotation_from_axis_angle({1, 0.3, 0}, 1.2), {0, 0, 320}};
  const cv::Mat image = test::photograph(sphere.model, camera(), truth, 20);
  const Left left = left_after_refining(sphere, image, truth, {1, 1, -1}, {0.5, 0.5, 1});
  EXPECT_LT(left.deg, 0.5);
  EXPECT_LT(left.mm, 1.0);
}

TEST(Refining, SlidesTheOutlineOfARoundObjectToWhereTheCameraSeesIt) {
  // Its views are seen from afar: where they have the outline, the ball would be too near.
  const Object ball(test::make_coloured_sphere(50));
  for (std::uint32_t i = 0; i < 6; ++i) {
    const Pose truth{test::random_rotation({.seed = 6, .particle = i}), {10, -5, 250}};
    const cv::Mat image = test::photograph(ball.model, camera(), truth, 11);
    const Left left = left_after_refining(ball, image, truth, {0, 0, 0}, {0.5, -0.5, 2});
    EXPECT_LT(left.mm, 0.5) << "pose " << i;
  }
}

TEST(Refining, ReportsNoSupportWhereThereIsNoObject) {
  const cv::Mat empty(camera().height_px, camera().width_px, CV_8UC1, cv::Scalar(90));
  EXPECT_LT(left_after_refining(box(), empty, corner_view(), {0, 0, 0}, {0, 0, 0}).support, 0.1);
}

TEST(Refining, KeepsThePoseWhereThereIsNothingToSee) {
  Refiner refiner(box().views, camera(), test::workers());
  const cv::Mat empty(camera().height_px, camera().width_px, CV_8UC1, cv::Scalar(90));
  for (const Pose& start :
       {corner_view(), Pose{corner_view().rotation, {0, 0, -300}},
        Pose{corner_view().rotation, {5000, 0, 300}}, Pose{corner_view().rotation, {0, 0, 20}}}) {
    refiner.set_image(empty, whole(empty));
    const auto result = refine(refiner, start);
    EXPECT_TRUE(result.camera_from_object.is_finite());
    EXPECT_LT(center_distance_mm(*box().mesh, result.camera_from_object, start), 1e-6);
    EXPECT_LT(angle_deg(result.camera_from_object, start), 1e-6);
  }
}

TEST(Refining, StaysFiniteOnNoise) {
  const Object torus(test::make_torus(50, 20));
  Refiner refiner(torus.views, camera(), test::workers());
  cv::Mat noise(camera().height_px, camera().width_px, CV_8UC1);
  cv::RNG random(2);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const RandomKey key{.seed = 5, .particle = i};
    const Pose start{
        test::random_rotation(key),
        {test::random_between(key, 0, -100, 100), test::random_between(key, 1, -80, 80),
         test::random_between(key, 2, 60, 500)}};
    refiner.set_image(noise, whole(noise));
    const auto result = refine(refiner, start);
    EXPECT_TRUE(result.camera_from_object.is_finite()) << "start " << i;
    EXPECT_NEAR(result.camera_from_object.rotation.norm(), 1, 1e-9) << "start " << i;
  }
}

TEST(Refining, LooksAtItsWindowOnly) {
  const Pose truth = corner_view();
  const cv::Mat image = test::photograph(box().model, camera(), truth, 20);
  Refiner refiner(box().views, camera(), test::workers());
  const Pose start = beside(*box().mesh, truth, {0.5, -0.5, 0.5}, {0.5, 0.5, 2});
  for (const cv::Rect& elsewhere : {cv::Rect(0, 0, 40, 40), cv::Rect(-90, -90, 50, 50),
                                    cv::Rect(5000, 0, 100, 100), cv::Rect()}) {
    refiner.set_image(image, elsewhere);
    const auto result = refine(refiner, start);
    EXPECT_EQ(result.support, 0);
    EXPECT_EQ(result.camera_from_object.translation_mm, start.translation_mm);
  }
  refiner.set_image(image, cv::Rect(-20, -20, image.cols, image.rows + 40));
  EXPECT_LT(center_distance_mm(*box().mesh, refine(refiner, start).camera_from_object, truth),
            0.15);
}

TEST(Refining, TakesWhatTheEdgesLeaveOpenFromTheExpectedPose) {
  // A bowl looks the same however it is turned about its axis.
  const Object bowl(test::make_bowl(50));
  const Pose truth = test::pose_with_center(
      *bowl.mesh, rotation_from_axis_angle(Eigen::Vector3d::UnitX(), 2.4), {0, 0, 320});
  const cv::Mat image = test::photograph(bowl.model, camera(), truth, 20);
  Refiner refiner(bowl.views, camera(), test::workers());
  refiner.set_image(image, whole(image));
  const Eigen::Quaterniond turn = rotation_from_axis_angle(Eigen::Vector3d::UnitZ(), 0.35);
  const Pose expected{truth.rotation * turn, truth.translation_mm};
  const auto result = refiner.refine(beside(*bowl.mesh, expected, {0.5, 0, 0}, {0.5, 0.5, 1}),
                                     expected, 8, Appearance(1));
  EXPECT_LT(angle_deg(result.camera_from_object, expected), 1.0);
  EXPECT_LT(center_distance_mm(*bowl.mesh, result.camera_from_object, truth), 0.5);
}

TEST(Refining, LearnsTheColoursOnBothSidesOfTheSilhouette) {
  const Pose truth = corner_view();
  const cv::Mat image = test::photograph(box().model, camera(), truth, 20);
  Refiner refiner(box().views, camera(), test::workers());
  refiner.set_image(image, whole(image));
  Appearance appearance(1);
  refiner.teach(truth, appearance);
  ASSERT_TRUE(appearance.learned());
  const cv::Mat background(1, 4, CV_8UC1, cv::Scalar(20));
  EXPECT_LT(appearance.log_odds(appearance.bin(background.data)), -Appearance::kScale);
  const Eigen::Vector2d middle = camera().project(truth.translation_mm);
  const auto* const face = image.ptr(static_cast<int>(middle.y())) + static_cast<int>(middle.x());
  EXPECT_GE(appearance.log_odds(appearance.bin(face)), 0);
}

/// What approaching leaves of a shift across the line of sight, with colours learned at the truth.
double left_after_approaching_mm(double shift_mm, bool learned) {
  const Pose truth = corner_view();
  const cv::Mat image = test::photograph(box().model, camera(), truth, 20);
  Refiner refiner(box().views, camera(), test::workers());
  refiner.set_image(image, whole(image));
  Appearance appearance(1);
  if (learned) refiner.teach(truth, appearance);
  const Pose start = beside(*box().mesh, truth, {0, 0, 0}, {shift_mm, 0, 0});
  return center_distance_mm(*box().mesh, refiner.approach(start, appearance), truth);
}

TEST(ApproachingByColours, TakesMostOfALargeShiftAway) {
  constexpr double kFar_mm = 6;  // 12 pixels
  EXPECT_LT(left_after_approaching_mm(kFar_mm, true), 0.35 * kFar_mm);
}

TEST(ApproachingByColours, KeepsThePoseWithoutColours) {
  EXPECT_NEAR(left_after_approaching_mm(6, false), 6, 1e-9);
}

constexpr double kFeigned = 0.005;

/// A refinement before and after polishing.
struct Polished {
  Refiner::Result before, after;
};
Polished polish_beside(const Object& object, const Pose& truth, const Pose& start) {
  const cv::Mat image = test::photograph(object.model, camera(), truth, 20);
  Refiner refiner(object.views, camera(), test::workers());
  refiner.set_image(image, whole(image));
  ViewPainter painter(object.model, {.threshold = 40}, Shading{}, camera());
  Workers alone(1);
  const Refiner::Result before{.camera_from_object = start, .support = 0.5};
  return {before, refiner.polish(before, painter.paint_contour(start, 1000, 0, alone), kFeigned,
                                 Twist::Zero(), Appearance(1))};
}

TEST(PolishingAfterRefining, EndsWithinHundredthsOfAMillimetre) {
  const Pose truth = corner_view();
  const Pose start = beside(*box().mesh, truth, {0.2, -0.1, 0.1}, {0.1, -0.1, 0.5});
  const Polished polished = polish_beside(box(), truth, start);
  EXPECT_LT(center_distance_mm(*box().mesh, polished.after.camera_from_object, truth), 0.05);
  EXPECT_LT(angle_deg(polished.after.camera_from_object, truth), 0.03);
  EXPECT_EQ(polished.after.support, polished.before.support);  // of the refinement
}

TEST(PolishingAfterRefining, LeavesWhatTheEdgesLeaveOpen) {
  const Object bowl(test::make_bowl(50));
  const Pose truth = test::pose_with_center(
      *bowl.mesh, rotation_from_axis_angle(Eigen::Vector3d::UnitX(), 2.4), {0, 0, 320});
  const Eigen::Quaterniond turn = rotation_from_axis_angle(Eigen::Vector3d::UnitZ(), 0.35);
  const Pose turned{truth.rotation * turn, truth.translation_mm};
  const Pose start = beside(*bowl.mesh, turned, {0.2, 0, 0}, {0.1, 0.1, 0.3});
  const Pose after = polish_beside(bowl, truth, start).after.camera_from_object;
  EXPECT_LT(angle_deg(after, turned), 1.0);
  EXPECT_LT(center_distance_mm(*bowl.mesh, after, truth), 0.1);
}

TEST(PolishingAfterRefining, ReportsWhichMotionsTheExactContourShows) {
  const Pose truth = corner_view();
  EXPECT_LT(polish_beside(box(), truth, truth).after.unseen.norm(), 0.5);
}

/// What a camera sees of a box that moves so while the shutter is open, about `middle`.
cv::Mat blurred_photograph(const Pose& middle, const Eigen::Vector3d& way_mm) {
  constexpr int kMoments = 9;
  cv::Mat light;
  for (int i = 0; i < kMoments; ++i) {
    Pose pose = middle;
    pose.translation_mm += ((i + 0.5) / kMoments - 0.5) * way_mm;
    cv::Mat moment = test::photograph(box().model, camera(), pose, 20);
    cv::Mat table(1, 256, CV_32F);
    std::copy_n(srgb_light_table().begin(), 256, table.begin<float>());
    cv::LUT(moment, table, moment);
    if (light.empty()) light = cv::Mat::zeros(moment.size(), CV_32F);
    light += moment / kMoments;
  }
  cv::pow(light, 1 / 2.4, light);
  cv::Mat image;
  light.convertTo(image, CV_8U, 255 * 1.055, -255 * 0.055);
  return image;
}

TEST(PolishingAfterRefining, AllowsForTheBlurOfMotion) {
  const Pose truth = corner_view();
  const Eigen::Vector3d way_mm(2.5, 1.5, 0);  // four pixels
  const cv::Mat image = blurred_photograph(truth, way_mm);
  Refiner refiner(box().views, camera(), test::workers());
  refiner.set_image(image, whole(image));
  ViewPainter painter(box().model, {.threshold = 40}, Shading{}, camera());
  Workers alone(1);
  const ModelView contour = painter.paint_contour(truth, 1000, 0, alone);
  const auto depth_error_mm = [&](const Twist& blur) {
    const Refiner::Result start{.camera_from_object = truth};
    const Pose pose =
        refiner.polish(start, contour, kFeigned, blur, Appearance(1)).camera_from_object;
    return (pose * box().mesh->center_mm().cast<double>() -
            truth * box().mesh->center_mm().cast<double>())
        .z();
  };
  Twist blur = Twist::Zero();
  blur.tail<3>() = way_mm;
  const double untold_mm = depth_error_mm(Twist::Zero());
  EXPECT_LT(untold_mm, -0.3) << "what is bright looks large and near";
  EXPECT_LT(std::abs(depth_error_mm(blur)), 0.5 * std::abs(untold_mm));
}

TEST(PolishingAfterRefining, ChangesNothingWithoutAnImage) {
  const Refiner refiner(box().views, camera(), test::workers());
  ViewPainter painter(box().model, {.threshold = 40}, Shading{}, camera());
  Workers alone(1);
  const Refiner::Result before{.camera_from_object = corner_view(), .support = 0.5};
  const Refiner::Result after =
      refiner.polish(before, painter.paint_contour(before.camera_from_object, 1000, 0, alone),
                     kFeigned, Twist::Zero(), Appearance(1));
  EXPECT_EQ(after.camera_from_object.translation_mm, before.camera_from_object.translation_mm);
  EXPECT_EQ(after.unseen, before.unseen);
}

TEST(RefiningInAContourThatWasDrawn, FindsThePoseAndSaysHowWellItFits) {
  const Pose truth = corner_view();
  const cv::Mat image = test::photograph(box().model, camera(), truth, 20);
  Refiner refiner(box().views, camera(), test::workers());
  refiner.set_image(image, whole(image));
  ViewPainter painter(box().model, {.threshold = 40}, Shading{}, camera());
  Workers alone(1);
  const ModelView drawn = painter.paint_contour(truth, 1000, 0, alone);
  const Pose start = beside(*box().mesh, truth, {1.5, -1, 2}, {1, -1, 2});
  const Appearance none(1);
  const Pose found = refiner.refine_in(drawn, start, 4, none);
  EXPECT_LT(center_distance_mm(*box().mesh, found, truth), 0.3);
  EXPECT_LT(angle_deg(found, truth), 0.2);
  EXPECT_GT(refiner.examine_in(drawn, found, none).fit, 0.9);
  EXPECT_LT(refiner.examine_in(drawn, start, none).fit, 0.7);
  const Pose blind = refiner.refine_in(ModelView{}, start, 4, none);
  EXPECT_EQ(blind.translation_mm, start.translation_mm) << "no other contour";
  EXPECT_EQ(refiner.examine_in(ModelView{}, start, none).fit, 0);
}

// Named apart from the tests above, which ThreadSanitizer leaves out.
TEST(ARefinerOfSeveralThreads, GivesTheSamePosesAsOneAfterTheOther) {
  const Pose truth = corner_view();
  const RasterModel model(test::make_box(90, 60, 75), false);
  const ViewModel views = test::views_near(model, truth);
  const cv::Mat image = test::photograph(model, test::small_camera(), truth, 20, 1.0);
  Refiner refiner(views, test::small_camera(), test::workers());
  refiner.set_image(image, whole(image));
  Appearance appearance(1);
  refiner.teach(truth, appearance);
  constexpr std::size_t kStarts = 30;
  const auto refined = [&](std::size_t i) {
    const RandomKey key{.seed = 8, .particle = static_cast<std::uint32_t>(i)};
    const Pose start = beside(*model.mesh, truth, {test::random_between(key, 0, -2, 2), 1, -1},
                              {1, test::random_between(key, 1, -3, 3), 2});
    return refiner.refine(start, start, 8, appearance);
  };
  std::vector<Refiner::Result> alone(kStarts), together(kStarts);
  for (std::size_t i = 0; i < kStarts; ++i) alone[i] = refined(i);
  Workers(2).each(kStarts, 1, [&](std::size_t i) { together[i] = refined(i); });
  for (std::size_t i = 0; i < kStarts; ++i) {
    const Pose &a = alone[i].camera_from_object, &b = together[i].camera_from_object;
    EXPECT_EQ(a.translation_mm, b.translation_mm) << "start " << i;
    EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs()) << "start " << i;
    EXPECT_EQ(alone[i].evidence(), together[i].evidence()) << "start " << i;
    EXPECT_EQ(alone[i].unseen, together[i].unseen) << "start " << i;
  }
}

}  // namespace
}  // namespace anneal6d
