// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/pose_file.h"
#include "tool_runner.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

class Evaluate : public ToolTest {
 protected:
  nlohmann::json summary(const std::string& folder) const {
    return nlohmann::json::parse(std::ifstream(scratch_ / folder / "summary.json"));
  }

  /// The sequence with a ground truth in which the object lies `shift_mm` aside from frame 2 on.
  void make_sequence_with_wrong_truth(double shift_mm) const {
    const fs::path copy = copy_of_sequence();
    auto truth = load_poses(copy / "groundtruth.csv");
    for (auto& [frame, pose] : truth) {
      if (frame >= 2) pose.translation_mm.x() += shift_mm;
    }
    save_poses(truth, copy / "groundtruth.csv");
  }
};

TEST_F(Evaluate, ReportsErrorsAndWritesResults) {
  const ProgramRun run =
      tool("evaluate " + sequence_argument_ + fast_ + " --seed 5 --frames 8 --out results");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("sequence_short"), std::string::npos) << run.out;
  EXPECT_TRUE(only_has({"results"}));
  EXPECT_EQ(lines_of(scratch_ / "results/sequence_short/poses.csv").size(), 9U);

  const nlohmann::json entry = summary("results").at("sequences").at(0);
  EXPECT_EQ(entry.at("name"), "sequence_short");
  EXPECT_EQ(entry.at("frames"), 7) << "the first frame's pose is given, so it is not judged";
  EXPECT_EQ(entry.at("seed"), "5");
  EXPECT_EQ(entry.at("options").at("particles"), "60");
  EXPECT_EQ(entry.at("options").at("protocol"), "free");
  EXPECT_EQ(entry.at("restarts"), 0);
  EXPECT_GE(entry.at("success_50mm_5deg").get<double>(), 0.9);
  EXPECT_GT(entry.at("milliseconds").at("median").get<double>(), 0);
  for (const char* axis : {"x", "y", "z"}) {
    EXPECT_LT(entry.at("translation_error_mm").at(axis).at("mean").get<double>(), 20) << axis;
  }
  EXPECT_EQ(summary("results").at("mean").at("frames"), 7);
}

TEST_F(Evaluate, WritesAReportThatStandsAlone) {
  fs::copy(sequence_, scratch_ / "cup & co", fs::copy_options::recursive);
  const ProgramRun run = tool("evaluate \"cup & co\" --frames 6 --out results" + fast_);
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string page = read_file(scratch_ / "results/report.html");
  EXPECT_NE(page.find("cup &amp; co"), std::string::npos);
  EXPECT_NE(page.find("particles&nbsp;<b>60</b>"), std::string::npos);
  EXPECT_NE(page.find("Reliability"), std::string::npos);
  EXPECT_NE(page.find("</html>"), std::string::npos);
  if (page.find("No pictures") != std::string::npos) GTEST_SKIP() << "no OpenGL here";
  EXPECT_NE(page.find("src=\"data:image/jpeg;base64,/9j/"), std::string::npos);
  EXPECT_NE(page.find("last: frame 5,"), std::string::npos);
}

TEST_F(Evaluate, KeepsTheFilesIndexWithAStride) {
  const ProgramRun run =
      tool("evaluate " + sequence_argument_ + fast_ + " --stride 2 --frames 3 --out results");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto lines = lines_of(scratch_ / "results/sequence_short/poses.csv");
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(cells_of(lines[3])[0], "4");
}

TEST_F(Evaluate, RestartsAfterAFailedFrameInTheRbotProtocolOnly) {
  // At frame 2 the truth says that the object jumped 60 mm; its picture did not.
  make_sequence_with_wrong_truth(60);
  const std::string base = "evaluate sequence --frames 4 --out ";
  ASSERT_EQ(tool(base + "free" + fast_).status, 0);
  ASSERT_EQ(tool(base + "rbot --protocol rbot" + fast_).status, 0);
  EXPECT_EQ(summary("free").at("sequences").at(0).at("restarts"), 0);
  EXPECT_GE(summary("rbot").at("sequences").at(0).at("restarts"), 1);

  const auto failed = cells_of(lines_of(scratch_ / "rbot/sequence/poses.csv")[3]);
  EXPECT_EQ(failed[0], "2");
  EXPECT_EQ(failed[10], "0") << "the row keeps the failed estimate";
  const double truth_x = load_poses(scratch_ / "sequence/groundtruth.csv").at(2).translation_mm.x();
  EXPECT_GT(std::abs(std::stod(failed[1]) - truth_x), 30);

  // Up to there both runs are the same; the reset shows in the next frame.
  const auto x_of = [&](const char* folder, std::size_t line) {
    return cells_of(lines_of(scratch_ / folder / "sequence/poses.csv")[line])[1];
  };
  EXPECT_EQ(x_of("rbot", 3), x_of("free", 3));
  EXPECT_NE(x_of("rbot", 4), x_of("free", 4));
}

TEST_F(Evaluate, WritesPosesAndOverlayOfOneSequenceAsTrackDoes) {
  if (const std::string why = why_no_opengl(); !why.empty()) GTEST_SKIP() << why;
  const ProgramRun run = tool("evaluate " + sequence_argument_ +
                              " --frames 3 --poses p.csv --overlay pictures --out results" + fast_);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(lines_of(scratch_ / "p.csv"), lines_of(scratch_ / "results/sequence_short/poses.csv"));
  EXPECT_TRUE(fs::exists(scratch_ / "pictures/overlay_0002.png"));
  fs::copy(sequence_, scratch_ / "a", fs::copy_options::recursive);
  expect_refused("evaluate a " + sequence_argument_ + " --poses q.csv", 2, {"--poses"});
}

