// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/triangle_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

MeshVertex at(float x, float y, float z) {
  MeshVertex vertex;
  vertex.position_mm = {x, y, z};
  return vertex;
}

/// Two squares of 100 mm that share the y axis; the right one is folded up by `angle_deg`.
TriangleMesh roof(double angle_deg, bool turn_the_right_one_over = false) {
  const auto angle = static_cast<float>(angle_deg * std::numbers::pi / 180);
  const float x = 100 * std::cos(angle), z = 100 * std::sin(angle);
  std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  if (turn_the_right_one_over) {
    for (std::size_t i : {2U, 3U}) std::swap(triangles[i][1], triangles[i][2]);
  }
  return TriangleMesh(
      {at(-100, 0, 0), at(0, 0, 0), at(0, 100, 0), at(-100, 100, 0), at(x, 0, z), at(x, 100, z)},
      triangles);
}

/// The normals, up to sign, at the y axis of a roof.
std::vector<Eigen::Vector3f> normals_at_fold(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> normals;
  for (const MeshVertex& vertex : mesh.vertices()) {
    if (vertex.position_mm.x() == 0 && vertex.position_mm.y() == 0) {
      normals.push_back(vertex.normal.z() < 0 ? -vertex.normal : vertex.normal);
    }
  }
  return normals;
}

TEST(MissingNormals, AreSharedAcrossAFlatFold) {
  const auto normals = normals_at_fold(roof(30));
  ASSERT_FALSE(normals.empty());
  // One triangle of the left square meets the corner with 90 degrees; on the right two do, which
  // together have 90: the mean is half-way.
  const Eigen::Vector3f expected(-std::sin(15 * EIGEN_PI / 180), 0, std::cos(15 * EIGEN_PI / 180));
  for (const Eigen::Vector3f& normal : normals) {
    EXPECT_LT((normal - expected).norm(), 1e-5F) << normal.transpose();
  }
}

TEST(MissingNormals, AreSplitAtACrease) {
  const auto normals = normals_at_fold(roof(50));
  ASSERT_EQ(normals.size(), 2U);
  const float cosine = normals[0].dot(normals[1]);
  EXPECT_NEAR(cosine, std::cos(50 * EIGEN_PI / 180), 1e-5);
}

TEST(MissingNormals, DoNotTrustTheWinding) {
  const auto normals = normals_at_fold(roof(30, true));
  ASSERT_FALSE(normals.empty());
  for (const Eigen::Vector3f& normal : normals) {
    EXPECT_NEAR(std::abs(normal.x()), std::sin(15 * EIGEN_PI / 180), 1e-5) << normal.transpose();
  }
}

TEST(MissingNormals, AreUnitAndAcrossTheirFace) {
  const TriangleMesh mesh = roof(70);
  for (const Triangle& t : mesh.triangles()) {
    const auto corner = [&](int c) { return mesh.vertices()[t[static_cast<std::size_t>(c)]]; };
    const Eigen::Vector3f along = corner(1).position_mm - corner(0).position_mm;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(corner(c).normal.norm(), 1, 1e-6);
      EXPECT_NEAR(corner(c).normal.dot(along.normalized()), 0, 1e-6);
    }
  }
}

/// A cone of `count` triangles around its tip, the normals 60 degrees away from its axis, every
/// third one wound the wrong way.
TriangleMesh cone(std::uint32_t count) {
  std::vector<MeshVertex> vertices{at(0, 0, 0)};
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    vertices.push_back(at(static_cast<float>(50 * std::cos(angle)),
                          static_cast<float>(50 * std::sin(angle)),
                          static_cast<float>(50 * std::tan(std::numbers::pi / 3))));
    const std::uint32_t here = i + 1, next = (i + 1) % count + 1;
    triangles.push_back(i % 3 == 0 ? Triangle{0, here, next} : Triangle{0, next, here});
  }
  return TriangleMesh(vertices, triangles);
}

