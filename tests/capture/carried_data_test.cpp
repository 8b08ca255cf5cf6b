// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
// The models and the sequence that the repository carries.
#include <gtest/gtest.h>

#include "anneal6d/capture/sequence_source.h"
#include "anneal6d/framework/mesh_file.h"

namespace anneal6d {
namespace {

const std::filesystem::path kTestData = ANNEAL6D_TEST_DATA;
const std::filesystem::path kModels = kTestData / ".." / ".." / "samples" / "models";

TEST(CarriedModels, HaveTheSizesThatTheirReadmeStates) {
  const TriangleMesh cup = load_mesh(kModels / "measuring_cup.obj");
  EXPECT_EQ(cup.triangles().size(), 1560U);
  EXPECT_NEAR(cup.max_corner_mm().y() - cup.min_corner_mm().y(), 143, 0.01);
  EXPECT_FALSE(cup.has_texture());

  const TriangleMesh can = load_mesh(kModels / "oil_can.obj");
  EXPECT_EQ(can.triangles().size(), 1496U);
  EXPECT_NEAR(can.max_corner_mm().y() - can.min_corner_mm().y(), 216, 0.01);
  ASSERT_TRUE(can.has_texture());
  EXPECT_EQ(can.texture_levels()[0].size(), cv::Size(512, 512));

  const TriangleMesh cube = load_mesh(kModels / "cube84.obj");
  EXPECT_EQ(cube.triangles().size(), 12U);
  EXPECT_EQ(cube.min_corner_mm(), Eigen::Vector3f(-84, 0, 0));
  EXPECT_EQ(cube.max_corner_mm(), Eigen::Vector3f(0, 84, 84));
}

TEST(CarriedModels, FaceOutward) {
  for (const char* name : {"measuring_cup.obj", "oil_can.obj", "cube84.obj"}) {
    const TriangleMesh mesh = load_mesh(kModels / name);
    const auto vertices = mesh.vertices();
    double volume_mm3 = 0;
    for (const Triangle& triangle : mesh.triangles()) {
      const Eigen::Vector3d a = vertices[triangle[0]].position_mm.cast<double>();
      const Eigen::Vector3d b = vertices[triangle[1]].position_mm.cast<double>();
      const Eigen::Vector3d c = vertices[triangle[2]].position_mm.cast<double>();
      volume_mm3 += a.dot(b.cross(c)) / 6;
      const Eigen::Vector3d face = (b - a).cross(c - a).normalized();
      for (const std::uint32_t corner : triangle) {
        EXPECT_GT(face.dot(vertices[corner].normal.cast<double>()), 0.3) << name;
      }
    }
    EXPECT_GT(volume_mm3, 1e5) << name;
  }
}

TEST(CarriedModels, HaveTheCalibrationOfTheRealCube) {
  const CameraModel camera = load_camera(kModels / "cube_real_camera.yml");
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_DOUBLE_EQ(camera.fy_px, 542.0744058);
  EXPECT_FALSE(camera.has_distortion());
}

TEST(CarriedSequence, HasTwentyFramesWithCalibrationModelAndTruth) {
  SequenceSource source(kTestData / "sequence_short");
  ASSERT_TRUE(source.camera());
  ASSERT_TRUE(source.folder().model_file);
  EXPECT_EQ(load_mesh(*source.folder().model_file).triangles().size(), 1560U);
  int frames = 0;
  while (source.next()) {
    ++frames;
    EXPECT_TRUE(source.ground_truth());
  }
  EXPECT_EQ(frames, 20);
}

}  // namespace
}  // namespace anneal6d
