// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_model.h"

#include <gtest/gtest.h>

#include "synthetic.h"

namespace anneal6d {
namespace {

using test::SharedMesh;

/// Both surfaces, the second shifted.
SharedMesh side_by_side(const SharedMesh& first, const SharedMesh& second,
                        const Eigen::Vector3f& shift_mm) {
  std::vector<MeshVertex> vertices(first->vertices().begin(), first->vertices().end());
  std::vector<Triangle> triangles(first->triangles().begin(), first->triangles().end());
  const auto begin = static_cast<std::uint32_t>(vertices.size());
  for (MeshVertex vertex : second->vertices()) {
    vertex.position_mm += shift_mm;
    vertices.push_back(vertex);
  }
  for (const Triangle& t : second->triangles()) {
    triangles.push_back({begin + t[0], begin + t[1], begin + t[2]});
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

SharedMesh turned_inside_out(const SharedMesh& mesh) {
  std::vector<Triangle> triangles(mesh->triangles().begin(), mesh->triangles().end());
  for (Triangle& t : triangles) std::swap(t[0], t[1]);
  return std::make_shared<const TriangleMesh>(
      std::vector<MeshVertex>(mesh->vertices().begin(), mesh->vertices().end()),
      std::move(triangles));
}

/// How many triangles have the point on their outer side.
int facing(const RasterModel& model, const Eigen::Vector3f& point_mm) {
  int count = 0;
  for (std::size_t i = 0; i < model.faces.size(); ++i) {
    const Eigen::Vector3f normal(model.plane_x[i], model.plane_y[i], model.plane_z[i]);
    const int triangles = model.faces[i].is_pair() ? 2 : 1;
    if (normal.dot(point_mm) > model.plane_mm[i]) count += triangles;
  }
  return count;
}

constexpr int kSideOfABox = 2;  // triangles

TEST(RasterModelPlanes, TellWhichFacesOfAClosedSurfaceAreTurnedAway) {
  for (const SharedMesh& box :
       {test::make_box(80, 60, 40), turned_inside_out(test::make_box(80, 60, 40))}) {
    const RasterModel model(box, false);
    EXPECT_EQ(facing(model, {100, 0, 0}), 1 * kSideOfABox);
    EXPECT_EQ(facing(model, {100, 100, -100}), 3 * kSideOfABox);
    EXPECT_EQ(facing(model, {0, 0, 0}), 0);
  }
}

TEST(RasterModelPlanes, TurnNoFaceOfAnOpenSurfaceAway) {
  const SharedMesh bowl = test::make_bowl(45);
  const RasterModel model(bowl, false);
  EXPECT_EQ(facing(model, {0, 0, 300}), static_cast<int>(bowl->triangles().size()));
  EXPECT_EQ(facing(model, {0, 0, -300}), static_cast<int>(bowl->triangles().size()));
}

TEST(RasterModelPlanes, AreThoseOfEachSurfaceByItself) {
  const SharedMesh box = test::make_box(80, 60, 40), bowl = test::make_bowl(45);
  const int both_sides = static_cast<int>(bowl->triangles().size());
  EXPECT_EQ(facing(RasterModel(side_by_side(box, bowl, {120, 0, 0}), false), {0, 0, 100}),
            kSideOfABox + both_sides);
  EXPECT_EQ(facing(RasterModel(side_by_side(bowl, box, {120, 0, 0}), false), {120, 0, 100}),
            kSideOfABox + both_sides);
  const SharedMesh boxes =
      side_by_side(test::make_box(200, 200, 200), turned_inside_out(box), {300, 0, 0});
  EXPECT_EQ(facing(RasterModel(boxes, false), {300, 0, 200}), 3 * kSideOfABox)
      << "two sides of the large one, one of the small one";
}

TEST(RasterModelPlanes, AreThoseOfEachSurfaceByItselfAlsoWhereTheyTouch) {
  const SharedMesh large = test::make_box(200, 200, 200);
  const SharedMesh box = turned_inside_out(test::make_box(80, 60, 200));  // a common edge
  const RasterModel boxes(side_by_side(large, box, {140, 130, 0}), false);
  EXPECT_EQ(facing(boxes, {500, 500, 0}), 4 * kSideOfABox);
  EXPECT_EQ(facing(boxes, {140, 130, 0}), 2 * kSideOfABox) << "of the large one";
}

TEST(RasterModelPlanes, TakeAPinchedSurfaceForClosed) {
  // An edge of the wall lies on the opposite one, so that four triangles meet there.
  const float radius_mm = 30;
  const SharedMesh cylinder = test::make_cylinder(80, radius_mm, 12);
  std::vector<MeshVertex> vertices(cylinder->vertices().begin(), cylinder->vertices().end());
  for (MeshVertex& vertex : vertices) {
    if (vertex.position_mm.x() > 0.99F * radius_mm) vertex.position_mm.x() = -radius_mm;
  }
  const SharedMesh pinched = std::make_shared<const TriangleMesh>(
      std::move(vertices),
      std::vector<Triangle>(cylinder->triangles().begin(), cylinder->triangles().end()));
  const Eigen::Vector3f above_mm(0, 0, 300);
  int wound_towards = 0;
  for (const Triangle& t : pinched->triangles()) {
    const auto at = [&](int c) -> const Eigen::Vector3f& {
      return pinched->vertices()[t[c]].position_mm;
    };
    wound_towards += (at(1) - at(0)).cross(at(2) - at(0)).dot(above_mm - at(0)) > 0;
  }
  EXPECT_EQ(facing(RasterModel(pinched, false), above_mm), wound_towards);
  EXPECT_LT(wound_towards, static_cast<int>(pinched->triangles().size()));
}

TEST(RasterModelPlanes, TakeASurfaceWithAHoleForOpen) {
  const SharedMesh box = test::make_box(80, 60, 40);
  const std::vector<MeshVertex> vertices(box->vertices().begin(), box->vertices().end());
  std::vector<Triangle> triangles(box->triangles().begin(), box->triangles().end());
  triangles.pop_back();
  const RasterModel holed(std::make_shared<const TriangleMesh>(vertices, triangles), false);
  EXPECT_EQ(facing(holed, {100, 0, 0}), 11);
}

TEST(RasterModelPlanes, TakeASurfaceOfMixedWindingForOpen) {
  const SharedMesh box = test::make_box(80, 60, 40);
  const std::vector<MeshVertex> vertices(box->vertices().begin(), box->vertices().end());
  std::vector<Triangle> triangles(box->triangles().begin(), box->triangles().end());
  std::swap(triangles[5][0], triangles[5][1]);
  const RasterModel mixed(std::make_shared<const TriangleMesh>(vertices, triangles), false);
  EXPECT_EQ(facing(mixed, {100, 0, 0}), 12);
}

}  // namespace
}  // namespace anneal6d
