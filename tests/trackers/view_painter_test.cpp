// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "view_painter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "synthetic.h"

namespace anneal6d {
namespace {

using test::SharedMesh;

constexpr float kLength_mm = 90, kWidth_mm = 60, kHeight_mm = 75;

/// Box of two halves, one colour each, that meet at x = 0.
SharedMesh two_halves(const Eigen::Vector3f& left_bgr, const Eigen::Vector3f& right_bgr) {
  std::vector<MeshVertex> vertices;
  std::vector<Triangle> triangles;
  for (const float side : {-1.0F, 1.0F}) {
    const SharedMesh half = test::make_box(kLength_mm / 2, kWidth_mm, kHeight_mm);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const MeshVertex& corner : half->vertices()) {
      MeshVertex vertex;  // without the normals that the half's own end would give it
      vertex.position_mm = corner.position_mm;
      vertex.position_mm.x() += side * kLength_mm / 4;
      vertex.albedo_bgr = side < 0 ? left_bgr : right_bgr;
      vertices.push_back(vertex);
    }
    for (const Triangle& t : half->triangles()) {
      const bool between_halves = std::all_of(t.begin(), t.end(), [&](std::uint32_t corner) {
        return std::abs(vertices[first + corner].position_mm.x()) < 1e-3F;
      });
      if (!between_halves) triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

/// The contour in the middle of faces, where the box has no edges.
std::vector<ContourSample> inside_faces(const SharedMesh& mesh) {
  const RasterModel model(mesh, false);
  ViewPainter painter(model, {.threshold = 40}, Shading{}, test::small_camera());
  Workers alone(1);
  std::vector<ContourSample> inside;
  for (const ContourSample& sample :
       painter.paint_contour(test::corner_view(), 1000, 0, alone).contour) {
    const Eigen::Array3f to_faces_mm =
        Eigen::Array3f(kLength_mm, kWidth_mm, kHeight_mm) / 2 - sample.object_mm.array().abs();
    if ((to_faces_mm > 5).count() >= 2) inside.push_back(sample);
  }
  return inside;
}

const Eigen::Vector3f kDark_bgr(0.1F, 0.2F, 0.25F), kBright_bgr(0.8F, 0.9F, 0.7F);

TEST(PaintingABoxOfTwoColours, FindsTheBorderOfTheColours) {
  const auto inside = inside_faces(two_halves(kDark_bgr, kBright_bgr));
  // It runs across two visible faces, about 110 pixels in all.
  EXPECT_GT(inside.size(), 20U);
  for (const ContourSample& sample : inside) {
    EXPECT_NEAR(sample.object_mm.x(), 0, 1.2) << sample.object_mm.transpose();
    EXPECT_FALSE(sample.silhouette);
    // The normal is square to the line of sight, the border to x.
    EXPECT_EQ(sample.polarity, sample.normal.x() > 0 ? 1 : -1) << "x > 0 is brighter";
  }
}

TEST(PaintingABoxOfOneColour, FindsNothingInsideItsFaces) {
  EXPECT_EQ(inside_faces(two_halves(kBright_bgr, kBright_bgr)).size(), 0U);
}

TEST(PaintingABoxOfTwoColours, TrustsCreasesLessThanOutlinesAndBordersOfColours) {
  const RasterModel model(two_halves(kDark_bgr, kBright_bgr), false);
  ViewPainter painter(model, {.threshold = 40}, Shading{}, test::small_camera());
  Workers alone(1);
  int outlines = 0, creases = 0, borders = 0;
  for (const ContourSample& sample :
       painter.paint_contour(test::corner_view(), 1000, 0, alone).contour) {
    if (sample.trust < 0.4F) continue;  // crowded, near corners
    const bool texture = sample.polarity != 0;
    outlines += sample.silhouette && sample.trust == 1;
    borders += texture && !sample.silhouette && sample.trust == 1;
    if (sample.silhouette || texture) continue;
    EXPECT_EQ(sample.trust, 0.5F) << sample.object_mm.transpose();
    ++creases;
  }
  EXPECT_GT(outlines, 50);
  EXPECT_GT(creases, 20);
  EXPECT_GT(borders, 20);
}

// Each visible face of a box is of one brightness, so that nothing but the steps of its pixels, a
// fifth of a pixel and more, moves the outline in a drawing.
TEST(PaintingAnEvenlyShadedBox, DoesNotShiftItsOutline) {
  const RasterModel model(test::make_box(kLength_mm, kWidth_mm, kHeight_mm), false);
  ViewPainter painter(model, {.threshold = 40}, Shading{}, test::small_camera());
  Workers alone(1);
  int outlines = 0;
  for (const ContourSample& sample :
       painter.paint_contour(test::corner_view(), 1000, 0, alone).contour) {
    if (!sample.silhouette || sample.trust != 1) continue;
    const Eigen::Array3f to_faces_mm =
        Eigen::Array3f(kLength_mm, kWidth_mm, kHeight_mm) / 2 - sample.object_mm.array().abs();
    if (to_faces_mm.maxCoeff() < 10) continue;  // another face is near
    EXPECT_NEAR(sample.shift_px, 0, 0.02) << sample.object_mm.transpose();
    ++outlines;
  }
  EXPECT_GT(outlines, 50);
}

TEST(ARasterModel, IsPatternedIfItsColoursDiffer) {
  EXPECT_TRUE(RasterModel(two_halves(kDark_bgr, kBright_bgr), false).patterned);
  EXPECT_FALSE(RasterModel(two_halves(kDark_bgr, kDark_bgr), false).patterned);
}

TEST(ARasterModel, IsPatternedIfItsTextureIsUsed) {
  const auto bowl = test::make_bowl(50, cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(200)));
  EXPECT_TRUE(RasterModel(bowl, true).patterned);
  EXPECT_FALSE(RasterModel(bowl, false).patterned);
}

}  // namespace
}  // namespace anneal6d
