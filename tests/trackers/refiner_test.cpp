// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "refiner.h"

#include <gtest/gtest.h>

#include "synthetic.h"

namespace anneal6d {
namespace {

using test::angle_deg;
using test::beside;
using test::center_distance_mm;
using test::SharedMesh;

Refiner::Result refine(Refiner& refiner, const Pose& start) {
  Twist sigma;
  sigma << Eigen::Vector3d::Constant(2 * test::kDegree), Eigen::Vector3d::Constant(5);
  return refiner.refine(start, 8, sigma);
}

CameraModel camera() { return test::small_camera().scaled(2); }

Pose corner_view() {
  return {rotation_from_axis_angle(Eigen::Vector3d::UnitX(), 0.6) *
              rotation_from_axis_angle(Eigen::Vector3d::UnitY(), 0.7),
          {5, -3, 320}};
}

/// Refines from beside the truth and returns what is left to it.
struct Left {
  double mm, deg, support;
};
Left left_after_refining(const SharedMesh& mesh, const cv::Mat& image, const Pose& truth,
                         const Eigen::Vector3d& turn_deg, const Eigen::Vector3d& shift_mm,
                         bool textured = false) {
  const RasterModel model(mesh, textured);
  Refiner refiner(model, camera());
  const Pose start = beside(*mesh, truth, turn_deg, shift_mm);
  refiner.set_image(image, start);
  const auto result = refine(refiner, start);
  return {center_distance_mm(*mesh, result.camera_from_object, truth),
          angle_deg(result.camera_from_object, truth), result.support};
}

class RefiningABox : public testing::TestWithParam<int> {};  // the background's grey level

TEST_P(RefiningABox, FindsBackToTheTruth) {
  const auto box = test::make_box(90, 60, 75);
  const Pose truth = corner_view();
  const cv::Mat image = test::photograph(RasterModel(box, false), camera(), truth, GetParam(), 1.0);
  for (std::uint32_t i = 0; i < 8; ++i) {
    const auto a = random_normals({.seed = 31, .particle = i}, 0);
    const auto b = random_normals({.seed = 31, .particle = i}, 1);
    const auto c = random_normals({.seed = 31, .particle = i}, 2);
    const Left left = left_after_refining(box, image, truth, {0.7 * a[0], 0.7 * a[1], 0.7 * b[0]},
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
  const auto box = test::make_box(90, 60, 75);
  const Pose truth = corner_view();
  const cv::Mat image = test::photograph(RasterModel(box, false), camera(), truth, 20);
  const Left left = left_after_refining(box, image, truth, {0, 0, 0}, {0, 0, 0});
  EXPECT_LT(left.mm, 0.1);
  EXPECT_LT(left.deg, 0.1);
}

TEST(Refining, TakesColourImages) {
  const auto box = test::make_box(90, 60, 75);
  const Pose truth = corner_view();
  cv::Mat colour;
  cv::cvtColor(test::photograph(RasterModel(box, false), camera(), truth, 20), colour,
               cv::COLOR_GRAY2BGR);
  const Left left = left_after_refining(box, colour, truth, {0.5, -0.5, 0.5}, {0.5, 0.5, 2});
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
  const auto sphere = test::make_grid(
      48, 2 * EIGEN_PI, 24, -EIGEN_PI / 2, EIGEN_PI / 2,
      [](double u, double v) {
        MeshVertex vertex;
        vertex.normal =
            Eigen::Vector3d(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v))
                .cast<float>();
        vertex.position_mm = 50 * vertex.normal;
        return vertex;
      },
      patches);
  const Pose truth{rotation_from_axis_angle({1, 0.3, 0}, 1.2), {0, 0, 320}};
  const cv::Mat image = test::photograph(RasterModel(sphere, true), camera(), truth, 20);
  const Left left = left_after_refining(sphere, image, truth, {1, 1, -1}, {0.5, 0.5, 1}, true);
  EXPECT_LT(left.deg, 0.5);
  EXPECT_LT(left.mm, 1.0);
}

TEST(Refining, ReportsNoSupportWhereThereIsNoObject) {
  const auto box = test::make_box(90, 60, 75);
  const cv::Mat empty(camera().height_px, camera().width_px, CV_8UC1, cv::Scalar(90));
  EXPECT_LT(left_after_refining(box, empty, corner_view(), {0, 0, 0}, {0, 0, 0}).support, 0.1);
}

TEST(Refining, KeepsThePoseWhereThereIsNothingToSee) {
  const auto box = test::make_box(90, 60, 75);
  const RasterModel model(box, false);
  Refiner refiner(model, camera());
  const cv::Mat empty(camera().height_px, camera().width_px, CV_8UC1, cv::Scalar(90));
  for (const Pose& start :
       {corner_view(), Pose{corner_view().rotation, {0, 0, -300}},
        Pose{corner_view().rotation, {5000, 0, 300}}, Pose{corner_view().rotation, {0, 0, 20}}}) {
    refiner.set_image(empty, start);
    const auto result = refine(refiner, start);
    EXPECT_TRUE(result.camera_from_object.is_finite());
    EXPECT_LT(center_distance_mm(*box, result.camera_from_object, start), 1e-6);
    EXPECT_LT(angle_deg(result.camera_from_object, start), 1e-6);
  }
}

TEST(Refining, StaysFiniteOnNoise) {
  const auto torus = test::make_torus(50, 20);
  const RasterModel model(torus, false);
  Refiner refiner(model, camera());
  cv::Mat noise(camera().height_px, camera().width_px, CV_8UC1);
  cv::RNG random(2);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const RandomKey key{.seed = 5, .particle = i};
    const Pose start{
        test::random_rotation(key),
        {test::random_between(key, 0, -100, 100), test::random_between(key, 1, -80, 80),
         test::random_between(key, 2, 60, 500)}};
    refiner.set_image(noise, start);
    const auto result = refine(refiner, start);
    EXPECT_TRUE(result.camera_from_object.is_finite()) << "start " << i;
    EXPECT_NEAR(result.camera_from_object.rotation.norm(), 1, 1e-9) << "start " << i;
  }
}

}  // namespace
}  // namespace anneal6d
