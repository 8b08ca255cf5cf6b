// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "anneal6d/framework/mesh_file.h"
#include "file_test_support.h"

namespace anneal6d {
namespace {

using test::content_of;
using test::expect_file_error;
using test::golden;
using test::replaced;
using test::TemporaryFolder;

// A triangle (0 0 0), (50 0 0), (0 50 0) in a file of its own, for tests to change: three points,
// then the indices 0 1 2 as bytes.
const std::string kTriangleBin(
    "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x48\x42\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x48\x42\0\0\0\0\0\x01\x02",
    39);
const std::string kTriangle = R"({
  "asset": {"version": "2.0"},
  "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}],
  "bufferViews": [
    {"buffer": 0, "byteLength": 36},
    {"buffer": 0, "byteOffset": 36, "byteLength": 3}],
  "buffers": [{"byteLength": 39, "uri": "a%20file.bin"}]
})";

class GltfFile : public testing::Test {
 protected:
  GltfFile() { folder_.write("a file.bin", kTriangleBin); }

  TriangleMesh load(const std::string& from, const std::string& to) {
    return load_mesh(folder_.write("m.gltf", replaced(kTriangle, from, to)));
  }
  void expect_error(const std::string& from, const std::string& to, const std::string& place,
                    const std::string& words) {
    expect_error_in("m.gltf", replaced(kTriangle, from, to), place, words);
  }
  void expect_error_in(const std::string& name, const std::string& content,
                       const std::string& place, const std::string& words) {
    const auto path = folder_.write(name, content);
    expect_file_error([&] { load_mesh(path); }, path, place, words);
  }
  TemporaryFolder folder_;
};

TEST_F(GltfFile, ReadsABufferBesideIt) {
  const TriangleMesh mesh = load("2.0", "2.1");
  EXPECT_EQ(mesh.triangles().size(), 1U);
  EXPECT_EQ(mesh.max_corner_mm(), Eigen::Vector3f(50, 50, 0));
  for (const MeshVertex& v : mesh.vertices()) EXPECT_EQ(v.albedo_bgr, Eigen::Vector3f::Ones());
}

TEST_F(GltfFile, MultipliesColoursAsLight) {
  const TriangleMesh mesh = load_mesh(folder_.write("m.gltf", R"({
  "asset": {"version": "2.0"},
  "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}],
  "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.05, 1, 0.5, 1]}}],
  "meshes": [{"primitives": [
    {"attributes": {"POSITION": 0, "COLOR_0": 1}, "material": 0}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC4"}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 1, "byteLength": 12}],
  "buffers": [
    {"byteLength": 39, "uri": "a%20file.bin"},
    {"byteLength": 12, "uri": "data:application/octet-stream;base64,DQ0N/w0NDf8NDQ3/"}]
})"));
  const float light = 13.0F / 255;  // encoded: below 0.0031 linearly, by a power above
  for (const MeshVertex& v : mesh.vertices()) {
    EXPECT_NEAR(v.albedo_bgr[2], 12.92F * 0.05F * light, 1e-4);
    EXPECT_NEAR(v.albedo_bgr[1], 1.055F * std::pow(light, 1 / 2.4F) - 0.055F, 1e-4);
    EXPECT_NEAR(v.albedo_bgr[0], 1.055F * std::pow(light / 2, 1 / 2.4F) - 0.055F, 1e-4);
  }
}

TEST_F(GltfFile, ChainsTransformsOfNodes) {
  // A quarter turn about z takes x to y; then doubled and moved by the parent.
  const TriangleMesh mesh =
      load(R"("nodes": [{"mesh": 0}])",
           R"("nodes": [{"children": [1], "scale": [2, 2, 2], "translation": [0, 0, 7]},
                   {"mesh": 0, "rotation": [0, 0, 0.70710678118, 0.70710678118]}])");
  EXPECT_TRUE(mesh.min_corner_mm().isApprox(Eigen::Vector3f(-100, 0, 7), 1e-4F));
  EXPECT_TRUE(mesh.max_corner_mm().isApprox(Eigen::Vector3f(0, 100, 7), 1e-4F));
}

TEST_F(GltfFile, ReadsTrianglesWithoutIndicesAndAsStrips) {
  EXPECT_EQ(load(R"(, "indices": 1)", "").triangles().size(), 1U);
  EXPECT_EQ(load(R"("indices": 1)", R"("indices": 1, "mode": 5)").triangles().size(), 1U);
  EXPECT_EQ(load(R"("indices": 1)", R"("mode": 6)").triangles().size(), 1U);
}

TEST_F(GltfFile, LeavesOutPointsAndLines) {
  expect_error(R"("indices": 1)", R"("indices": 1, "mode": 0)", "", "holds no triangle");
}

TEST_F(GltfFile, SharesOneMeshAmongNodes) {
  const TriangleMesh mesh =
      load(R"("nodes": [0]}],
  "nodes": [{"mesh": 0}])",
           R"("nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [0, 0, 9]}])");
  EXPECT_EQ(mesh.triangles().size(), 2U);
}

TEST_F(GltfFile, RejectsDamagedBinaryFiles) {
  const std::string binary = content_of(golden("box.glb"));
  std::string old = binary;
  old[4] = 1;
  expect_error_in("m.glb", old, "byte 4", "version should be 2");
  expect_error_in("m.glb", binary + "!", "byte 8", "should have 2484 bytes, but has 2485");
  expect_error_in("m.glb", replaced(binary, "JSON", "TEXT"), "byte 12", "a chunk JSON");
  expect_error_in("m.glb", replaced(binary, std::string("BIN\0", 4), "BEAN"), "byte 1176",
                  "a chunk BIN");
  expect_error_in("m.glb", replaced(binary, "\"asset\":", "\"asset\";"), "byte 29",
                  "no valid JSON");
}