TEST(MissingNormals, AtTheTipOfAConeAreTheSameForAnyNumberOfTriangles) {
  // A tip's normal lies in the plane of the axis and the middle of its face. With 200,000 of them
  // it must not take the square of that number, either.
  const auto largest_tilt = [](const TriangleMesh& mesh) {
    float largest = 0;
    for (const Triangle& t : mesh.triangles()) {
      const MeshVertex& tip = mesh.vertices()[t[0]];
      EXPECT_LT(tip.position_mm.norm(), 1e-6F);
      const Eigen::Vector3f middle =
          0.5F * (mesh.vertices()[t[1]].position_mm + mesh.vertices()[t[2]].position_mm);
      const Eigen::Vector3f aside = Eigen::Vector3f::UnitZ().cross(middle).normalized();
      largest = std::max(largest, std::abs(tip.normal.dot(aside)));
      EXPECT_NEAR(std::abs(tip.normal.z()), 0.55, 0.05);
    }
    return largest;
  };
  EXPECT_LT(largest_tilt(cone(240)), 0.02);
  EXPECT_LT(largest_tilt(cone(300)), 0.06);
  EXPECT_LT(largest_tilt(cone(200000)), 0.06);
}

TEST(GivenNormals, AreKeptAndNormalised) {
  std::vector<MeshVertex> vertices{at(0, 0, 0), at(10, 0, 0), at(0, 10, 0)};
  for (MeshVertex& vertex : vertices) vertex.normal = {3, 0, 4};
  const TriangleMesh mesh(vertices, {{0, 1, 2}});
  for (const MeshVertex& vertex : mesh.vertices()) {
    EXPECT_LT((vertex.normal - Eigen::Vector3f(0.6F, 0, 0.8F)).norm(), 1e-6F);
  }
}

TEST(Welding, FindsVerticesAtTheSamePlace) {
  // Two triangles that share an edge, each with vertices of its own; the diameter is 142 mm, so
  // that 0.0005 mm is within the tolerance and 0.01 mm is not.
  const TriangleMesh mesh({at(0, 0, 0), at(100, 0, 0), at(0, 100, 0), at(100, 0, 5e-4F),
                           at(100, 100, 0), at(0, 100.01F, 0)},
                          {{0, 1, 2}, {3, 4, 5}});
  const auto place_of = [&](float x, float y) {
    std::set<std::uint32_t> firsts;
    for (std::size_t i = 0; i < mesh.vertices().size(); ++i) {
      const auto& p = mesh.vertices()[i].position_mm;
      if (std::abs(p.x() - x) < 0.1F && std::abs(p.y() - y) < 0.1F) firsts.insert(mesh.welded()[i]);
    }
    return firsts;
  };
  ASSERT_EQ(mesh.welded().size(), mesh.vertices().size());
  EXPECT_EQ(place_of(100, 0).size(), 1U);
  EXPECT_EQ(place_of(0, 100).size(), 2U);
  EXPECT_EQ(place_of(0, 0).size(), 1U);
}

TEST(Welding, NamesTheFirstVertexOfEachPlace) {
  const TriangleMesh mesh = roof(90);
  for (std::uint32_t i = 0; i < mesh.welded().size(); ++i) {
    const std::uint32_t first = mesh.welded()[i];
    EXPECT_LE(first, i);
    EXPECT_EQ(mesh.welded()[first], first);
    EXPECT_EQ(mesh.vertices()[first].position_mm, mesh.vertices()[i].position_mm);
  }
}

TEST(Triangles, WithoutAreaAreDropped) {
  const TriangleMesh mesh({at(0, 0, 0), at(100, 0, 0), at(0, 100, 0), at(50, 0, 0)},
                          {{0, 1, 2}, {0, 1, 3}, {0, 0, 2}, {1, 1, 1}});
  EXPECT_EQ(mesh.triangles().size(), 1U);
  EXPECT_EQ(mesh.vertices().size(), 3U);
}

