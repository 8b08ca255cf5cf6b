// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Runs over the images of the Debian package visp-images-data, which are read where they lie.

#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/pose_file.h"
#include "tool_runner.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

class RealSequence : public ToolTest {
 protected:
  void SetUp() override {
    if (!fs::exists(package_)) {
      GTEST_SKIP() << package_.string() << " is not there; install the package visp-images-data";
    }
  }

  static std::string path(const fs::path& file) { return " " + quoted(file.string()); }

  fs::path package_ = "/usr/share/visp-images-data/ViSP-images";
};

TEST_F(RealSequence, CubePulledByAHandIsFollowed) {
  save_camera({640, 480, 547.7367575, 542.0744058, 338.7036994, 234.5083345, {}},
              scratch_ / "camera.yml");
  const ProgramRun run =
      tool("track" + path(package_ / "mbt/cube") + " --frames 61 --camera camera.yml --model" +
           path(package_ / "mbt/cube.cao") +
           " --model-unit m --poses p.csv --init \"20.4476989 "
           "110.150545 507.896372 0.369745373 0.80422149 0.432676095 -0.171194482\"");
  ASSERT_EQ(run.status, 0) << run.err;
  // Where ViSP's edge and KLT tracker sees the cube, which is right to about 7 mm and 2 degrees.
  const Pose there =
      parse_pose("54.3627194 60.723988 567.593494 0.382850862 0.88860287 0.23907264 -0.0815746839");
  const Pose pose = load_poses(scratch_ / "p.csv").at(60);
  EXPECT_LT((pose.translation_mm - there.translation_mm).norm(), 20);
  EXPECT_LT(angle_between(pose.rotation, there.rotation), 0.1);
}

TEST_F(RealSequence, RenderedCastleIsFollowedExactly) {
  const fs::path castle = package_ / "mbt-depth/Castle-simu";
  fs::create_directory(scratch_ / "castle");
  std::map<std::int64_t, Pose> truth;
  for (int frame = 0; frame < 15; ++frame) {
    char name[32];
    std::snprintf(name, sizeof name, "Image_%04d.pgm", frame + 1);
    fs::copy(castle / "Images" / name, scratch_ / "castle");
    std::snprintf(name, sizeof name, "Camera_%03d.txt", frame + 1);
    std::ifstream file(castle / "CameraPose" / name);
    Eigen::Matrix4d camera_from_object;  // metres
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) file >> camera_from_object(row, column);
    }
    ASSERT_TRUE(file) << name;
    const Eigen::Matrix3d rotation = camera_from_object.topLeftCorner<3, 3>();
    truth[frame] = {Eigen::Quaterniond(rotation).normalized(),
                    1000 * camera_from_object.topRightCorner<3, 1>()};
  }
  save_poses(truth, scratch_ / "castle/groundtruth.csv");
  // Pixel centres at integer coordinates: the principal point is the middle of 640x480.
  save_camera({640, 480, 700, 700, 319.5, 239.5, {}}, scratch_ / "castle/camera.yml");
  const ProgramRun run = tool("track castle --poses p.csv --model-unit m --model" +
                              path(castle / "Models/chateau.cao"));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto poses = load_poses(scratch_ / "p.csv");
  ASSERT_EQ(poses.size(), truth.size());
  for (const auto& [frame, pose] : poses) {
    EXPECT_LT((pose.translation_mm - truth.at(frame).translation_mm).norm(), 15) << frame;
    EXPECT_LT(angle_between(pose.rotation, truth.at(frame).rotation), 0.05) << frame;
  }
}

}  // namespace
}  // namespace anneal6d
