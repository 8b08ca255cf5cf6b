// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "synthetic.h"

namespace anneal6d {
namespace {

using test::corner_view;
using test::SharedMesh;

constexpr double kSpacing_px = 3.0;

std::vector<ContourPoint> contour_of(const SharedMesh& mesh, const Pose& pose,
                                     bool texture_edges = false,
                                     const CameraModel& camera = test::small_camera()) {
  const RasterModel model(mesh, texture_edges);
  Rasterizer rasterizer(model, camera, Shading{});
  cv::Mat grey, depth_mm;
  const Region region = rasterizer.draw_images(pose, 4, grey, &depth_mm);
  Workers alone(1);
  std::vector<ContourPoint> points;
  ContourExtractor(*mesh).extract({pose, camera, region, grey, depth_mm}, kSpacing_px,
                                  texture_edges, alone, points);
  return points;
}

/// A cube of 80 mm around the object's origin, seen at a corner.
constexpr float kSide_mm = 80;
const SharedMesh& cube() {
  static const SharedMesh mesh = test::make_box(kSide_mm, kSide_mm, kSide_mm);
  return mesh;
}
struct CubeEdge {
  Eigen::Vector3d from, to;
  bool visible;
};

/// The twelve edges; one is visible if one of its two faces is turned to the camera.
std::vector<CubeEdge> edges_of_cube(const Pose& pose) {
  const Eigen::Vector3d camera_mm = pose.inverse().translation_mm;
  const double half = kSide_mm / 2;
  std::vector<CubeEdge> edges;
  for (int along = 0; along < 3; ++along) {
    const int u = (along + 1) % 3, v = (along + 2) % 3;
    for (const double su : {-1.0, 1.0}) {
      for (const double sv : {-1.0, 1.0}) {
        CubeEdge edge;
        edge.from[u] = edge.to[u] = su * half;
        edge.from[v] = edge.to[v] = sv * half;
        edge.from[along] = -half;
        edge.to[along] = half;
        edge.visible = su * camera_mm[u] > half || sv * camera_mm[v] > half;
        edges.push_back(edge);
      }
    }
  }
  return edges;
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - (a + s * (b - a))).norm();
}

TEST(ContourOfACube, LiesOnItsVisibleEdges) {
  const Pose pose = corner_view();
  const CameraModel camera = test::small_camera();
  const auto edges = edges_of_cube(pose);
  ASSERT_EQ(std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.visible; }), 9);
  const auto points = contour_of(cube(), pose);
  for (const ContourPoint& point : points) {
    const Eigen::Vector2d p = camera.project(pose * point.object_mm);
    double nearest_px = 1e9;
    for (const CubeEdge& edge : edges) {
      if (!edge.visible) continue;
      nearest_px = std::min(nearest_px, distance_to_segment(p, camera.project(pose * edge.from),
                                                            camera.project(pose * edge.to)));
    }
    EXPECT_LT(nearest_px, 0.01) << p.transpose();
  }
}

TEST(ContourOfACube, CoversEveryVisibleEdgeAndNoHiddenOne) {
  const Pose pose = corner_view();
  const CameraModel camera = test::small_camera();
  const auto points = contour_of(cube(), pose);
  for (const CubeEdge& edge : edges_of_cube(pose)) {
    const Eigen::Vector3d along = (edge.to - edge.from).normalized();
    // Points of the edge, but not at its ends, where it meets others.
    const auto on_it = std::count_if(points.begin(), points.end(), [&](const ContourPoint& point) {
      const Eigen::Vector3d offset = point.object_mm - edge.from;
      const double s = offset.dot(along);
      return (offset - s * along).norm() < 0.01 && s > 2 && s < kSide_mm - 2;
    });
    const double length_px =
        (camera.project(pose * edge.from) - camera.project(pose * edge.to)).norm();
    if (edge.visible) {
      EXPECT_GT(on_it, 0.6 * length_px / kSpacing_px);
      EXPECT_LT(on_it, 1.5 * length_px / kSpacing_px);
    } else {
      EXPECT_EQ(on_it, 0);
    }
  }
}

TEST(ContourOfACube, HasNormalsAcrossItsEdges) {
  const Pose pose = corner_view();
  const CameraModel camera = test::small_camera();
  for (const ContourPoint& point : contour_of(cube(), pose)) {
    EXPECT_NEAR(point.normal.norm(), 1, 1e-9);
    const Eigen::Vector2d p = camera.project(pose * point.object_mm);
    double best_cosine = 1;
    for (const CubeEdge& edge : edges_of_cube(pose)) {
      const Eigen::Vector2d a = camera.project(pose * edge.from),
                            b = camera.project(pose * edge.to);
      if (!edge.visible || distance_to_segment(p, a, b) > 0.01) continue;
      best_cosine = std::min(best_cosine, std::abs(point.normal.dot((b - a).normalized())));
    }
    EXPECT_LT(best_cosine, 1e-6);
  }
}

TEST(ContourOfACube, LeavesOutTheDiagonalsOfItsFaces) {
  for (const ContourPoint& point : contour_of(cube(), corner_view())) {
    int on_faces = 0;
    for (int i = 0; i < 3; ++i) on_faces += std::abs(std::abs(point.object_mm[i]) - 40) < 1e-3;
    EXPECT_GE(on_faces, 2) << point.object_mm.transpose();
  }
}