TEST(Triangles, WithTwoCornersInOnePlaceAreDropped) {
  // A sliver of 0.05 square millimetres.
  const TriangleMesh mesh({at(0, 0, 0), at(100, 0, 0), at(0, 100, 0), at(100, 1e-3F, 0)},
                          {{0, 1, 3}, {0, 3, 2}});
  EXPECT_EQ(mesh.triangles().size(), 1U);
}

TEST(Triangles, OfTheOtherSideOfAMeshAreDropped) {
  // Both sides of a sheet, the other one with vertices of its own, and one of its triangles twice.
  const TriangleMesh mesh({at(0, 0, 0), at(100, 0, 0), at(0, 100, 0), at(100, 100, 0), at(0, 0, 0),
                           at(0, 100, 0), at(100, 0, 0), at(100, 100, 0)},
                          {{0, 1, 2}, {1, 3, 2}, {4, 5, 6}, {5, 7, 6}, {2, 1, 3}});
  ASSERT_EQ(mesh.triangles().size(), 2U);
  EXPECT_EQ(mesh.triangles()[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.triangles()[1], (Triangle{1, 3, 2}));
}

// A closed surface would be left open.
TEST(Triangles, OfAFoldAreKept) {
  const TriangleMesh mesh({at(0, 0, 0), at(100, 0, 0), at(0, 100, 0), at(0, 0, 100), at(60, 60, 9)},
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 2, 4}, {2, 1, 4}});
  EXPECT_EQ(mesh.triangles().size(), 6U);
}

