// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "anneal6d/framework/pose_file.h"
#include "tool_runner.h"

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>
#endif

namespace anneal6d {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

constexpr const char* kHeader = "frame,tx,ty,tz,qw,qx,qy,qz,quality,status,reset,milliseconds";

class Track : public ToolTest {
 protected:
  /// The rows of the file without the milliseconds.
  static std::vector<std::string> untimed(const std::vector<std::string>& lines) {
    std::vector<std::string> rows;
    for (const std::string& line : lines) rows.push_back(line.substr(0, line.rfind(',')));
    return rows;
  }

  std::vector<std::string> frames_of(const fs::path& poses) const {
    std::vector<std::string> frames;
    for (const std::string& line : lines_of(scratch_ / poses)) frames.push_back(cells_of(line)[0]);
    return frames;
  }
};

TEST_F(Track, FollowsTheShortSequence) {
  const ProgramRun run = tool("track " + sequence_argument_ + " --poses poses.csv");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "");
  const auto truth = load_poses(sequence_ / "groundtruth.csv");
  const auto poses = load_poses(scratch_ / "poses.csv");
  ASSERT_EQ(poses.size(), truth.size());
  for (const auto& [frame, pose] : poses) {
    EXPECT_LT((pose.translation_mm - truth.at(frame).translation_mm).norm(), 25) << frame;
    EXPECT_LT(angle_between(pose.rotation, truth.at(frame).rotation), 0.09) << frame;
  }
}

TEST_F(Track, WritesTheColumnsOfTheContract) {
  ASSERT_EQ(tool("track " + sequence_argument_ + fast_ + " --frames 4 --poses poses.csv").status,
            0);
  const auto lines = lines_of(scratch_ / "poses.csv");
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0], kHeader);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto cells = cells_of(lines[i]);
    ASSERT_EQ(cells.size(), 12U) << lines[i];
    EXPECT_EQ(cells[0], std::to_string(i - 1));
    EXPECT_TRUE(cells[9] == "tracking" || cells[9] == "lost") << cells[9];
    EXPECT_EQ(cells[10], i == 1 ? "1" : "0") << "only the first pose was given";
  }
}

TEST_F(Track, PrintsPosesWithoutAFileForThem) {
  const ProgramRun run = tool("track " + sequence_argument_ + fast_ + " --frames 2");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out.rfind(std::string(kHeader) + "\n0,", 0), 0U) << run.out;
  EXPECT_TRUE(only_has({}));
}

TEST_F(Track, GivesTheSamePosesForTheSameSeedOnAnyNumberOfThreads) {
  const std::string base = "track " + sequence_argument_ + fast_ + " --frames 6 --seed 3";
  ASSERT_EQ(tool(base + " --threads 1 --poses one.csv").status, 0);
  ASSERT_EQ(tool(base + " --threads 2 --poses two.csv").status, 0);
  ASSERT_EQ(tool(base + " --threads 2 --poses again.csv").status, 0);
  const auto one = untimed(lines_of(scratch_ / "one.csv"));
  EXPECT_EQ(one, untimed(lines_of(scratch_ / "two.csv")));
  EXPECT_EQ(one, untimed(lines_of(scratch_ / "again.csv")));
}

TEST_F(Track, GivesOtherPosesForAnotherSeed) {
  const std::string base = "track " + sequence_argument_ + fast_ + " --mode thesis --frames 3";
  ASSERT_EQ(tool(base + " --seed 3 --poses three.csv").status, 0);
  ASSERT_EQ(tool(base + " --seed 4 --poses four.csv").status, 0);
  EXPECT_NE(untimed(lines_of(scratch_ / "three.csv")), untimed(lines_of(scratch_ / "four.csv")));
}

TEST_F(Track, NumbersFramesByTheirFilesAlsoWithAStride) {
  const ProgramRun run = tool("track " + sequence_argument_ + fast_ +
                              " --start 2 --stride 3 --frames 3 --poses p.csv");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(frames_of("p.csv"), ElementsAre("frame", "2", "5", "8"));
}

TEST_F(Track, StartsAtTheGivenPose) {
  const ProgramRun run = tool("track " + sequence_argument_ + fast_ +
                              " --frames 1 --init \"-12.5 3 600 1 0 0 0\" --poses p.csv");
  ASSERT_EQ(run.status, 0) << run.err;
  const Pose first = load_poses(scratch_ / "p.csv").at(0);
  EXPECT_TRUE(first.translation_mm.isApprox(Eigen::Vector3d(-12.5, 3, 600)))
      << first.translation_mm;
}

TEST_F(Track, RunsInThesisModeWithEveryEdgeOperator) {
  for (const char* edges : {"sobel", "prewitt", "canny"}) {
    const ProgramRun run =
        tool("track " + sequence_argument_ + fast_ + " --mode thesis --frames 3 --poses " +
             std::string(edges) + ".csv --textured off --edge-threshold auto --edges " + edges);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(lines_of(scratch_ / (std::string(edges) + ".csv")).size(), 4U);
  }
}

