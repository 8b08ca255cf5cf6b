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
  expect_error("m.obj", "", "holds no triangle");
  expect_error_about(folder_.write("m.gltf", ""), "m.gltf", "no valid JSON", "byte 1");
  expect_error_about(folder_.write("m.glb", ""), "m.glb", "no binary glTF", "byte 0");
  expect_error("m.ply", "", "should begin with 'ply'");
  expect_error("m.stl", "", "is no STL model");
}

TEST_F(BadMeshFile, IsOfAnotherFormatThanItsEndingSays) {
  const std::string obj = kTriangleObj + std::string(200, '#');
  expect_error("m.ply", obj, "should begin with 'ply'");
  expect_error("m.stl", obj, "is no STL model");
  expect_error_about(folder_.write("m.gltf", obj), "m.gltf", "no valid JSON", "byte 1");
  expect_error_about(folder_.write("m.glb", obj), "m.glb", "no binary glTF", "byte 0");
  expect_error_about(folder_.write("m.obj", content_of(golden("box.png"))), "m.obj",
                     "no statement of a polygon model", "line 1");
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
  expect_error("points.obj", "v 0 0 0\nv 50 0 0\nv 0 50 0\np 1 2 3\n", "holds no triangle");
  expect_error("lines.obj", "v 0 0 0\nv 50 0 0\nv 0 50 0\nl 1 2 3\n", "holds no triangle");
  expect_error("nothing.obj", "# nothing but a comment, long enough to be looked at\n",
               "holds no triangle");
}

TEST_F(BadMeshFile, HasOnlyDegenerateTriangles) {
  expect_error("flat.obj", "v 0 0 0\nv 50 0 0\nv 25 0 0\nf 1 2 3\n", "no area");
  expect_error("point.obj", "v 9 9 9\nf 1 1 1\n", "0 mm across");
}

TEST_F(BadMeshFile, HasCoordinatesThatAreNotFinite) {
  expect_error_about(folder_.write("nan.obj", "v 0 0 nan\n"), "nan.obj", "'nan'", "line 1");
  expect_error("inf.obj", "v 0 0 1e39\nv 50 0 0\nv 0 50 0\nf 1 2 3\n", "not finite");
}

TEST_F(BadMeshFile, NamesVerticesThatDoNotExist) {
  const auto ply = folder_.write(
      "index.ply", replaced(content_of(golden("box.ply")), "4 0 4 6 2", "4 0 4 6 99"));
  expect_error_about(ply, "index.ply", "names a vertex that does not exist", "line 21");
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
  const auto expect = [&](const std::string& faces, const std::string& place,
                          const std::string& words) {
    expect_error_about(folder_.write("m.obj", vertices + faces), "m.obj", words, place);
  };
  expect("usemtl a\n" + face + "usemtl b\n" + face, "line 11", "several textures");
  expect("usemtl a\n" + face + "usemtl c\n" + face, "line 11", "textured in parts");
  expect("usemtl a\nf 1 2 3\n", "line 9", "no texture coordinates");
}

TEST_F(BadMeshFile, IsMalformedObj) {
  const auto expect = [&](const std::string& lines, const std::string& place,
                          const std::string& words) {
    expect_error_about(folder_.write("m.obj", kTriangleObj + lines), "m.obj", words, place);
  };
  expect("v 0 0\n", "line 5", "3 or 6 numbers");
  expect("v 0 0 5o\n", "line 5", "'5o' should be a finite number");
  expect("v 0 0 1 \\\n  2\n", "line 5", "a weight other than 1");
  expect("vt\n", "line 5", "'vt' needs 1 or more numbers");
  expect("vn 0 1\n", "line 5", "'vn' needs 3 or more numbers");
  expect("f 1 2\n", "line 5", "2 corners; 3 to 512");
  for (const char* corner :
       {"0", "4", "-4", "x", "1.5", "/1", "1/1", "1//1", "99999999999999999999"}) {
    expect(std::string("f 1 2 ") + corner + "\n", "line 5", "names nothing");
  }
  expect("vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n", "line 7", "should be a corner");
  expect("curv 0 1 1 2\n", "line 5", "no statement of a polygon model");
  expect("mtllib\n", "line 5", "names no file");
}