TEST(ContourOfACube, LeavesOutWhatIsOutsideTheImage) {
  Pose pose = corner_view();
  pose.translation_mm.x() = 165;
  const CameraModel camera = test::small_camera();
  const auto points = contour_of(cube(), pose);
  EXPECT_GT(points.size(), 10U);
  for (const ContourPoint& point : points) {
    const Eigen::Vector2d p = camera.project(pose * point.object_mm);
    EXPECT_LE(p.x(), camera.width_px - 0.5);
    EXPECT_GE(p.x(), -0.5);
  }
}

TEST(ContourOfASphere, RunsAlongItsOutline) {
  constexpr double kRadius_mm = 50, kDepth_mm = 320;
  const auto sphere = test::make_coloured_sphere(kRadius_mm);
  const Pose pose{rotation_from_axis_angle({1, 2, 3}, 1.0), {0, 0, kDepth_mm}};
  CameraModel camera = test::small_camera();
  camera.fy_px = camera.fx_px;
  const auto points = contour_of(sphere, pose, false, camera);
  // The cone of rays that touch the sphere.
  const double radius_px =
      camera.fx_px * kRadius_mm / std::sqrt(kDepth_mm * kDepth_mm - kRadius_mm * kRadius_mm);
  EXPECT_GT(static_cast<double>(points.size()), 0.6 * 2 * EIGEN_PI * radius_px / kSpacing_px);
  for (const ContourPoint& point : points) {
    const Eigen::Vector2d p =
        camera.project(pose * point.object_mm) - Eigen::Vector2d(camera.cx_px, camera.cy_px);
    EXPECT_NEAR(p.norm(), radius_px, 0.02 * radius_px);
    EXPECT_GT(std::abs(point.normal.dot(p.normalized())), 0.95) << "normals point outward";
  }
}

TEST(ContourOfAnOpenSurface, HasItsBorder) {
  const auto bowl = test::make_bowl(50);
  const Pose pose{rotation_from_axis_angle({1, 0, 0}, 2.4), {0, 0, 320}};
  const auto points = contour_of(bowl, pose);
  const auto on_rim = std::count_if(points.begin(), points.end(), [](const ContourPoint& point) {
    return std::abs(point.object_mm.z()) < 1e-3;
  });
  EXPECT_GT(on_rim, 40);
}

TEST(ContourOfATexturedObject, HasTheEdgesOfItsTextureIfAsked) {
  // The border between the dark and the light half of a plate is at x = 0.
  cv::Mat halves(64, 64, CV_8UC3, cv::Scalar::all(230));
  halves.colRange(0, 32).setTo(cv::Scalar::all(40));
  std::vector<MeshVertex> corners{test::vertex_at(-50, -40, 0), test::vertex_at(50, -40, 0),
                                  test::vertex_at(50, 40, 0), test::vertex_at(-50, 40, 0)};
  for (MeshVertex& corner : corners) {
    corner.uv = {corner.position_mm.x() / 100 + 0.5F, corner.position_mm.y() / 80 + 0.5F};
  }
  const auto plate = std::make_shared<const TriangleMesh>(
      corners, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}, halves);
  const Pose pose{rotation_from_axis_angle({0, 1, 0}, 0.4), {0, 0, 320}};
  const auto in_the_middle = [&](bool texture_edges) {
    const auto points = contour_of(plate, pose, texture_edges);
    return std::count_if(points.begin(), points.end(), [](const ContourPoint& point) {
      return std::abs(point.object_mm.y()) < 30 && std::abs(point.object_mm.x()) < 40;
    });
  };
  EXPECT_EQ(in_the_middle(false), 0);
  EXPECT_GT(in_the_middle(true), 10);
  for (const ContourPoint& point : contour_of(plate, pose, true)) {
    if (std::abs(point.object_mm.x()) < 40 && std::abs(point.object_mm.y()) < 30) {
      EXPECT_NEAR(point.object_mm.x(), 0, 0.5);
      EXPECT_NEAR(point.object_mm.z(), 0, 0.5);
      EXPECT_GT(std::abs(point.normal.x()), 0.98);
    }
  }
}

TEST(ExtractingAContour, ReplacesThePointsBefore) {
  const RasterModel model(cube(), false);
  const CameraModel camera = test::small_camera();
  Rasterizer rasterizer(model, camera, Shading{});
  const Pose pose = corner_view();
  cv::Mat grey, depth_mm;
  const Region region = rasterizer.draw_images(pose, 4, grey, &depth_mm);
  ContourExtractor extractor(*cube());
  Workers alone(1);
  std::vector<ContourPoint> points(5);
  extractor.extract({pose, camera, region, grey, depth_mm}, kSpacing_px, false, alone, points);
  const std::size_t once = points.size();
  extractor.extract({pose, camera, region, grey, depth_mm}, kSpacing_px, false, alone, points);
  EXPECT_EQ(points.size(), once);
}

}  // namespace
}  // namespace anneal6d
