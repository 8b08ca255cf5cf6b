// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "simplified_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>

#include "mesh_sides.h"
#include "tracking.h"

namespace anneal6d {
namespace {

using test::SharedMesh;

/// Every triangle with vertices of its own, as in STL files.
SharedMesh torn(const TriangleMesh& mesh) {
  std::vector<MeshVertex> vertices;
  std::vector<Triangle> triangles;
  for (const Triangle& triangle : mesh.triangles()) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const std::uint32_t corner : triangle) {
      vertices.push_back(mesh.vertices()[corner]);
      vertices.back().normal = normal_of(mesh, triangle).cast<float>();
    }
    triangles.push_back({first, first + 1, first + 2});
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

TEST(SimplifiedMesh, IsTheSameIfItIsSmallEnough) {
  const SharedMesh torus = test::make_torus(40, 15);
  EXPECT_EQ(simplified(torus, torus->triangles().size()), torus);
}

TEST(SimplifiedMesh, KeepsASmoothSurface) {
  const SharedMesh torus = test::make_torus(40, 15, 100);
  for (const SharedMesh& mesh : {torus, torn(*torus)}) {
    const auto simple = simplified(mesh, 8000);
    EXPECT_LE(simple->triangles().size(), 8000U);
    EXPECT_GT(simple->triangles().size(), 7000U);
    for_each_edge(sides_of(*simple), [](std::span<const MeshSide> sides) {
      EXPECT_EQ(sides.size() % 2, 0U) << "no longer closed";
    });
    const auto off_mm = [](const Eigen::Vector3f& p) {
      return std::abs(std::hypot(std::hypot(p.x(), p.y()) - 40, p.z()) - 15);
    };
    for (const Triangle& triangle : simple->triangles()) {
      Eigen::Vector3f middle_mm = Eigen::Vector3f::Zero();
      for (const std::uint32_t corner : triangle) {
        const MeshVertex& vertex = simple->vertices()[corner];
        EXPECT_LT(off_mm(vertex.position_mm), 1e-3);
        middle_mm += vertex.position_mm / 3;
      }
      EXPECT_LT(off_mm(middle_mm), 0.3);
    }
  }
}

TEST(SimplifiedMesh, KeepsFlatFacesAndTheirEdges) {
  const SharedMesh box = test::make_rounded_box({90, 60, 75}, 5);
  const auto simple = simplified(box, 100);
  EXPECT_LT(simple->triangles().size(), box->triangles().size());
  EXPECT_LT((simple->min_corner_mm() - box->min_corner_mm()).norm(), 0.5);
  EXPECT_LT((simple->max_corner_mm() - box->max_corner_mm()).norm(), 0.5);
}

TEST(SimplifiedMesh, KeepsTheTextureWhereItIs) {
  const cv::Mat texture(16, 16, CV_8UC3, cv::Scalar(90, 120, 150));
  const auto place_of = [](double u, double v) {
    return Eigen::Vector3f(static_cast<float>(30 * std::cos(u)),
                           static_cast<float>(30 * std::sin(u)), static_cast<float>(20 * v));
  };
  constexpr double kTurn = 2 * std::numbers::pi;
  const SharedMesh tube = test::make_grid(
      100, kTurn, 100, -1, 1,
      [&](double u, double v) {
        MeshVertex vertex;
        vertex.position_mm = place_of(u, v);
        return vertex;
      },
      texture);
  const auto simple = simplified(tube, 4000);
  ASSERT_LT(simple->triangles().size(), 5000U);
  ASSERT_TRUE(simple->has_texture());
  EXPECT_EQ(simple->texture_levels().front().size(), texture.size());
  for (const Triangle& triangle : simple->triangles()) {
    double least = 1, most = 0;
    for (const std::uint32_t corner : triangle) {
      const MeshVertex& vertex = simple->vertices()[corner];
      const Eigen::Vector3f place = place_of(kTurn * vertex.uv.x(), 2 * vertex.uv.y() - 1);
      EXPECT_LT((place - vertex.position_mm).norm(), 1e-2);
      least = std::min<double>(least, vertex.uv.x());
      most = std::max<double>(most, vertex.uv.x());
    }
    EXPECT_LT(most - least, 0.5) << "a triangle across the texture's seam";
  }
}

TEST(SimplifiedMesh, KeepsColoursBetweenTriangles) {
  const SharedMesh torus = torn(*test::make_torus(40, 15, 60));
  std::vector<MeshVertex> vertices(torus->vertices().begin(), torus->vertices().end());
  for (const Triangle& triangle : torus->triangles()) {
    const bool left = vertices[triangle[0]].position_mm.x() < 0;
    for (const std::uint32_t corner : triangle) {
      vertices[corner].albedo_bgr.setConstant(left ? 0.3F : 0.7F);
    }
  }
  const auto area_mm2 = [](const TriangleMesh& mesh, float albedo) {
    double sum = 0;
    for (const Triangle& triangle : mesh.triangles()) {
      const auto corner = [&](std::size_t i) { return mesh.vertices()[triangle[i]].position_mm; };
      if (mesh.vertices()[triangle[0]].albedo_bgr[0] != albedo) continue;
      EXPECT_EQ(mesh.vertices()[triangle[1]].albedo_bgr[0], albedo);
      EXPECT_EQ(mesh.vertices()[triangle[2]].albedo_bgr[0], albedo);
      sum += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    }
    return sum;
  };
  const TriangleMesh two_colours(vertices, {torus->triangles().begin(), torus->triangles().end()});
  const auto simple = simplified(std::make_shared<const TriangleMesh>(two_colours), 4000);
  ASSERT_LT(simple->triangles().size(), 5000U);
  for (const float albedo : {0.3F, 0.7F}) {
    EXPECT_NEAR(area_mm2(*simple, albedo) / area_mm2(two_colours, albedo), 1, 0.02);
  }
}

TEST(SimplifiedMesh, IsTheSameIfItsColoursNeedTheVertices) {
  const SharedMesh sphere = test::make_coloured_sphere(40);
  EXPECT_EQ(simplified(sphere, 100), sphere);
}

TEST(SimplifiedMesh, KeepsMoreTrianglesThanAskedForWhereItWouldChange) {
  const SharedMesh torus = test::make_torus(40, 15, 60);
  const auto simple = simplified(torus, 20);
  EXPECT_GT(simple->triangles().size(), 200U);
  EXPECT_LT(simple->triangles().size(), torus->triangles().size());
}

/// The same surface of four times as many triangles.
SharedMesh subdivided(const TriangleMesh& mesh) {
  std::vector<MeshVertex> vertices;
  std::vector<Triangle> triangles;
  for (const Triangle& triangle : mesh.triangles()) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const std::uint32_t corner : triangle) vertices.push_back(mesh.vertices()[corner]);
    for (std::uint32_t i = 0; i < 3; ++i) {
      MeshVertex middle = vertices[first + i];
      middle.position_mm += vertices[first + (i + 1) % 3].position_mm;
      middle.position_mm /= 2;
      vertices.push_back(middle);
      triangles.push_back({first + i, first + 3 + i, first + 3 + (i + 2) % 3});
    }
    triangles.push_back({first + 3, first + 4, first + 5});
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

// By views alone, without the contour as it is at the pose, it is off by 1.2 mm and 1.2 degrees.
TEST(UniversalTrackerOfALargeModel, FollowsItClosely) {
  SharedMesh box = test::make_rounded_box({90, 60, 75}, 15);
  for (int i = 0; i < 4; ++i) box = subdivided(*box);
  ASSERT_EQ(box->triangles().size(), 150528U);
  const test::Sequence sequence = test::moving_sequence(box, 10);
  const auto tracker =
      make_plugin(tracker_plugins(), "tracker", "universal", test::setup_for(box, {}));
  const auto results = test::track(*tracker, sequence);
  double off_mm = 0, off_deg = 0;
  for (std::size_t i = 1; i < results.size(); ++i) {
    const Pose& pose = results[i].camera_from_object;
    off_mm += test::center_distance_mm(*box, pose, sequence.truth[i]) / 9;
    off_deg += test::angle_deg(pose, sequence.truth[i]) / 9;
  }
  EXPECT_LT(off_mm, 0.7);
  EXPECT_LT(off_deg, 0.8);
}

}  // namespace
}  // namespace anneal6d
