// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <ostream>

#include "contour.h"
#include "synthetic.h"

namespace anneal6d {
namespace {

using test::SharedMesh;

constexpr double kApart_px = 3.0;  // points along an edge

struct RoundView {
  std::vector<ContourPoint> contour;
  std::vector<SurfaceBends::Bend> bends;  ///< of the same drawing, in the image
};

RoundView view_of(const SharedMesh& mesh, const Pose& pose) {
  const CameraModel camera = test::small_camera();
  const RasterModel model(mesh, false);
  Rasterizer rasterizer(model, camera, Shading{});
  cv::Mat grey, depth_mm;
  const Region region = rasterizer.draw_images(pose, 8, grey, &depth_mm);
  Workers alone(1);
  RoundView view;
  ContourExtractor(*mesh).extract({pose, camera, region, grey, depth_mm}, kApart_px, false, alone,
                                  view.contour);
  view.bends =
      SurfaceBends().find(depth_mm, {region.x, region.y}, camera, 0.02 * mesh->diameter_mm());
  return view;
}

constexpr double kStickLength_mm = 120, kStickRadius_mm = 9;

const SharedMesh& stick() {
  static const SharedMesh mesh = test::make_cylinder(kStickLength_mm, kStickRadius_mm, 64);
  return mesh;
}

/// Where planes through the camera touch the side of the stick: its two silhouettes, in the image.
struct Segment {
  Eigen::Vector2d from_px, to_px;
  Eigen::Vector2d along() const { return (to_px - from_px).normalized(); }
  double length_px() const { return (to_px - from_px).norm(); }
};
std::array<Segment, 2> silhouettes(const Pose& pose) {
  const Eigen::Vector2d camera_mm = pose.inverse().translation_mm.head<2>();
  const double middle_rad = std::atan2(camera_mm.y(), camera_mm.x());
  const double half_rad = std::acos(kStickRadius_mm / camera_mm.norm());
  const CameraModel camera = test::small_camera();
  std::array<Segment, 2> lines;
  for (int i = 0; i < 2; ++i) {
    const double angle = middle_rad + (i ? half_rad : -half_rad);
    const auto at = [&](double z_mm) {
      return camera.project(pose * Eigen::Vector3d(kStickRadius_mm * std::cos(angle),
                                                   kStickRadius_mm * std::sin(angle), z_mm));
    };
    lines[i] = {at(-kStickLength_mm / 2), at(kStickLength_mm / 2)};
  }
  return lines;
}

struct StickPose {
  double distance_mm, tilt_deg, turn_deg;  ///< towards the camera, and in the image

