// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <opencv2/imgcodecs.hpp>

#include "anneal6d/framework/atomic_file.h"
#include "tool_runner.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

/// Damages one file of a copied sequence and expects `track` to say so.
class BadInput : public ToolTest {
 protected:
  void SetUp() override { copy_of_sequence(); }

  /// Message, exit status 1, and no file but the sequence.
  void expect_failure(const std::string& options, const std::vector<std::string>& words) const {
    expect_refused("track sequence --frames 3 --poses p.csv" + fast_ + " " + options, 1, words);
    EXPECT_TRUE(only_has({"sequence"}));
  }

  void expect_damage_is_named(const std::string& file) {
    const fs::path path = scratch_ / "sequence" / file;
    const std::string whole = read_file(path);
    fs::remove(path);
    fs::create_directory(path);
    expect_failure("", {file});
    fs::remove(path);
    write(path, "");
    expect_failure("", {file});
    write(path, std::string(200, '\xC3'));
    expect_failure("", {file});
    write(path, whole);
  }
};

TEST_F(BadInput, ModelIsNamed) { expect_damage_is_named("model.obj"); }
TEST_F(BadInput, CameraIsNamed) { expect_damage_is_named("camera.yml"); }
TEST_F(BadInput, GroundTruthIsNamed) { expect_damage_is_named("groundtruth.csv"); }

TEST_F(BadInput, FirstImageIsNamed) {
  for (const std::string& content : {std::string(), std::string(200, '\xC3')}) {
    write("sequence/frame_0000.jpg", content);
    expect_failure("", {"frame_0000.jpg"});
  }
}

TEST_F(BadInput, TruncatedFilesAreNamed) {
  for (const char* file : {"camera.yml", "frame_0000.jpg"}) {
    const fs::path path = scratch_ / "sequence" / file;
    const std::string whole = read_file(path);
    write(path, whole.substr(0, whole.size() / 3));
    expect_failure("", {file});
    write(path, whole);
  }
}

TEST_F(BadInput, MissingInputsSayWhatToDo) {
  expect_refused("track nowhere", 1, {"nowhere"});
  expect_failure("--model nowhere.obj", {"nowhere.obj"});
  expect_failure("--camera nowhere.yml", {"nowhere.yml"});
  expect_failure("--plugin nowhere.so", {"nowhere.so"});
  fs::remove(scratch_ / "sequence/groundtruth.csv");
  expect_refused("track sequence --poses p.csv", 2, {"--init"});
  fs::remove(scratch_ / "sequence/model.obj");
  expect_refused("track sequence --poses p.csv", 2, {"--model"});
  fs::remove(scratch_ / "sequence/camera.yml");
  expect_refused("track sequence --poses p.csv", 2, {"--camera"});
  EXPECT_TRUE(only_has({"sequence"}));
}

TEST_F(BadInput, AFolderWithoutImagesIsNamed) {
  fs::create_directory(scratch_ / "empty");
  expect_refused("track empty", 1, {"empty"});
}

TEST_F(BadInput, AFileThatIsNoVideoIsNamed) {
  write("notes.mp4", "not a video");
  expect_refused("track notes.mp4", 1, {"notes.mp4"});
}

TEST_F(BadInput, AMissingCameraIsNamed) {
  expect_refused(
      "track camera:63 --init \"0 0 600 1 0 0 0\" --model sequence/model.obj --camera "
      "sequence/camera.yml",
      1, {"63"});
  expect_refused("track camera:front --model sequence/model.obj", 2, {"front"});
}

TEST_F(BadInput, ImagesOfAnotherSizeThanTheCalibrationAreNamed) {
  const fs::path first = scratch_ / "sequence/frame_0000.jpg";
  cv::imwrite(first.string(), cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(0)));
  expect_failure("", {"frame_0000.jpg", "320x240", "640x480"});
}

TEST_F(BadInput, ModelsOfAbsurdSizeHintAtTheUnit) {
  expect_failure("--model-unit m", {"model.obj", "unit"});
}

TEST_F(BadInput, BadInitialPosesAreRefused) {
  const auto refused = [&](const std::string& pose) {
    expect_refused("track sequence --poses p.csv --init \"" + pose + "\"", 2, {"--init"});
  };
  refused("nan 0 600 1 0 0 0");
  refused("0 0 inf 1 0 0 0");
  refused("0 0 600 1 0 0");
  refused("0 0 600 1 0 0 0 0");
  refused("0 0 600 0 0 0 0");
  refused("0 0 -600 1 0 0 0");
  refused("here");
  EXPECT_TRUE(only_has({"sequence"}));
}

TEST_F(BadInput, GroundTruthBehindTheCameraIsNamed) {
  write("sequence/groundtruth.csv", "frame,tx,ty,tz,qw,qx,qy,qz\n0,0,0,-600,1,0,0,0\n");
  expect_failure("", {"ground truth of frame 0", "behind the camera"});
}

TEST_F(BadInput, OutputsThatCannotBeWrittenAreNamed) {
  write("occupied", "");
  const auto refused = [&](const std::string& option, const std::string& word) {
    expect_refused("track sequence --frames 2" + fast_ + " " + option, 1, {word});
  };
  refused("--poses nowhere/p.csv", "p.csv");
  refused("--poses p.csv --edge-pictures occupied", "occupied");
  refused("--poses p.csv --overlay nowhere/deep/video.mp4", "video.mp4");
  EXPECT_TRUE(only_has({"occupied", "sequence"}));
}

TEST_F(BadInput, AStartBehindTheEndIsRefused) {
  expect_refused("track sequence --start 999 --poses p.csv", 2, {"--start"});
  EXPECT_TRUE(only_has({"sequence"}));
}

TEST_F(BadInput, ALibraryThatIsNoPluginIsNamed) {
  write("plugin.so", "no library");
  expect_refused("track sequence --plugin plugin.so", 1, {"plugin.so"});
}

}  // namespace
}  // namespace anneal6d