TEST(Box, IsThatOfTheUsedVertices) {
  const TriangleMesh mesh({at(0, 0, 0), at(100, 0, 0), at(0, 60, 0), at(9000, 9000, 9000)},
                          {{0, 1, 2}});
  EXPECT_EQ(mesh.min_corner_mm(), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(mesh.max_corner_mm(), Eigen::Vector3f(100, 60, 0));
  EXPECT_EQ(mesh.center_mm(), Eigen::Vector3f(50, 30, 0));
  EXPECT_FLOAT_EQ(mesh.diameter_mm(), std::hypot(100.0F, 60.0F));
  EXPECT_FLOAT_EQ(mesh.radius_mm(), std::hypot(50.0F, 30.0F));
}

void expect_refused(std::vector<MeshVertex> vertices, std::vector<Triangle> triangles,
                    const std::string& words, const cv::Mat& texture = {}) {
  try {
    TriangleMesh(std::move(vertices), std::move(triangles), texture);
    ADD_FAILURE() << "was accepted; expected: " << words;
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

std::vector<MeshVertex> three() { return {at(0, 0, 0), at(100, 0, 0), at(0, 100, 0)}; }

TEST(MeshCheck, RefusesAMeshWithoutTriangles) {
  expect_refused(three(), {}, "there is no triangle");
  expect_refused({}, {}, "there is no triangle");
  expect_refused(three(), {{0, 0, 1}}, "degenerate");
  expect_refused({at(5, 5, 5), at(5, 5, 5), at(5, 5, 5)}, {{0, 1, 2}}, "degenerate");
}

TEST(MeshCheck, RefusesIndicesOutOfRange) {
  expect_refused(three(), {{0, 1, 3}}, "triangle 0 names vertex 3 of 3");
  expect_refused(three(), {{0, 1, 2}, {4294967295U, 1, 2}}, "triangle 1 names vertex 4294967295");
}

TEST(MeshCheck, RefusesNumbersThatAreNotFinite) {
  auto vertices = three();
  vertices[1].position_mm.z() = kNoNumber;
  expect_refused(vertices, {{0, 1, 2}}, "vertex 1 is not finite");
  vertices = three();
  vertices[2].normal = {0, std::numeric_limits<float>::infinity(), 0};
  expect_refused(vertices, {{0, 1, 2}}, "vertex 2 is not finite");
  vertices = three();
  vertices[0].uv = {kNoNumber, 0};
  expect_refused(vertices, {{0, 1, 2}}, "vertex 0 is not finite");
}

TEST(MeshCheck, RefusesAlbedosOutsideTheirRange) {
  for (const float bad : {-0.01F, 1.01F, kNoNumber}) {
    auto vertices = three();
    vertices[1].albedo_bgr = {0.5F, bad, 0.5F};
    expect_refused(vertices, {{0, 1, 2}}, "vertex 1 has an albedo outside 0..1");
  }
}

TEST(MeshCheck, RefusesTexturesOfAnotherType) {
  for (const int type : {CV_8UC1, CV_8UC4, CV_16UC3}) {
    expect_refused(three(), {{0, 1, 2}}, "texture", cv::Mat(4, 4, type, cv::Scalar(0)));
  }
}

/// A square of 100 mm with the whole of a texture of that many texels.
TriangleMesh textured(int columns, int rows) {
  std::vector<MeshVertex> vertices{at(0, 0, 0), at(100, 0, 0), at(100, 100, 0), at(0, 100, 0)};
  for (MeshVertex& vertex : vertices) vertex.uv = vertex.position_mm.head<2>() / 100;
  cv::Mat texture(rows, columns, CV_8UC3, cv::Scalar(0, 0, 0));
  texture.colRange(0, columns / 2).setTo(cv::Scalar(200, 100, 40));
  return TriangleMesh(vertices, {{0, 1, 2}, {0, 2, 3}}, texture);
}

TEST(TextureLevels, HalveDownToOneTexel) {
  const TriangleMesh mesh = textured(20, 6);
  EXPECT_TRUE(mesh.has_texture());
  std::vector<cv::Size> sizes;
  for (const cv::Mat& level : mesh.texture_levels()) {
    EXPECT_EQ(level.type(), CV_8UC3);
    sizes.push_back(level.size());
  }
  EXPECT_EQ(sizes, (std::vector<cv::Size>{{20, 6}, {10, 3}, {5, 1}, {2, 1}, {1, 1}}));
}

TEST(TextureLevels, KeepTheMeanColour) {
  const TriangleMesh mesh = textured(64, 64);
  EXPECT_EQ(mesh.texture_levels().back().at<cv::Vec3b>(0, 0), cv::Vec3b(100, 50, 20));
}

TEST(TextureLevels, MatchTexelsToPixels) {
  const TriangleMesh mesh = textured(400, 400);  // four texels a millimetre
  EXPECT_EQ(mesh.texture_level_for(8), 0);
  EXPECT_EQ(mesh.texture_level_for(4), 0);
  EXPECT_EQ(mesh.texture_level_for(2), 1);
  EXPECT_EQ(mesh.texture_level_for(1), 2);
  EXPECT_EQ(mesh.texture_level_for(1.5), 1);
  EXPECT_EQ(mesh.texture_level_for(1.3), 2);
  EXPECT_EQ(mesh.texture_level_for(1e-9), 8);
  EXPECT_EQ(mesh.texture_level_for(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(TextureLevels, AreNoneWithoutATexture) {
  const TriangleMesh mesh(three(), {{0, 1, 2}});
  EXPECT_FALSE(mesh.has_texture());
  EXPECT_TRUE(mesh.texture_levels().empty());
  EXPECT_EQ(mesh.texture_level_for(0.01), 0);
}

TEST(TextureLevels, DoNotShareTheCallersPixels) {
  std::vector<MeshVertex> vertices = three();
  for (MeshVertex& vertex : vertices) vertex.uv = vertex.position_mm.head<2>() / 100;
  cv::Mat texture(8, 8, CV_8UC3, cv::Scalar(9, 9, 9));
  const TriangleMesh mesh(vertices, {{0, 1, 2}}, texture);
  texture.setTo(cv::Scalar(0, 0, 0));
  EXPECT_EQ(mesh.texture_levels()[0].at<cv::Vec3b>(3, 3), cv::Vec3b(9, 9, 9));
}

}  // namespace
}  // namespace anneal6d