TEST_F(BadMeshFile, IsMalformedMtl) {
  folder_.copy_golden("box.obj");
  folder_.copy_golden("box.png");
  const auto expect = [&](const std::string& content, const std::string& place,
                          const std::string& words) {
    expect_error_about(folder_.write("box.mtl", content), "box.obj", words, place);
  };
  expect("Kd 1 1 1\n", "line 1", "should follow newmtl");
  expect("newmtl painted\nKd 1 1\n", "line 2", "3 or more numbers");
  expect("newmtl painted\nKd 1 red 1\n", "line 2", "'red'");
  expect("newmtl painted\n\nnewmtl painted\n", "line 3", "a second time");
  expect("newmtl painted\nmap_Kd -s 2 2 1 box.png\n", "line 2", "moves or scales");
  expect("newmtl painted\nmap_Kd -what box.png\n", "line 2", "'-what' is no option");
  expect("newmtl painted\nmap_Kd -clamp\n", "line 2", "names no file");
  folder_.write("box.mtl", "newmtl other\n");
  expect_error_about(in_folder("box.obj"), "box.obj", "'painted' is in no file", "line 25");
}

TEST_F(BadMeshFile, IsPlyThatContradictsItsHeader) {
  const std::string text = content_of(golden("box.ply")),
                    binary = content_of(golden("box_binary.ply"));
  const auto expect = [&](const std::string& content, const std::string& place,
                          const std::string& words) {
    expect_error_about(folder_.write("m.ply", content), "m.ply", words, place);
  };
  expect(replaced(text, "element vertex 8", "element vertex 9"), "line 22", "1 corners");
  expect(replaced(text, "element face 6", "element face 7"), "line 27", "the file ends");
  expect(replaced(text, "element face 6", "element face 5"), "line 26", "more values");
  expect(replaced(text, "element face 6", "element face -6"), "line 10", "whole number");
  expect(replaced(text, "element face 6", "element face 4000000000"), "line 27", "the file ends");
  expect(replaced(binary, "element vertex 8", "element vertex 4000000000"), "byte 460",
         "the file ends");
  expect(binary + "!", "byte 451", "more values");
  expect(replaced(text, "20 30 40 255", "20 30 40 256"), "line 20", "its type, uchar");
  expect(replaced(text, "20 30 40 255", "20 30 inf 255"), "line 20", "'inf'");
  expect(replaced(text, "property float z", "property float w"), "header", "x, y and z");
  expect(replaced(text, "property float z", "property real z"), "line 6", "'real' is no type");
  expect(replaced(text, "vertex_indices", "indices"), "header", "vertex_indices");
  expect(replaced(text, "ascii", "base64"), "line 2", "'base64' is no format");
  expect(replaced(text, "end_header", ""), "line 13", "'-20' is unknown");
  expect(replaced(text, "4 0 4 6 2", "2 0 4"), "line 21", "2 corners");
  expect(replaced(text, "ply\n", "ply\ncomment TextureFile box.png\n"), "header",
         "no texture coordinates");
}

TEST_F(BadMeshFile, IsMalformedStl) {
  const std::string text = content_of(golden("box.stl")),
                    binary = content_of(golden("box_binary.stl"));
  const auto expect = [&](const std::string& content, const std::string& place,
                          const std::string& words) {
    expect_error_about(folder_.write("m.stl", content), "m.stl", words, place);
  };
  expect(replaced(text, "vertex", "vortex"), "line 4", "'vortex' should be 'vertex'");
  expect(replaced(text, "vertex -20", "vertex -2o"), "line 4", "'-2o'");
  expect(replaced(text, "endsolid box", ""), "line 87", "the file ends where 'endsolid'");
  expect(text + "more", "line 87", "'more' should be 'solid'");
  expect(binary + "!", "", "is no STL model");
  expect("solid" + binary.substr(5, 600), "line 1", "should be 'solid'");
  std::string infinite = binary;
  infinite.replace(84 + 12, 4, std::string("\0\0\x80\x7F", 4));
  expect(infinite, "byte 84", "not finite");
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
