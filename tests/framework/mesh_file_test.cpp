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

TEST(MeshFile, ReadsObjWithColoursNegativeNumbersAndJoinedLines) {
  TemporaryFolder folder;
  const auto path = folder.write("m.obj",
                                 "# made by hand\r\nmtllib a file.mtl\r\no thing\r\n"
                                 "v 0 0 0 1 0 0\r\nv 50 0 0 0 1 0 # green\r\nv 0 50 0 0 0 1\r\n"
                                 "usemtl dim paint\r\nf -3 \\\r\n -2 -1\r\nl 1 2\r\n");
  folder.write("a file.mtl", "newmtl dim paint\nKd 0.5 0.5 0.5\nillum 2\n");
  const TriangleMesh mesh = load_mesh(path);
  ASSERT_EQ(mesh.triangles().size(), 1U);
  ASSERT_EQ(mesh.vertices().size(), 3U);
  EXPECT_EQ(mesh.vertices()[0].albedo_bgr, Eigen::Vector3f(0, 0, 0.5F));
  EXPECT_EQ(mesh.vertices()[2].albedo_bgr, Eigen::Vector3f(0.5F, 0, 0));
}

TEST(MeshFile, ReadsObjWithoutAnyMaterial) {
  TemporaryFolder folder;
  const std::string points = "v 0 0 0\nv 50 0 0\nv 0 50 0\n";
  expect_albedo(load_mesh(folder.write("plain.obj", points + "usemtl lost\nf 1 2 3\n")),
                {0.8F, 0.8F, 0.8F});
}

TEST(MeshFile, CutsConcaveFacesOfObj) {
  TemporaryFolder folder;
  const auto path = folder.write(
      "l.obj", "v 0 0 0\nv 30 0 0\nv 30 10 0\nv 10 10 0\nv 10 30 0\nv 0 30 0\nf 4 5 6 1 2 3\n");
  const TriangleMesh mesh = load_mesh(path);
  double area_mm2 = 0;
  for (const Triangle& t : mesh.triangles()) {
    const Eigen::Vector3f& a = mesh.vertices()[t[0]].position_mm;
    area_mm2 +=
        0.5 *
        (mesh.vertices()[t[1]].position_mm - a).cross(mesh.vertices()[t[2]].position_mm - a).norm();
  }
  EXPECT_NEAR(area_mm2, 500, 1e-3);
}

TEST(MeshFile, SkipsNeutralOptionsOfTextures) {
  TemporaryFolder folder;
  for (const char* name : {"box.obj", "box.png"}) folder.copy_golden(name);
  folder.write("box.mtl", "newmtl painted\nmap_Kd -s 1 1 1 -o 0 0 -clamp on -mm 0 1 box.png\n");
  EXPECT_TRUE(load_mesh(folder.path() / "box.obj").has_texture());
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

TEST(MeshFile, ReadsPlyWithNormalsAndATexture) {
  TemporaryFolder folder;
  folder.copy_golden("box.png");
  const std::string header =
      "ply\nformat ascii 1.0\ncomment TextureFile box.png\nobj_info x\nelement vertex 3\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property float nx\nproperty float ny\nproperty float nz\n";
  const auto per_vertex = folder.write(
      "vertex.ply", header +
                        "property float texture_u\nproperty float texture_v\nelement face 1\n"
                        "property list uchar uint vertex_index\nelement camera 1\n"
                        "property float focal\nend_header\n"
                        "0 0 0 0 0 2 0 0\n50 0 0 0 0 2 1 0\n0 50 0 0 0 2 0 0.25\n3 0 1 2\n35\n");
  const auto per_corner = folder.write(
      "corner.ply", header +
                        "element face 1\nproperty list uchar int vertex_indices\n"
                        "property list uchar float texcoord\nend_header\n"
                        "0 0 0 0 0 2\n50 0 0 0 0 2\n0 50 0 0 0 2\n3 0 1 2 6 0 0 1 0 0 0.25\n");
  for (const auto& path : {per_vertex, per_corner}) {
    SCOPED_TRACE(path);
    const TriangleMesh mesh = load_mesh(path);
    EXPECT_TRUE(mesh.has_texture());
    ASSERT_EQ(mesh.vertices().size(), 3U);
    EXPECT_EQ(mesh.vertices()[1].uv, Eigen::Vector2f(1, 1));
    EXPECT_EQ(mesh.vertices()[2].uv, Eigen::Vector2f(0, 0.75F)) << "v from the top";
    EXPECT_EQ(mesh.vertices()[2].normal, Eigen::Vector3f::UnitZ());
    expect_albedo(mesh, {1, 1, 1});
  }
}

TEST(MeshFile, ReadsPlyWithTheHighByteFirst) {
  TemporaryFolder folder;
  const auto path = folder.write(
      "big.ply",
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty short y\n"
      "property int8 z\nelement face 1\nproperty list ushort uchar vertex_indices\nend_header\n" +
          std::string("\0\0\0\0\0\x01\x2C\0\0\0\0\0\0\x32\xFF\0\x03\0\x01\x02", 20));
  const TriangleMesh mesh = load_mesh(path);
  EXPECT_EQ(mesh.min_corner_mm(), Eigen::Vector3f(0, 0, -1));
  EXPECT_EQ(mesh.max_corner_mm(), Eigen::Vector3f(300, 50, 0));
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
  const TriangleMesh mesh = load_mesh(path);
  for (const MeshVertex& v : mesh.vertices()) {
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
