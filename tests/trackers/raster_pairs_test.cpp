// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Pairs of triangles that are drawn as one quadrilateral.
#include <gtest/gtest.h>

#include "instruction_sets.h"
#include "rasterizer.h"
#include "synthetic.h"

namespace anneal6d {
namespace {

using test::draw;
using test::Drawing;
using test::SharedMesh;
using test::small_camera;

Pose turned(double x_deg, double y_deg, double z_mm, double y_mm = 0) {
  return {rotation_from_axis_angle(Eigen::Vector3d::UnitX(), x_deg * test::kDegree) *
              rotation_from_axis_angle(Eigen::Vector3d::UnitY(), y_deg * test::kDegree),
          {0, y_mm, z_mm}};
}

/// The same model with its pairs taken apart.
RasterModel in_triangles(const RasterModel& paired) {
  RasterModel model = paired;
  const auto planes = {&RasterModel::plane_x, &RasterModel::plane_y, &RasterModel::plane_z,
                       &RasterModel::plane_mm};
  model.faces.clear();
  for (const auto plane : planes) (model.*plane).clear();
  for (std::size_t i = 0; i < paired.faces.size(); ++i) {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      model.faces.push_back({{a, b, c, c}, paired.faces[i].triangle});
      for (const auto plane : planes) (model.*plane).push_back((paired.*plane)[i]);
    };
    const auto& [a, b, c, d] = paired.faces[i].corners;
    add(a, b, c);
    if (paired.faces[i].is_pair()) add(a, c, d);
  }
  for (const auto plane : planes) {
    (model.*plane).resize(model.faces.size() + RasterModel::kPadding, (model.*plane).back());
  }
  return model;
}

/// A plate of quadrilaterals whose brightness bends sharply at their diagonals, up or down.
SharedMesh make_patchwork() {
  std::uint32_t count = 0;
  return test::make_grid(20, 60, 20, -30, 30, [&](double u, double v) {
    MeshVertex vertex =
        test::vertex_at(static_cast<float>(u - 30), static_cast<float>(v + 0.1 * u), 0);
    vertex.normal = {0, 0, -1};
    vertex.albedo_bgr.setConstant(
        static_cast<float>(test::random_between({.seed = 9, .particle = count++}, 0, 0.1, 0.9)));
    return vertex;
  });
}

/// Draws pairs of triangles and their triangles one by one: they have the same pixels, of nearly
/// the same depth, and of the same brightness but for its rounding.
void expect_pairs_like_triangles(const RasterModel& paired, const Pose& pose) {
  const RasterModel apart = in_triangles(paired);
  ASSERT_EQ(apart.faces.size(), paired.mesh->triangles().size());
  ASSERT_LT(paired.faces.size(), 0.6 * static_cast<double>(apart.faces.size()));
  for (const std::int64_t target : test::instruction_sets()) {
    const test::OnInstructionSet on(target);
    SCOPED_TRACE(hwy::TargetName(target));
    const Drawing pairs = draw(paired, small_camera(), pose);
    const Drawing triangles = draw(apart, small_camera(), pose);
    const cv::Mat drawn = triangles.depth_mm > 0;
    const int pixels = cv::countNonZero(drawn);
    EXPECT_GT(pixels, 200);
    EXPECT_EQ(cv::countNonZero((pairs.depth_mm > 0) != drawn), 0);
    cv::Mat difference;
    cv::absdiff(pairs.depth_mm, triangles.depth_mm, difference);
    EXPECT_EQ(cv::countNonZero(difference > 1e-4F * triangles.depth_mm), 0);
    cv::absdiff(pairs.grey, triangles.grey, difference);
    EXPECT_LE(cv::countNonZero(difference), pixels / 200);
    EXPECT_EQ(cv::countNonZero(difference > 1), 0);
  }
}

TEST(RasterizedPairs, LookLikeTheirTriangles) {
  for (const SharedMesh& mesh :
       {test::make_torus(50, 20), test::make_cylinder(110, 30, 48), test::make_box(80, 60, 40),
        test::make_bowl(45), test::make_coloured_sphere(40), make_patchwork()}) {
    const RasterModel paired(mesh, false);
    for (std::uint32_t i = 0; i < 8; ++i) {
      SCOPED_TRACE(std::to_string(mesh->triangles().size()) + " triangles, pose " +
                   std::to_string(i));
      const RandomKey key{.seed = 21, .particle = i};
      const Eigen::Vector3d center_mm(test::random_between(key, 0, -30, 30),
                                      test::random_between(key, 1, -20, 20),
                                      test::random_between(key, 2, 160, 400));
      expect_pairs_like_triangles(paired, {test::random_rotation(key), center_mm});
    }
  }
}

TEST(RasterizedPairs, LookLikeTheirTrianglesWhereTheyCrossTheNearPlane) {
  const RasterModel paired(make_patchwork(), false);
  for (const double tilt_deg : {85, 90, 95}) {
    expect_pairs_like_triangles(paired, turned(tilt_deg, 0, 8, 2));
  }
}

TEST(RasterizedPairs, LookLikeTheirTrianglesWithTexture) {
  cv::Mat texture(32, 32, CV_8UC3);
  cv::RNG(4).fill(texture, cv::RNG::UNIFORM, 40, 250);
  const auto plate = test::make_grid(
      6, 90, 4, -30, 30,
      [](double u, double v) {
        return test::vertex_at(static_cast<float>(u - 45), static_cast<float>(v), 0);
      },
      texture);
  const RasterModel paired(plate, true);
  for (const Pose& pose : {turned(20, 10, 200), turned(50, -40, 150), turned(-30, 60, 500)}) {
    expect_pairs_like_triangles(paired, pose);
  }
}

}  // namespace
}  // namespace anneal6d
