// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "drawn_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "raster_model.h"
#include "shapes.h"

namespace anneal6d {
namespace {

using test::SharedMesh;

/// A box with the given colours at its corners, which repeat.
SharedMesh coloured_box(const std::vector<Eigen::Vector3f>& albedos_bgr) {
  const SharedMesh box = test::make_box(90, 60, 75);
  std::vector<MeshVertex> vertices(box->vertices().begin(), box->vertices().end());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i].albedo_bgr = albedos_bgr[i % albedos_bgr.size()];
  }
  return std::make_shared<const TriangleMesh>(
      std::move(vertices), std::vector<Triangle>(box->triangles().begin(), box->triangles().end()));
}

TEST(DrawingAMesh, MakesABlackOneBright) {
  const auto drawn = mesh_to_draw(coloured_box({Eigen::Vector3f::Zero()}));
  for (const MeshVertex& vertex : drawn->vertices()) EXPECT_GT(luma_of(vertex.albedo_bgr), 0.5F);
}

TEST(DrawingAMesh, LeavesNoPartOfItDark) {
  const auto drawn = mesh_to_draw(coloured_box({{0, 0, 0}, {1, 1, 1}}));
  for (const MeshVertex& vertex : drawn->vertices()) EXPECT_GT(luma_of(vertex.albedo_bgr), 0.2F);
}

TEST(DrawingAMesh, KeepsTheOrderOfBrightness) {
  // Blue, red, green and white: as a camera sees them, from dark to bright.
  const std::vector<Eigen::Vector3f> colours = {
      {0.9F, 0, 0}, {0, 0, 0.9F}, {0, 0.9F, 0}, {0.9F, 0.9F, 0.9F}};
  const auto drawn = mesh_to_draw(coloured_box(colours));
  const auto brightness = [&](std::size_t i) { return luma_of(drawn->vertices()[i].albedo_bgr); };
  for (std::size_t i = 1; i < colours.size(); ++i) {
    EXPECT_GT(brightness(i), brightness(i - 1) + 0.03F);
  }
}

TEST(DrawingAMesh, DrawsColoursThatAreEquallyBrightAlike) {
  const Eigen::Vector3f green(0, 0.5F, 0);
  const Eigen::Vector3f red(0, 0, 0.5F * 0.587F / 0.299F);
  const auto drawn = mesh_to_draw(coloured_box({green, red}));
  EXPECT_NEAR(luma_of(drawn->vertices()[0].albedo_bgr), luma_of(drawn->vertices()[1].albedo_bgr),
              1e-4F);
}

TEST(DrawingAMesh, KeepsItsShape) {
  const auto box = coloured_box({{0.1F, 0.2F, 0.3F}, {0.9F, 0.5F, 0.1F}});
  const auto drawn = mesh_to_draw(box);
  ASSERT_EQ(drawn->vertices().size(), box->vertices().size());
  for (std::size_t i = 0; i < box->vertices().size(); ++i) {
    EXPECT_EQ(drawn->vertices()[i].position_mm, box->vertices()[i].position_mm);
    EXPECT_EQ(drawn->vertices()[i].normal, box->vertices()[i].normal);
  }
  EXPECT_TRUE(std::equal(drawn->triangles().begin(), drawn->triangles().end(),
                         box->triangles().begin(), box->triangles().end()));
}

TEST(DrawingAMesh, TakesOneWithATextureAsItIs) {
  const auto bowl = test::make_bowl(50, cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(0)));
  EXPECT_EQ(mesh_to_draw(bowl), bowl);
}

}  // namespace
}  // namespace anneal6d