  Pose pose() const {
    return {rotation_from_axis_angle(Eigen::Vector3d::UnitZ(), turn_deg * test::kDegree) *
                rotation_from_axis_angle(Eigen::Vector3d::UnitX(), (90 - tilt_deg) * test::kDegree),
            {4, -3, distance_mm}};
  }
  friend std::ostream& operator<<(std::ostream& stream, const StickPose& p) {
    return stream << p.distance_mm << " mm away, tilted by " << p.tilt_deg << " and turned by "
                  << p.turn_deg << " degrees";
  }
};

class ContourOfALongThinCylinder : public testing::TestWithParam<StickPose> {};

TEST_P(ContourOfALongThinCylinder, CoversBothSilhouettesWithoutGaps) {
  const Pose pose = GetParam().pose();
  const CameraModel camera = test::small_camera();
  const RoundView view = view_of(stick(), pose);
  for (const Segment& line : silhouettes(pose)) {
    std::vector<double> places_px{0, line.length_px()};
    for (const ContourPoint& point : view.contour) {
      const Eigen::Vector2d offset = camera.project(pose * point.object_mm) - line.from_px;
      const double along_px = offset.dot(line.along());
      if ((offset - along_px * line.along()).norm() > 0.7) continue;
      places_px.push_back(std::clamp(along_px, 0.0, line.length_px()));
    }
    std::sort(places_px.begin(), places_px.end());
    for (std::size_t i = 1; i < places_px.size(); ++i) {
      EXPECT_LT(places_px[i] - places_px[i - 1], 3 * kApart_px)
          << "behind " << places_px[i - 1] << " px of " << line.length_px();
    }
  }
}

TEST_P(ContourOfALongThinCylinder, LiesOnItsSilhouettesAndRims) {
  const Pose pose = GetParam().pose();
  const CameraModel camera = test::small_camera();
  const auto lines = silhouettes(pose);
  for (const ContourPoint& point : view_of(stick(), pose).contour) {
    EXPECT_FALSE(point.bend) << "its rims are creases";
    const double to_rim_mm = std::hypot(std::abs(point.object_mm.z()) - kStickLength_mm / 2,
                                        point.object_mm.head<2>().norm() - kStickRadius_mm);
    if (to_rim_mm < 0.05) continue;
    double nearest_px = 1e9, cosine = 1;
    for (const Segment& line : lines) {
      const Eigen::Vector2d offset = camera.project(pose * point.object_mm) - line.from_px;
      const double distance_px = (offset - offset.dot(line.along()) * line.along()).norm();
      if (distance_px >= nearest_px) continue;
      nearest_px = distance_px;
      cosine = std::abs(point.normal.dot(line.along()));
    }
    EXPECT_LT(nearest_px, 0.7) << point.object_mm.transpose();
    EXPECT_LT(cosine, 0.05) << "its normal is across";
  }
}

INSTANTIATE_TEST_SUITE_P(Seen, ContourOfALongThinCylinder,
                         testing::Values(StickPose{180, 0, 0}, StickPose{180, 40, 20},
                                         StickPose{300, 0, 45}, StickPose{300, 30, -30},
                                         StickPose{300, 60, 10}, StickPose{450, -45, 80},
                                         StickPose{600, 0, 5}, StickPose{600, 50, 60}));

TEST(ContourOfARoundedBox, HasItsBendsAndSaysThatTheyAreSome) {
  constexpr double kEdge_mm = 3;
  const Eigen::Vector3d sides_mm(80, 50, 65);
  const auto box = test::make_rounded_box(sides_mm, kEdge_mm);
  const Pose pose = test::corner_view();
  const Eigen::Vector3d camera_mm = pose.inverse().translation_mm;
  std::array<int, 3> on_edges_along{};
  for (const ContourPoint& point : view_of(box, pose).contour) {
    if (!point.bend) continue;
    EXPECT_FALSE(point.texture);
    EXPECT_FALSE(point.crowded);
    EXPECT_NEAR(point.normal.norm(), 1, 1e-9);
    // On one of the edges that are turned to the camera: beyond the inner box along two axes.
    const Eigen::Vector3d p = point.object_mm.cwiseProduct(camera_mm.cwiseSign());
    const Eigen::Vector3d beyond_mm =
        p - (sides_mm / 2 - Eigen::Vector3d::Constant(kEdge_mm)) + Eigen::Vector3d::Constant(0.5);
    const auto axes = (beyond_mm.array() > 0).count();
    EXPECT_GE(axes, 2) << p.transpose();
    if (axes != 2) continue;
    for (int axis = 0; axis < 3; ++axis) on_edges_along[axis] += beyond_mm[axis] <= 0;
  }
  for (const int points : on_edges_along) EXPECT_GE(points, 6);
}

TEST(ContourOfABoxWithSharpEdges, HasNoBends) {
  const RoundView view = view_of(test::make_box(80, 50, 65), test::corner_view());
  EXPECT_GT(view.contour.size(), 50U);
  EXPECT_TRUE(std::none_of(view.contour.begin(), view.contour.end(),
                           [](const ContourPoint& point) { return point.bend; }));
}

// Few facets: the side counts as bent. The rim of the cap is a crease.
TEST(ContourOfACylinderOfFewFacets, HasNoBendsBesideItsRim) {
  const auto can = test::make_cylinder(90, 35, 24);
  for (const double tilt_rad : {0.6, 0.75, 0.9}) {
    for (const double distance_mm : {220, 270, 320, 400}) {
      const Pose pose{rotation_from_axis_angle(Eigen::Vector3d::UnitX(), tilt_rad),
                      {0, 0, distance_mm}};
      const RoundView view = view_of(can, pose);
      EXPECT_GT(view.bends.size(), 20U) << "the surface bends there, too";
      for (const ContourPoint& point : view.contour) {
        EXPECT_FALSE(point.bend) << point.object_mm.transpose() << " seen from " << distance_mm
                                 << " mm, tilted by " << tilt_rad;
      }
    }
  }
}

}  // namespace
}  // namespace anneal6d
