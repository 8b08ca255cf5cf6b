// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/pose_file.h"
#include "anneal6d/framework/sequence_folder.h"
#include "tool_runner.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

class Simulate : public ToolTest {
 protected:
  std::string model_ = " --model " + quoted((sequence_ / "model.obj").string());

  void SetUp() override {
    if (const std::string why = why_no_opengl(); !why.empty()) GTEST_SKIP() << why;
  }
};

TEST_F(Simulate, WritesASequenceThatCanBeTracked) {
  const ProgramRun run = tool("simulate out --frames 4 --seed 2 --noise 1" + model_);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(only_has({"out"}));
  const SequenceFolder folder = open_sequence_folder(scratch_ / "out");
  EXPECT_EQ(folder.images.size(), 4U);
  EXPECT_EQ(folder.ground_truth.size(), 4U);
  EXPECT_TRUE(folder.camera_file && folder.model_file);
  EXPECT_EQ(tool("evaluate out" + fast_).status, 0);
}

TEST_F(Simulate, ATrackerThatStartsLaterStartsAtTheTruthOfThatFrame) {
  const std::string start = " --start 30 --init \"0 0 600 1 0 0 0\" --frames 1" + model_;
  const ProgramRun run = tool("track simulate:" + start + fast_);
  ASSERT_EQ(run.status, 0) << run.err;
  ASSERT_EQ(tool("simulate out --frames 31 --init \"0 0 600 1 0 0 0\"" + model_).status, 0);
  const Pose truth = open_sequence_folder(scratch_ / "out").ground_truth.at(30);
  const std::vector<std::string> row = cells_of(run.out.substr(run.out.find('\n') + 1));
  ASSERT_EQ(row.at(0), "30");
  EXPECT_NEAR(std::stod(row.at(1)), truth.translation_mm.x(), 1e-3);
  EXPECT_NEAR(std::stod(row.at(3)), truth.translation_mm.z(), 1e-3);
  EXPECT_GT((truth.translation_mm - Eigen::Vector3d(0, 0, 600)).norm(), 1) << "it moved";
}

TEST_F(Simulate, GivesTheSameImagesForTheSameSeed) {
  const std::string options =
      " --frames 2 --motion manipulation --background clutter --occluder on --light moving"
      " --noise 3 --supersampling 1" +
      model_;
  ASSERT_EQ(tool("simulate a --seed 9" + options).status, 0);
  ASSERT_EQ(tool("simulate b --seed 9" + options).status, 0);
  ASSERT_EQ(tool("simulate c --seed 8" + options).status, 0);
  const auto image = [&](const char* folder) {
    return read_file(scratch_ / folder / "frame_0001.png");
  };
  EXPECT_EQ(image("a"), image("b"));
  EXPECT_NE(image("a"), image("c"));
}

TEST_F(Simulate, RefusesBadOptionsAndLeavesNothing) {
  expect_refused("simulate out --frames 0" + model_, 2, {"--frames"});
  expect_refused("simulate out --sigma-mm nan" + model_, 2, {"--sigma-mm"});
  expect_refused("simulate out --motion flying" + model_, 2, {"flying", "random-walk"});
  expect_refused("simulate out --light off" + model_, 2, {"off", "moving"});
  expect_refused("simulate out --init \"0 0 -500 1 0 0 0\"" + model_, 2, {});
  expect_refused("simulate out --background nowhere.png" + model_, 1, {"nowhere.png"});
  expect_refused("simulate out --model nowhere.obj", 1, {"nowhere.obj"});
  EXPECT_TRUE(only_has({}));
}

TEST_F(Simulate, DoesNotTouchAFolderThatHoldsSomethingElse) {
  fs::create_directories(scratch_ / "out");
  write("out/thesis.txt", "years of work");
  expect_refused("simulate out --frames 2 --force" + model_, 1, {"out"});
  EXPECT_EQ(lines_of(scratch_ / "out/thesis.txt").size(), 1U);
}

TEST_F(Simulate, ReplacesASequenceOnlyByForce) {
  const std::string options = "simulate out --frames 2" + model_;
  ASSERT_EQ(tool(options).status, 0);
  expect_refused(options, 1, {"out"});
  EXPECT_EQ(tool(options + " --force").status, 0);
}

}  // namespace
}  // namespace anneal6d