TEST_F(GltfFile, RejectsWhatIsNoGltf) {
  expect_error("\"asset\"", "\"basset\"", "asset", "no glTF 2");
  expect_error("\"2.0\"", "\"1.0\"", "asset", "no glTF 2");
  expect_error("\"2.0\"", "1e999", "", "out of range");
  expect_error_in("m.gltf", "[]", "", "a JSON object");
  expect_error_in("m.gltf", std::string(100'000, '['), "", "nested too deeply");
  expect_error("\"scenes\"", "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"], \"scenes\"",
               "extensionsRequired", "'KHR_draco_mesh_compression' is not supported");
}

TEST_F(GltfFile, RejectsReferencesToNothing) {
  expect_error("\"nodes\": [0]", "\"nodes\": [1]", "nodes[1]", "does not exist");
  expect_error("\"mesh\": 0", "\"mesh\": 3", "meshes[3]", "does not exist");
  expect_error("\"indices\": 1", "\"indices\": 2", "accessors[2]", "does not exist");
  expect_error("\"buffer\": 0", "\"buffer\": 1", "buffers[1]", "does not exist");
  expect_error("\"indices\": 1", "\"material\": 0", "materials[0]", "does not exist");
  expect_error("\"mesh\": 0", "\"mesh\": -1", "nodes[0]", "'mesh' should be a whole number");
  expect_error("\"mesh\": 0", "\"mesh\": 99999999999999999999", "nodes[0]", "whole number");
  expect_error("\"mesh\": 0", "\"mesh\": \"cup\"", "nodes[0]", "whole number");
  expect_error("\"asset\"", "\"scene\": 4, \"asset\"", "scenes[4]", "does not exist");
}

TEST_F(GltfFile, RejectsNodesThatContainThemselves) {
  expect_error("{\"mesh\": 0}", "{\"children\": [0]}", "nodes", "contain each other");
}

TEST_F(GltfFile, RejectsNumbersBeyondTheirBuffers) {
  expect_error("\"byteLength\": 39", "\"byteLength\": 40", "buffers[0]", "39 bytes instead of 40");
  expect_error("\"byteOffset\": 36", "\"byteOffset\": 37", "bufferViews[1]", "beyond its buffer");
  expect_error("\"count\": 3", "\"count\": 4", "accessors[0]", "beyond its buffer view");
  expect_error("\"count\": 3", "\"count\": 4294967296", "accessors[0]", "'count' should be");
  expect_error("\"count\": 3", "\"count\": 0", "accessors[0]", "'count' should be");
  expect_error("\"byteLength\": 36", "\"byteLength\": 36, \"byteStride\": 4294967296",
               "accessors[0]", "beyond its buffer view");
  expect_error("\"byteLength\": 36", "\"byteLength\": 36, \"byteStride\": 4", "accessors[0]",
               "beyond its buffer view");
}

TEST_F(GltfFile, RejectsNumbersOfTheWrongKind) {
  expect_error("VEC3", "MAT3", "accessors[0]", "'type' should be");
  expect_error("VEC3", "VEC2", "meshes[0].primitives[0].attributes", "POSITION should have 3");
  expect_error("5126", "5124", "accessors[0]", "'componentType' is unknown");
  expect_error("\"bufferView\": 0, ", "", "accessors[0]", "sparse");
  expect_error("\"mesh\": 0", "\"mesh\": 0, \"matrix\": [1, 2]", "nodes[0]", "16 numbers");
  expect_error("\"POSITION\"", "\"NORMAL\"", "meshes[0].primitives[0]", "no POSITION");
  expect_error("\"indices\": 1", "\"mode\": 7", "meshes[0].primitives[0]", "'mode' is unknown");
}

TEST_F(GltfFile, RejectsIndicesOfNoVertex) {
  std::string bytes = kTriangleBin;
  bytes.back() = 3;
  folder_.write("a file.bin", bytes);
  expect_error("2.0", "2.0", "meshes[0].primitives[0]", "a vertex that does not exist");
}

TEST_F(GltfFile, RejectsMissingFilesAndBrokenBase64) {
  const auto path = folder_.write("m.gltf", replaced(kTriangle, "a%20file.bin", "lost.bin"));
  expect_file_error([&] { load_mesh(path); }, folder_.path() / "lost.bin", "", "does not exist");
  expect_error("a%20file.bin", "data:;base64,AA*A", "buffers[0]", "no sound base64");
  expect_error(", \"uri\": \"a%20file.bin\"", "", "buffers[0]", "neither a 'uri'");
}

TEST_F(GltfFile, RejectsTexturesThatAreMovedOrMissing) {
  folder_.copy_golden("box.png");
  const std::string gltf = content_of(golden("box.gltf"));
  expect_error_in("m.gltf",
                  replaced(gltf, "\"index\": 0",
                           "\"index\": 0, \"extensions\": {\"KHR_texture_transform\": {}}"),
                  "materials[0].baseColorTexture", "bake that into the texture coordinates");
  expect_error_in("m.gltf", replaced(gltf, "\"TEXCOORD_0\": 2", "\"TEXCOORD_1\": 2"),
                  "meshes[0].primitives[0]", "no TEXCOORD");
  expect_error_in("m.gltf", replaced(gltf, "\"uri\": \"box.png\"", "\"name\": \"box\""),
                  "images[0]", "neither a 'bufferView' nor a 'uri'");
  const auto path = folder_.write("m.gltf", replaced(gltf, "box.png", "lost.png"));
  expect_file_error([&] { load_mesh(path, LengthUnit::metre); }, folder_.path() / "lost.png", "",
                    "does not exist");
}

}  // namespace
}  // namespace anneal6d
