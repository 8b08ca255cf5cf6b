// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// The tool on emulated FireWire cameras: libdc1394 is the real one.
#include <cerrno>
#include <csignal>

#include "anneal6d/framework/sequence_folder.h"
#include "tool_runner.h"

namespace anneal6d {
namespace {

class Dc1394Tool : public ToolTest {
 protected:
  // A grey camera that shows the short sequence.
  std::string camera_ = "model=DR2-BW,guid=00b09d01009a1b2c,frames=" + sequence_.string();
  std::string every_ = " --capture every --settle-frames 0";
  std::string object_ = " --model " + quoted((sequence_ / "model.obj").string()) + " --camera " +
                        quoted((sequence_ / "camera.yml").string());

  static std::string environment(const std::string& cameras) {
    return "ANNEAL6D_EMULATED_DC1394=" + anneal6d::quoted(cameras) +
           " LD_PRELOAD=" + quoted(ANNEAL6D_EMULATED_DC1394_LIBRARY) + " ";
  }

  ProgramRun tool_with(const std::string& cameras, const std::string& arguments) const {
    return run_program(environment(cameras) + quoted(ANNEAL6D_TOOL) + " " + arguments, scratch_);
  }

  std::string first_pose() const {
    const auto cells = cells_of(lines_of(sequence_ / "groundtruth.csv").at(1));
    std::string pose;
    for (std::size_t i = 1; i < 8; ++i) pose += (i == 1 ? "" : " ") + cells.at(i);
    return " --init " + anneal6d::quoted(pose);
  }

  // The rows without their times.
  std::vector<std::string> poses(const std::string& file) const {
    std::vector<std::string> rows;
    for (const std::string& line : lines_of(scratch_ / file)) {
      rows.push_back(line.substr(0, line.rfind(',')));
    }
    return rows;
  }
};

TEST_F(Dc1394Tool, TracksACameraAsItTracksTheFolderThatWasRecordedFromIt) {
  const ProgramRun record =
      tool_with(camera_, "record dc1394: out --frames 10 --settle-frames 0" + object_);
  ASSERT_EQ(record.status, 0) << record.err;
  EXPECT_EQ(open_sequence_folder(scratch_ / "out").images.size(), 10U);
  const std::string options = first_pose() + " --frames 10" + fast_;
  const ProgramRun folder = tool("track out --poses folder.csv" + options);
  ASSERT_EQ(folder.status, 0) << folder.err;
  const ProgramRun live =
      tool_with(camera_, "track dc1394: --poses live.csv" + every_ + object_ + options);
  ASSERT_EQ(live.status, 0) << live.err;
  EXPECT_EQ(poses("live.csv").size(), 11U);
  EXPECT_EQ(poses("live.csv"), poses("folder.csv"));
}

TEST_F(Dc1394Tool, TracksOnWhileTheCameraIsUnpluggedAndBack) {
  const ProgramRun run = tool_with(camera_ + ",unplug=4,replug=2",
                                   "track dc1394:00b09d01009a1b2c --poses p.csv" + every_ +
                                       object_ + first_pose() + " --frames 8" + fast_);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("settings restored"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("never arrived"), std::string::npos) << run.err;
  EXPECT_EQ(poses("p.csv").size(), 9U);
}

TEST_F(Dc1394Tool, KeepsWhatWasRecordedBeforeTheCameraFailed) {
  const ProgramRun run =
      tool_with(camera_ + ",dies=5", "record dc1394: out --settle-frames 0 --stall-timeout 0.3");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("00b09d01009a1b2c"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("kept"), std::string::npos) << run.err;
  EXPECT_EQ(open_sequence_folder(scratch_ / "out").images.size(), 5U);
}

TEST_F(Dc1394Tool, RecordsSeveralCamerasSideBySide) {
  const ProgramRun run = tool_with(camera_ + ";model=DR2-BW,guid=b",
                                   "record dc1394:00b09d01009a1b2c,b out --frames 6 --fps 30");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(open_sequence_folder(scratch_ / "out/camera_0").images.size(), 6U);
  EXPECT_EQ(open_sequence_folder(scratch_ / "out/camera_1").images.size(), 6U);
}

TEST_F(Dc1394Tool, AnInterruptEndsARecordingAndKeepsIt) {
  // The shell sends the tool the signal that Ctrl-C is.
  const std::string line = environment(camera_ + ",pace=real") + quoted(ANNEAL6D_TOOL) +
                           " record dc1394: out & tool=$!; "
                           "until grep -q 'fps' log; do sleep 0.1; done; sleep 1; "
                           "kill -INT $tool; wait $tool";
  const ProgramRun run =
      run_program("{ sh -c " + std::string("'trap - INT; ") + line + "' 2>log; }", scratch_);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_GT(open_sequence_folder(scratch_ / "out").images.size(), 1U);
}

TEST_F(Dc1394Tool, SampleTracksUntilItIsInterrupted) {
  const auto cells = cells_of(lines_of(sequence_ / "groundtruth.csv").at(1));
  std::string pose;
  for (std::size_t i = 1; i < 8; ++i) pose += cells.at(i) + " ";
  // Unbuffered, to be seen at once; given the signal that Ctrl-C is.
  const std::string line = "DISPLAY= WAYLAND_DISPLAY= " + environment(camera_) + "stdbuf -o0 " +
                           anneal6d::quoted(ANNEAL6D_TRACK_DRAGONFLY2) + " " +
                           anneal6d::quoted((sequence_ / "model.obj").string()) + " " +
                           anneal6d::quoted((sequence_ / "camera.yml").string()) + " " +
                           anneal6d::quoted(pose) +
                           " 00b09d01009a1b2c capture=every gain=300 >log & sample=$!; "
                           "until grep -q \"frame      3\" log || ! kill -0 $sample; "
                           "do sleep 0.1; done; kill -INT $sample; wait $sample; "
                           "status=$?; cat log; exit $status";
  const ProgramRun run = run_program("sh -c '" + line + "'", scratch_);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("frame      3  lost 0"), std::string::npos) << run.out;
}

TEST_F(Dc1394Tool, ListShowsCamerasAndWhySomeCantBeUsed) {
  const ProgramRun run = tool_with(camera_, "list");
  for (const char* word : {"dc1394:00b09d01009a1b2c", "Dragonfly2 DR2-BW", "640x480-mono8 at",
                           "format7-0 up to 648x488", "--gain", "24 dB"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
  }
  const ProgramRun denied = tool_with(camera_ + ",open-error=" + std::to_string(EACCES), "list");
  EXPECT_NE(denied.out.find("60-anneal6d-firewire.rules"), std::string::npos) << denied.out;
}

TEST_F(Dc1394Tool, SettingsComeFromAConfigurationFileAndAreNamedWithIt) {
  write("camera.toml", "gain = \"5000\"\nroi = \"0,0,320,240\"\n");
  const ProgramRun run = tool_with(camera_, "record dc1394: out --frames 2 --config camera.toml");
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("camera.toml: gain: '5000'"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("192..820"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace anneal6d