TEST_F(Evaluate, FindsOutWhatIsMissingBeforeItTracks) {
  fs::copy(sequence_, scratch_ / "a", fs::copy_options::recursive);
  fs::copy(sequence_, scratch_ / "b", fs::copy_options::recursive);
  const auto refused = [&](const std::string& options, const std::vector<std::string>& words) {
    // The first sequence would be evaluated before the second is looked at.
    expect_refused("evaluate a b --particles 100000 --layers 100 --mode thesis" + options, 2,
                   words);
  };
  fs::rename(scratch_ / "b/camera.yml", scratch_ / "camera.yml");
  refused("", {"b has no camera.yml", "--camera"});
  fs::rename(scratch_ / "camera.yml", scratch_ / "b/camera.yml");
  fs::rename(scratch_ / "b/model.obj", scratch_ / "model.obj");
  refused("", {"b has no model.obj", "--model"});
  fs::rename(scratch_ / "model.obj", scratch_ / "b/model.obj");
  auto truth = load_poses(scratch_ / "b/groundtruth.csv");
  truth.erase(0);
  save_poses(truth, scratch_ / "b/groundtruth.csv");
  refused("", {"b: the pose", "frame 0", "--init"});
  refused(" --start 19", {"no frame after the first", "--start"});
  refused(" --start 20", {"no frame after --start"});
}

#ifdef __linux__
TEST_F(Evaluate, ReportsASequenceWhoseNameIsNotUtf8) {
  const std::string name = "caf\xe9";
  fs::copy(sequence_, scratch_ / name, fs::copy_options::recursive);
  const ProgramRun run = tool("evaluate " + quoted(name) + " --frames 2 --out results" + fast_);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(summary("results").at("sequences").at(0).at("frames"), 1);
}

TEST_F(Evaluate, FailsIfItsTableCannotBeWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const ProgramRun run =
      run_program("{ " + quoted(ANNEAL6D_TOOL) + " evaluate " + sequence_argument_ + " --frames 2" +
                      fast_ + " >/dev/full; }",
                  scratch_);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("standard output"), std::string::npos) << run.err;
}
#endif

TEST_F(Evaluate, JudgesAgainstAnotherPoseFile) {
  const fs::path copy = copy_of_sequence();
  fs::rename(copy / "groundtruth.csv", scratch_ / "reference.csv");
  write("sequence/groundtruth.csv", "frame,tx,ty,tz,qw,qx,qy,qz\n");
  const std::string base = "evaluate sequence --frames 4" + fast_;
  expect_refused(base, 2, {"frame 0", "--init"});
  const ProgramRun run = tool(base + " --reference reference.csv --out results");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(summary("results").at("sequences").at(0).at("frames"), 3);
}

TEST_F(Evaluate, DoesNotCountFramesWithoutGroundTruth) {
  const fs::path copy = copy_of_sequence();
  auto truth = load_poses(copy / "groundtruth.csv");
  truth.erase(1);
  save_poses(truth, copy / "groundtruth.csv");
  ASSERT_EQ(tool("evaluate sequence --frames 4 --out results" + fast_).status, 0);
  EXPECT_EQ(summary("results").at("sequences").at(0).at("frames"), 2);
  EXPECT_EQ(lines_of(scratch_ / "results/sequence/poses.csv").size(), 5U);
}

TEST_F(Evaluate, TracksSeveralSequencesAtTheSameTimeWithTheSameResult) {
  fs::copy(sequence_, scratch_ / "a", fs::copy_options::recursive);
  fs::copy(sequence_, scratch_ / "b", fs::copy_options::recursive);
  ASSERT_EQ(tool("evaluate a b --frames 3 --jobs 2 --out two" + fast_).status, 0);
  ASSERT_EQ(tool("evaluate a b --frames 3 --out one" + fast_).status, 0);
  const auto two = summary("two"), one = summary("one");
  ASSERT_EQ(two.at("sequences").size(), 2U);
  EXPECT_EQ(two.at("sequences").at(1).at("name"), "b");
  EXPECT_EQ(two.at("mean").at("translation_error_mm"), one.at("mean").at("translation_error_mm"));
}

TEST_F(Evaluate, WritesNothingIfOneSequenceFails) {
  fs::copy(sequence_, scratch_ / "a", fs::copy_options::recursive);
  fs::copy(sequence_, scratch_ / "b", fs::copy_options::recursive);
  write("b/model.obj", "");
  expect_refused("evaluate a b --frames 3 --out results" + fast_, 1, {"b/model.obj"});
  EXPECT_TRUE(only_has({"a", "b"}));
}

TEST_F(Evaluate, RefusesTwoSequencesOfOneName) {
  fs::create_directories(scratch_ / "x");
  fs::copy(sequence_, scratch_ / "x" / "sequence_short", fs::copy_options::recursive);
  expect_refused("evaluate " + sequence_argument_ + " x/sequence_short/ --out results", 2,
                 {"name"});
}

TEST_F(Evaluate, RefusesAFolderThatIsAFile) {
  write("results", "mine");
  expect_refused("evaluate " + sequence_argument_ + " --frames 2 --out results", 1, {"results"});
  EXPECT_EQ(lines_of(scratch_ / "results"), std::vector<std::string>{"mine"});
}

}  // namespace
}  // namespace anneal6d
