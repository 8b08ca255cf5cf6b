// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <string>

#include "anneal6d/framework/float_matrix_file.h"
#include "anneal6d/framework/mesh_file.h"
#include "file_test_support.h"

namespace anneal6d {
namespace {

using test::content_of;
using test::expect_file_error;
using test::golden;
using test::replaced;
using test::TemporaryFolder;

class BadMeshFile : public testing::Test {
 protected:
  void expect_error(const std::string& name, const std::string& content, const std::string& words) {
    expect_error_about(folder_.write(name, content), name, words);
  }
  /// Loading `name` fails because of the file `culprit`.
  void expect_error_about(const std::filesystem::path& culprit, const std::string& name,
                          const std::string& words, const std::string& place = "") {
    expect_file_error([&] { load_mesh(folder_.path() / name); }, culprit, place, words);
  }
  std::filesystem::path in_folder(const std::string& name) const { return folder_.path() / name; }

  TemporaryFolder folder_;
};

const char* const kTriangleObj = "v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n";

TEST_F(BadMeshFile, IsMissing) {
  for (const char* name : {"m.obj", "m.ply", "m.stl", "m.gltf", "m.glb", "m.dat", "m.cao"}) {
    SCOPED_TRACE(name);
    expect_error_about(in_folder(name), name, "does not exist");
  }
}

TEST_F(BadMeshFile, IsAFolder) {
  for (const char* name : {"m.obj", "m.dat", "m.cao"}) {
    SCOPED_TRACE(name);
    std::filesystem::create_directory(in_folder(name));
    expect_error_about(in_folder(name), name, "is a folder");
  }
}

TEST_F(BadMeshFile, HasAnUnknownEnding) {
  expect_error("model.txt", kTriangleObj, "unknown ending");
  expect_error("model", kTriangleObj, "unknown ending");
}

TEST_F(BadMeshFile, IsEmpty) {
  for (const char* name : {"m.obj", "m.ply", "m.stl", "m.gltf", "m.glb"}) {
    SCOPED_TRACE(name);
    expect_error(name, "", "is malformed");
  }
}

TEST_F(BadMeshFile, IsOfAnotherFormatThanItsEndingSays) {
  for (const char* name : {"m.ply", "m.stl", "m.gltf", "m.glb"}) {
    SCOPED_TRACE(name);
    expect_error(name, std::string(kTriangleObj) + std::string(200, '#'), "");
  }
  expect_error("m.obj", content_of(golden("box.png")), "");
}

TEST_F(BadMeshFile, IsTruncated) {
  for (const char* name : {"box.ply", "box_binary.ply", "box.stl", "box_binary.stl", "box.glb",
                           "box.gltf", "box.cao"}) {
    const std::string content = content_of(golden(name));
    for (const double share : {0.1, 0.5, 0.9}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(share));
      folder_.copy_golden("box_sides.cao");
      const auto path = folder_.write(
          name,
          content.substr(0, static_cast<std::size_t>(share * static_cast<double>(content.size()))));
      EXPECT_THROW(load_mesh(path, LengthUnit::metre), FileError);
      EXPECT_THROW(load_mesh(path), FileError);
    }
  }
}

TEST_F(BadMeshFile, HasNoTriangle) {
  expect_error("points.obj", "v 0 0 0\nv 50 0 0\nv 0 50 0\np 1 2 3\n", "");
  expect_error("lines.obj", "v 0 0 0\nv 50 0 0\nv 0 50 0\nl 1 2 3\n", "");
  expect_error("nothing.obj", "# nothing but a comment, long enough to be looked at\n", "");
}

TEST_F(BadMeshFile, HasOnlyDegenerateTriangles) {
  expect_error("flat.obj", "v 0 0 0\nv 50 0 0\nv 25 0 0\nf 1 2 3\n", "no area");
  expect_error("point.obj", "v 9 9 9\nf 1 1 1\n", "0 mm across");
}

TEST_F(BadMeshFile, HasCoordinatesThatAreNotFinite) {
  expect_error("nan.obj", "v 0 0 nan\nv 50 0 0\nv 0 50 0\nf 1 2 3\n", "");
  expect_error("inf.obj", "v 0 0 1e39\nv 50 0 0\nv 0 50 0\nf 1 2 3\n", "");
}

TEST_F(BadMeshFile, NamesVerticesThatDoNotExist) {
  expect_error("index.obj", "v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 4\n", "");
  expect_error("index.ply", replaced(content_of(golden("box.ply")), "4 0 4 6 2", "4 0 4 6 99"), "");
}

TEST_F(BadMeshFile, LiesFarFromItsOrigin) {
  expect_error("far.obj", "v 0 0 1e6\nv 50 0 1e6\nv 0 50 1e6\nf 1 2 3\n",
               "1000 m away from its origin");
}

TEST_F(BadMeshFile, HasAColourOutsideItsRange) {
  folder_.write("m.mtl", "newmtl a\nKd 7 0 0\n");
  expect_error("m.obj", std::string("mtllib m.mtl\nusemtl a\n") + kTriangleObj, "albedo");
}

TEST_F(BadMeshFile, LacksItsMaterialFile) {
  folder_.copy_golden("box.obj");
  expect_error_about(in_folder("box.mtl"), "box.obj", "does not exist");
}

TEST_F(BadMeshFile, LacksItsTexture) {
  folder_.copy_golden("box.obj");
  folder_.copy_golden("box.mtl");
  expect_error_about(in_folder("box.png"), "box.obj", "does not exist");
}

TEST_F(BadMeshFile, HasATextureThatIsNoImage) {
  folder_.copy_golden("box.obj");
  folder_.copy_golden("box.mtl");
  for (const std::string& content :
       {std::string("this is text"), std::string(), content_of(golden("box.png")).substr(0, 50)}) {
    const auto texture = folder_.write("box.png", content);
    expect_error_about(texture, "box.obj", "damaged or no image");
  }
}

TEST_F(BadMeshFile, HasSeveralTextures) {
  folder_.copy_golden("box.png");
  folder_.write("two.mtl",
                "newmtl a\nmap_Kd box.png\nnewmtl b\nmap_Kd other.png\nnewmtl c\nKd 1 1 1\n");
  const std::string vertices =
      "mtllib two.mtl\nv 0 0 0\nv 50 0 0\nv 0 50 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
  const std::string face = "f 1/1 2/2 3/3\n";
  expect_error("several.obj", vertices + "usemtl a\n" + face + "usemtl b\n" + face,
               "several textures");
  expect_error("parts.obj", vertices + "usemtl a\n" + face + "usemtl c\n" + face,
               "textured in parts");
  expect_error("no_uv.obj", vertices + "usemtl a\nf 1 2 3\n", "no texture coordinates");
}

TEST_F(BadMeshFile, HasAMatrixOfAnotherShape) {
  save_float_matrix(FloatMatrix::Ones(4, 5), in_folder("five.dat"));
  expect_error_about(in_folder("five.dat"), "five.dat", "4 rows of 5 columns", "header");
  save_float_matrix(FloatMatrix::Ones(4, 6), in_folder("four.dat"));
  expect_error_about(in_folder("four.dat"), "four.dat", "three rows a triangle", "header");
}

TEST_F(BadMeshFile, HasTextureMatricesThatDoNotFit) {
  folder_.copy_golden("box18.dat");
  folder_.copy_golden("box18.bmp");
  expect_error_about(in_folder("box18Tex.dat"), "box18.dat", "does not exist");
  save_float_matrix(FloatMatrix::Zero(11, 6), in_folder("box18Tex.dat"));
  expect_error_about(in_folder("box18Tex.dat"), "box18.dat", "12 triangles", "header");
  save_float_matrix(FloatMatrix::Zero(36, 2), in_folder("box18Tex.dat"));
  expect_error_about(in_folder("box18Tex.dat"), "box18.dat", "6 columns", "header");
  folder_.copy_golden("box18Tex.dat");
  std::filesystem::remove(in_folder("box18.bmp"));
  expect_error_about(in_folder("box18.bmp"), "box18.dat", "does not exist");
  folder_.write("box18.bmp", "BM, but no picture");
  expect_error_about(in_folder("box18.bmp"), "box18.dat", "damaged or no image");
}

}  // namespace
}  // namespace anneal6d
