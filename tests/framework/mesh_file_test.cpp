// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/mesh_file.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "anneal6d/framework/float_matrix_file.h"
#include "anneal6d/framework/log.h"
#include "file_test_support.h"

namespace anneal6d {
namespace {

using test::content_of;
using test::expect_file_error;
using test::golden;
using test::replaced;
using test::TemporaryFolder;

/// The box of make_golden.py: 40 x 60 x 80 mm around the origin, flat sides.
void expect_is_golden_box(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.triangles().size(), 12U);
  EXPECT_TRUE(mesh.min_corner_mm().isApprox(Eigen::Vector3f(-20, -30, -40), 1e-5F));
  EXPECT_TRUE(mesh.max_corner_mm().isApprox(Eigen::Vector3f(20, 30, 40), 1e-5F));
  double area_mm2 = 0;
  for (const Triangle& t : mesh.triangles()) {
    const auto at = [&](int c) -> const MeshVertex& { return mesh.vertices()[t[c]]; };
    const Eigen::Vector3f scaled_normal =
        (at(1).position_mm - at(0).position_mm).cross(at(2).position_mm - at(0).position_mm);
    area_mm2 += 0.5 * scaled_normal.norm();
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(std::abs(at(c).normal.dot(scaled_normal.normalized())), 1, 1e-5);
    }
  }
  EXPECT_NEAR(area_mm2, 2 * (40 * 60 + 60 * 80 + 40 * 80), 0.1);
}

void expect_is_textured_like_golden_box(const TriangleMesh& mesh) {
  for (const MeshVertex& v : mesh.vertices()) {
    const Eigen::Vector3f& p = v.position_mm;
    EXPECT_NEAR(v.uv.x(), (p.x() + 20) / 80 + (p.y() + 30) / 120, 1e-5);
    EXPECT_NEAR(v.uv.y(), (40 - p.z()) / 80, 1e-5);
  }
  ASSERT_TRUE(mesh.has_texture());
  const cv::Mat& texture = mesh.texture_levels().front();
  ASSERT_EQ(texture.size(), cv::Size(4, 2));
  EXPECT_EQ(texture.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 255)) << "red above";
  EXPECT_EQ(texture.at<cv::Vec3b>(1, 3), cv::Vec3b(255, 0, 0)) << "blue below";
}

void expect_albedo(const TriangleMesh& mesh, const Eigen::Vector3f& bgr) {
  for (const MeshVertex& v : mesh.vertices()) {
    EXPECT_TRUE(v.albedo_bgr.isApprox(bgr, 1e-4F)) << v.albedo_bgr.transpose();
  }
}

TEST(MeshFile, ReadsObjWithMaterialAndTexture) {
  const TriangleMesh mesh = load_mesh(golden("box.obj"));
  expect_is_golden_box(mesh);
  expect_is_textured_like_golden_box(mesh);
  expect_albedo(mesh, {1, 0.75F, 0.5F});
}

TEST(MeshFile, ReadsGltfWithThePictureInsideAndBeside) {
  for (const char* name : {"box.glb", "box.gltf"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = load_mesh(golden(name), LengthUnit::metre);
    expect_is_golden_box(mesh);
    expect_is_textured_like_golden_box(mesh);
    expect_albedo(mesh, {0, 0.5F, 1});
  }
}

TEST(MeshFile, ReadsPlyWithVertexColours) {
  for (const char* name : {"box.ply", "box_binary.ply"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = load_mesh(golden(name));
    expect_is_golden_box(mesh);
    EXPECT_FALSE(mesh.has_texture());
    for (const MeshVertex& v : mesh.vertices()) {
      const Eigen::Vector3f& p = v.position_mm;
      EXPECT_EQ(v.albedo_bgr, Eigen::Vector3f(p.z() > 0, p.y() > 0, p.x() > 0));
    }
  }
}

TEST(MeshFile, ReadsStlAsTextAndBinary) {
  for (const char* name : {"box.stl", "box_binary.stl"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = load_mesh(golden(name));
    expect_is_golden_box(mesh);
    expect_albedo(mesh, {0.8F, 0.8F, 0.8F});
  }
}

TEST(MeshFile, ReadsBothLayoutsOfIvtMatrices) {
  for (const char* name : {"box18.dat", "box6.dat"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = load_mesh(golden(name));
    expect_is_golden_box(mesh);
    expect_is_textured_like_golden_box(mesh);
    expect_albedo(mesh, {1, 1, 1});
  }
}

TEST(MeshFile, ReadsIvtMatricesWithoutTexture) {
  const TriangleMesh mesh = load_mesh(golden("plain.dat"));
  expect_is_golden_box(mesh);
  EXPECT_FALSE(mesh.has_texture());
}

TEST(MeshFile, ReadsCaoWithItsParts) {
  expect_is_golden_box(load_mesh(golden("box.cao"), LengthUnit::metre));
}

TEST(MeshFile, KeepsSmoothNormalsOfTheFile) {
  TemporaryFolder folder;
  const auto path =
      folder.write("tent.obj", "v 0 0 0\nv 50 0 0\nv 0 50 0\nvn 0 0.6 0.8\nf 1//1 2//1 3//1\n");
  for (const MeshVertex& v : load_mesh(path).vertices()) {
    EXPECT_TRUE(v.normal.isApprox(Eigen::Vector3f(0, 0.6F, 0.8F)));
  }
}

TEST(MeshFile, TreatsBlackBesideATextureAsTheTextureAlone) {
  TemporaryFolder folder;
  for (const char* name : {"box.obj", "box.png"}) folder.copy_golden(name);
  folder.write("box.mtl", "newmtl painted\nKd 0 0 0\nmap_Kd box.png\n");
  expect_albedo(load_mesh(folder.path() / "box.obj"), {1, 1, 1});
}

TEST(MeshFile, FindsTexturesWrittenWithBackslashes) {
  TemporaryFolder folder;
  folder.copy_golden("box.obj");
  folder.write("pictures/box.png", content_of(golden("box.png")));
  folder.write("box.mtl", "newmtl painted\nmap_Kd pictures\\box.png\n");
  EXPECT_TRUE(load_mesh(folder.path() / "box.obj").has_texture());
}

TEST(MeshFile, MultipliesByTheUnitAndReportsTheSize) {
  std::string reported;
  set_log_sink([&](LogLevel, std::string_view message) { reported = message; });
  const TriangleMesh mesh = load_mesh(golden("plain.dat"), LengthUnit::centimetre);
  set_log_sink({});
  EXPECT_NEAR(mesh.diameter_mm(), 1077.03, 0.01);
  EXPECT_NE(reported.find("12 triangles, 1077.03 mm across"), std::string::npos) << reported;
}

TEST(MeshFile, RefusesAbsurdSizesWithAHintAboutTheUnit) {
  const auto path = golden("box.glb");
  expect_file_error([&] { load_mesh(path); }, path, "", "--model-unit m)");
  expect_file_error([&] { load_mesh(golden("plain.dat"), LengthUnit::metre); }, golden("plain.dat"),
                    "", "--model-unit mm)");
}

TEST(MeshFile, ParsesUnits) {
  EXPECT_EQ(parse_length_unit("mm"), LengthUnit::millimetre);
  EXPECT_EQ(parse_length_unit("cm"), LengthUnit::centimetre);
  EXPECT_EQ(parse_length_unit("m"), LengthUnit::metre);
  EXPECT_THROW(parse_length_unit("inch"), ConfigError);
  EXPECT_THROW(parse_length_unit(""), ConfigError);
}

}  // namespace
}  // namespace anneal6d
