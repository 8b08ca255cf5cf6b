// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "mesh_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "synthetic.h"

namespace anneal6d {
namespace {

using test::SharedMesh;

std::ptrdiff_t creases_of(const SharedMesh& mesh) {
  const std::vector<MeshEdge> edges = mesh_edges(*mesh);
  return std::count_if(edges.begin(), edges.end(), [](const MeshEdge& e) { return e.crease; });
}

TEST(CreasesOfABox, AreItsTwelveEdges) { EXPECT_EQ(creases_of(test::make_box(30, 40, 50)), 12); }

TEST(CreasesOfABox, AreThoseOfOneThatHasTwoSidesEverywhere) {
  const SharedMesh box = test::make_box(30, 40, 50);
  std::vector<Triangle> triangles(box->triangles().begin(), box->triangles().end());
  for (const auto& [a, b, c] : box->triangles()) triangles.push_back({a, c, b});
  const auto both_sides = std::make_shared<const TriangleMesh>(
      std::vector<MeshVertex>(box->vertices().begin(), box->vertices().end()), triangles);
  EXPECT_EQ(mesh_edges(*both_sides).size(), 12U);
  EXPECT_EQ(creases_of(both_sides), 12);
}

TEST(CreasesOfACylinderOfManyFacets, AreItsTwoRimsThoughEachOfTheirEdgesIsShort) {
  constexpr double kHalf_mm = 60, kRound_mm = 9;
  constexpr int kFacets = 64;
  const SharedMesh mesh = test::make_cylinder(2 * kHalf_mm, kRound_mm, kFacets);
  int on_rims = 0;
  for (const MeshEdge& edge : mesh_edges(*mesh)) {
    const auto on_rim = [&](const Eigen::Vector3f& p) {
      return std::abs(std::abs(p.z()) - kHalf_mm) < 1e-3 &&
             std::abs(p.head<2>().norm() - kRound_mm) < 1e-3;
    };
    const bool along_rim =
        on_rim(edge.from_mm) && on_rim(edge.to_mm) && edge.from_mm.z() * edge.to_mm.z() > 0;
    EXPECT_EQ(edge.crease, along_rim)
        << edge.from_mm.transpose() << " to " << edge.to_mm.transpose();
    on_rims += along_rim;
  }
  EXPECT_EQ(on_rims, 2 * kFacets);
}

constexpr std::uint32_t kCells = 60;

/// A plate of 100 mm, 141 mm across, whose point in the middle sticks out of it.
SharedMesh plate_with_a_spike(double height_mm) {
  return test::make_grid(kCells, 100, kCells, 0, 100, [&](double x_mm, double y_mm) {
    const bool middle = std::abs(x_mm - 50) < 0.1 && std::abs(y_mm - 50) < 0.1;
    return test::vertex_at(static_cast<float>(x_mm), static_cast<float>(y_mm),
                           static_cast<float>(middle ? height_mm : 0));
  });
}

TEST(CreasesOfAScan, AreNotItsNoise) {
  const SharedMesh mesh = plate_with_a_spike(2.5);
  const std::vector<MeshEdge> edges = mesh_edges(*mesh);
  EXPECT_GT(std::count_if(
                edges.begin(), edges.end(),
                [](const MeshEdge& e) { return !e.border && e.normal_a.dot(e.normal_b) < 0.7; }),
            3)
      << "nothing sharp to be told from a crease";
  EXPECT_EQ(creases_of(mesh), 0);
}

TEST(CreasesOfAScan, AreSharpEdgesThatAreLong) { EXPECT_GT(creases_of(plate_with_a_spike(5)), 3); }

TEST(EdgesOfAnOpenPlate, AreItsBorder) {
  const std::vector<MeshEdge> edges = mesh_edges(*plate_with_a_spike(0));
  EXPECT_EQ(edges.size(), 4U * kCells);
  for (const MeshEdge& edge : edges) EXPECT_TRUE(edge.border && !edge.crease && !edge.smooth);
}

}  // namespace
}  // namespace anneal6d
