// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "synthetic.h"

namespace anneal6d {
namespace {

using test::SharedMesh;
using test::vertex_at;

int pairs_in(const TriangleMesh& mesh, bool textured = false) {
  const std::vector<Face> faces = faces_of(mesh, textured);
  return static_cast<int>(
      std::count_if(faces.begin(), faces.end(), [](const Face& face) { return face.is_pair(); }));
}

/// Two triangles with the common edge from (0, 0, 0) to (100, 100, 0), the first with its third
/// corner at (100, 0, 0), the second with this one. All vertices have the same normal.
std::vector<MeshVertex> corners_with(float x_mm, float y_mm, float z_mm) {
  std::vector<MeshVertex> corners = {vertex_at(0, 0, 0), vertex_at(100, 0, 0),
                                     vertex_at(100, 100, 0), vertex_at(x_mm, y_mm, z_mm)};
  for (MeshVertex& corner : corners) corner.normal = {0, 0, -1};
  return corners;
}
const std::vector<Triangle> kTwo = {{0, 1, 2}, {0, 2, 3}};

TEST(Faces, AreTheSidesOfABox) {
  const SharedMesh box = test::make_box(80, 60, 40);
  const std::vector<Face> faces = faces_of(*box, false);
  ASSERT_EQ(faces.size(), 6U);
  for (const Face& face : faces) {
    const auto at = [&](int corner) { return box->vertices()[face.corners[corner]].position_mm; };
    EXPECT_TRUE(face.is_pair());
    EXPECT_EQ(at(0) + at(2), at(1) + at(3)) << "opposite corners are not opposite";
    EXPECT_GT(at(0).dot((at(1) - at(0)).cross(at(2) - at(0))), 0) << "wound inward";
  }
}

TEST(Faces, AreTheWallOfACylinderAndPairsOfItsCaps) {
  constexpr int kFacets = 64;
  const SharedMesh cylinder = test::make_cylinder(110, 30, kFacets);
  int wall = 0, caps = 0;
  for (const Face& face : faces_of(*cylinder, false)) {
    EXPECT_TRUE(face.is_pair());
    const auto above = std::count_if(face.corners.begin(), face.corners.end(), [&](auto corner) {
      return cylinder->vertices()[corner].position_mm.z() > 0;
    });
    ++(above == 2 ? wall : caps);
  }
  EXPECT_EQ(wall, kFacets);
  EXPECT_EQ(caps, kFacets);
}

TEST(Faces, AreTheCellsOfAGrid) {
  // Triangles of neighbouring cells would make parallelograms.
  const SharedMesh grid = test::make_grid(12, 60, 7, 0, 40, [](double u, double v) {
    return vertex_at(static_cast<float>(u), static_cast<float>(v), 0);
  });
  const std::vector<Face> faces = faces_of(*grid, false);
  EXPECT_EQ(faces.size(), 12U * 7U);
  for (const Face& face : faces) {
    const auto at = [&](int corner) { return grid->vertices()[face.corners[corner]].position_mm; };
    EXPECT_NEAR((at(1) - at(0)).dot(at(2) - at(1)), 0, 1e-3);
  }
}

TEST(Faces, HaveEveryTriangleOnce) {
  for (const SharedMesh& mesh : {test::make_torus(50, 20), test::make_coloured_sphere(40),
                                 test::make_box(80, 60, 40), test::make_bowl(50)}) {
    const auto in_order = [&](Triangle t) {
      for (std::uint32_t& corner : t) corner = mesh->welded()[corner];
      std::sort(t.begin(), t.end());
      return t;
    };
    std::multiset<Triangle> expected, found;
    for (const Triangle& t : mesh->triangles()) expected.insert(in_order(t));
    for (const Face& face : faces_of(*mesh, false)) {
      const auto& [a, b, c, d] = face.corners;
      EXPECT_EQ(in_order({a, b, c}), in_order(mesh->triangles()[face.triangle]));
      found.insert(in_order({a, b, c}));
      if (face.is_pair()) found.insert(in_order({a, c, d}));
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(Faces, ArePairsOnlyOfTrianglesInOnePlane) {
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(0, 100, 0), kTwo)), 1);
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(0, 100, 1e-4F), kTwo)), 1) << "rounding";
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(0, 100, 0.1F), kTwo)), 0);
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(0, 100, -0.1F), kTwo)), 0);
  EXPECT_EQ(pairs_in(*test::make_rounded_box({60, 50, 40}, 10)), 6 * (1 + 4 * 3))
      << "sides and quarters of cylinders, but no spheres";
}

TEST(Faces, ArePairsOnlyIfConvex) {
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(30, 60, 0), kTwo)), 1);
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(-50, 0, 0), kTwo)), 0) << "straight at a corner";
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(-50, -20, 0), kTwo)), 0) << "concave";
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(60, 150, 0), kTwo)), 1);
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(120, 150, 0), kTwo)), 0) << "concave";
}

TEST(Faces, ArePairsOnlyIfWoundAlike) {
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(0, 100, 0), {{0, 1, 2}, {2, 0, 3}})), 0);
  EXPECT_EQ(pairs_in(TriangleMesh(corners_with(0, 100, 0), {{0, 2, 1}, {0, 3, 2}})), 1);
}

TEST(Faces, ArePairsOnlyOfTrianglesWithTheSameVertices) {
  std::vector<MeshVertex> corners = corners_with(0, 100, 0);
  corners.push_back(corners[2]);
  EXPECT_EQ(pairs_in(TriangleMesh(corners, {{0, 1, 2}, {0, 4, 3}})), 1);
  corners.back().normal = Eigen::Vector3f(0.3F, 0, -1).normalized();
  EXPECT_EQ(pairs_in(TriangleMesh(corners, {{0, 1, 2}, {0, 4, 3}})), 0);
}

TEST(Faces, ArePairsOnlyIfTheTextureRunsOn) {
  std::vector<MeshVertex> corners = corners_with(0, 100, 0);
  for (MeshVertex& corner : corners) corner.uv = 0.01F * corner.position_mm.head<2>();
  const cv::Mat texture(8, 8, CV_8UC3, cv::Scalar::all(200));
  EXPECT_EQ(pairs_in(TriangleMesh(corners, kTwo, texture), true), 1);
  corners[3].uv.x() += 0.1F;
  EXPECT_EQ(pairs_in(TriangleMesh(corners, kTwo, texture), true), 0);
  EXPECT_EQ(pairs_in(TriangleMesh(corners, kTwo, texture), false), 1);
}

}  // namespace
}  // namespace anneal6d
