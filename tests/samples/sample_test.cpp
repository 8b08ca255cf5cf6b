// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/pose_file.h"
#include "tool_runner.h"

namespace anneal6d {
namespace {

class Sample : public ToolTest {};

TEST_F(Sample, TrackSequencePrintsALineForEachFrame) {
  const ProgramRun run =
      run_program(quoted(ANNEAL6D_SAMPLE_01) + " " + sequence_argument_, scratch_);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 19);  // the first pose is given
  EXPECT_NE(run.out.find("frame  19"), std::string::npos) << run.out;
}

TEST_F(Sample, OwnTrackerFollowsTheShortSequenceAsAPlugin) {
  const ProgramRun run = tool("track " + sequence_argument_ + " --poses p.csv --plugin " +
                              quoted(ANNEAL6D_SAMPLE_02) + " --tracker random-search");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto truth = load_poses(sequence_ / "groundtruth.csv");
  const auto poses = load_poses(scratch_ / "p.csv");
  ASSERT_EQ(poses.size(), truth.size());
  for (const auto& [frame, pose] : poses) {
    EXPECT_LT((pose.translation_mm - truth.at(frame).translation_mm).norm(), 50) << frame;
  }
}

TEST_F(Sample, OwnTrackerIsListedOnceItsPluginIsGiven) {
  EXPECT_EQ(tool("list").out.find("random-search"), std::string::npos);
  const ProgramRun run = tool("list --plugin " + quoted(ANNEAL6D_SAMPLE_02));
  EXPECT_NE(run.out.find("random-search"), std::string::npos) << run.err;
}

TEST_F(Sample, ParticleFilterFollowsAPoint) {
  const ProgramRun run = run_program(quoted(ANNEAL6D_SAMPLE_03), scratch_);
  ASSERT_EQ(run.status, 0);
  const std::string key = "mean error ";
  const std::size_t place = run.out.find(key);
  ASSERT_NE(place, std::string::npos);
  EXPECT_LT(std::stod(run.out.substr(place + key.size())), 3.0);  // distances are 2 mm off each
}

}  // namespace
}  // namespace anneal6d