TEST_F(Track, LeavesAGapForABrokenFrameInTheMiddle) {
  const fs::path copy = copy_of_sequence();
  const fs::path broken = copy / "frame_0002.jpg";
  ASSERT_TRUE(fs::exists(broken));
  fs::resize_file(broken, 0);
  const ProgramRun run = tool("track sequence --frames 5 --poses p.csv" + fast_);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(frames_of("p.csv"), ElementsAre("frame", "0", "1", "3", "4"));
  EXPECT_NE(run.err.find("frame_0002.jpg"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("1 broken"), std::string::npos) << run.err;
}

TEST_F(Track, RunsToTheEndWhenTheObjectLeavesTheImage) {
  const fs::path copy = copy_of_sequence();
  const cv::Mat empty(cv::imread((copy / "frame_0000.jpg").string()).size(), CV_8UC3,
                      cv::Scalar::all(90));
  for (int frame = 3; frame < 8; ++frame) {
    cv::imwrite((copy / ("frame_000" + std::to_string(frame) + ".jpg")).string(), empty);
  }
  const ProgramRun run = tool("track sequence --frames 8 --poses p.csv" + fast_);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto lines = lines_of(scratch_ / "p.csv");
  ASSERT_EQ(lines.size(), 9U);
  EXPECT_EQ(cells_of(lines.back())[9], "lost") << lines.back();
}

TEST_F(Track, WritesOverlayAndEdgePictures) {
  if (const std::string why = why_no_opengl(); !why.empty()) GTEST_SKIP() << why;
  const ProgramRun run = tool("track " + sequence_argument_ + fast_ +
                              " --frames 3 --poses p.csv --overlay pictures --edge-pictures edges");
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* file : {"pictures/overlay_0002.png", "edges/edges_0000.png",
                           "edges/rendered_0001.png", "edges/matched_0002.png"}) {
    const cv::Mat picture = cv::imread((scratch_ / file).string());
    EXPECT_EQ(picture.size(), cv::Size(640, 480)) << file;
    EXPECT_GT(cv::sum(picture)[0], 0) << file;
  }
}

TEST_F(Track, WritesAnOverlayVideoThatTheToolReadsAgain) {
  if (const std::string why = why_no_opengl(); !why.empty()) GTEST_SKIP() << why;
  const ProgramRun run =
      tool("track " + sequence_argument_ + fast_ + " --frames 3 --poses p.csv --overlay video.mp4");
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string folder = sequence_.string();
  const ProgramRun again =
      tool("track video.mp4 --poses again.csv --model " + quoted(folder + "/model.obj") +
           " --camera " + quoted(folder + "/camera.yml") + " --init \"0 0 600 1 0 0 0\"" + fast_);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(lines_of(scratch_ / "again.csv").size(), 4U);
}

TEST_F(Track, TracksASimulationWithoutFiles) {
  if (const std::string why = why_no_opengl(); !why.empty()) GTEST_SKIP() << why;
  const ProgramRun run =
      tool("track simulate: --frames 3 --poses p.csv --model " +
           quoted((sequence_ / "model.obj").string()) + " --motion manipulation" + fast_);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(lines_of(scratch_ / "p.csv").size(), 4U);
}

TEST_F(Track, KeepsThePosesIfPicturesCannotBeWritten) {
  if (const std::string why = why_no_opengl(); !why.empty()) GTEST_SKIP() << why;
  fs::create_directories(scratch_ / "pictures/overlay_0002.png/in the way");
  const ProgramRun run =
      tool("track " + sequence_argument_ + fast_ + " --frames 4 --poses p.csv --overlay pictures");
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(run.err.find("overlay_0002.png"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("kept"), std::string::npos) << run.err;
  EXPECT_THAT(frames_of("p.csv"), ElementsAre("frame", "0", "1", "2"));
}

#ifndef _WIN32
TEST_F(Track, KeepsThePosesSoFarWhenInterrupted) {
  const std::string poses = (scratch_ / "p.csv").string();
  const std::string errors = (scratch_ / "err.txt").string();
  const pid_t child = fork();
  if (child == 0) {
    std::freopen(errors.c_str(), "w", stderr);
    // Seconds of work: it must not be done before the signal comes.
    execl(ANNEAL6D_TOOL, "anneal6d", "track", sequence_.c_str(), "--mode", "thesis", "--particles",
          "2000", "--layers", "10", "--poses", poses.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  ASSERT_GT(child, 0) << "no process could be made";
  // The poses' temporary file tells that tracking begins.
  const auto begun = [&] {
    return std::any_of(fs::directory_iterator(scratch_), {}, [](const fs::directory_entry& entry) {
      return entry.path().extension() == ".part";
    });
  };
  for (int i = 0; i < 600 && !begun(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  kill(child, SIGINT);
  int result = 0;
  ASSERT_EQ(waitpid(child, &result, 0), child);
  const std::string err = ::testing::PrintToString(lines_of(errors));
  ASSERT_TRUE(WIFEXITED(result)) << err;
  EXPECT_EQ(WEXITSTATUS(result), 0) << err;
  EXPECT_NE(err.find("interrupted"), std::string::npos) << err;
  const std::size_t lines = lines_of(poses).size();
  EXPECT_GE(lines, 2U);  // header and first frame
  EXPECT_LT(lines, 21U) << "it ended before the signal came";
}
#endif

}  // namespace
}  // namespace anneal6d
