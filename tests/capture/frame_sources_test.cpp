// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/frame_sources.h"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "anneal6d/capture/dc1394.h"
#include "capture_test_support.h"
#include "flat_renderer.h"

namespace anneal6d {
namespace {

using test::contains;
using test::message_of;

FrameSourceSetup setup_for(const std::string& input) {
  FrameSourceSetup setup;
  setup.input = input;
  setup.mesh = test::make_box({80, 80, 80});
  setup.make_renderer = test::make_flat_renderer;
  return setup;
}

std::unique_ptr<FrameSource> open(const std::string& input) {
  return open_frame_source(frame_source_plugins(), setup_for(input));
}

TEST(FrameSourcePlugins, HaveTheRowsThatTheToolPromises) {
  std::vector<std::string> names;
  for (const auto& row : frame_source_plugins()) names.push_back(row.name);
  EXPECT_EQ(names, (std::vector<std::string>{"sequence", "video", "camera", "dc1394", "simulate"}));
}

TEST(OpenFrameSource, TakesAFolderForASequence) {
  test::TemporaryFolder folder;
  cv::imwrite((folder / "frame_0000.png").string(), cv::Mat(48, 64, CV_8UC1, cv::Scalar(0)));
  EXPECT_TRUE(contains(open(folder.path().string())->description(), "sequence"));
}

TEST(OpenFrameSource, TakesAFileForAVideo) {
  test::TemporaryFolder folder;
  std::ofstream(folder / "notes.txt") << "a text, to be taken for a film";
  EXPECT_TRUE(contains(message_of<FileError>([&] { open((folder / "notes.txt").string()); }),
                       "not a video"));
}

TEST(OpenFrameSource, PassesSettingsOnToTheSimulation) {
  FrameSourceSetup setup = setup_for("simulate:");
  setup.settings.set("frames", "2");
  const auto source = open_frame_source(frame_source_plugins(), setup);
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(source->ground_truth());
  EXPECT_TRUE(source->next());
  EXPECT_FALSE(source->next());
}

TEST(OpenFrameSource, AsksForTheModelToSimulate) {
  FrameSourceSetup setup = setup_for("simulate:");
  setup.mesh = nullptr;
  EXPECT_TRUE(
      contains(message_of<ConfigError>([&] { open_frame_source(frame_source_plugins(), setup); }),
               "--model"));
}

TEST(OpenFrameSource, TellsEndBrokenFileAndMissingCameraApart) {
  test::TemporaryFolder folder;
  cv::imwrite((folder / "frame_0000.png").string(), cv::Mat(48, 64, CV_8UC1, cv::Scalar(0)));
  std::filesystem::copy_file(folder / "frame_0000.png", folder / "frame_0001.png");
  std::filesystem::resize_file(folder / "frame_0000.png", 60);
  const auto source = open(folder.path().string());
  EXPECT_TRUE(contains(message_of<FileError>([&] { source->next(); }), "frame_0000.png"));
  EXPECT_TRUE(source->next());
  EXPECT_FALSE(source->next());
  EXPECT_TRUE(contains(message_of<BackendUnavailable>([] { open("camera:9998"); }), "9998"));
}

TEST(OpenFrameSource, RefusesWhatNamesNoCamera) {
  EXPECT_TRUE(contains(message_of<ConfigError>([] { open("camera:front"); }), "camera:N"));
  EXPECT_THROW(open("camera:-1"), ConfigError);
}

TEST(OpenFrameSource, SaysWhyAFireWireCameraCantBeOpened) {
  const std::string message =
      message_of<BackendUnavailable>([] { open("dc1394:fedcba9876543210"); });
  const std::string reason = why_dc1394_is_unavailable();
  EXPECT_TRUE(contains(message, reason.empty() ? "fedcba9876543210" : reason)) << message;
}

TEST(OpenFrameSource, ListsWhatExistsForAnUnknownName) {
  const std::string message = message_of<ConfigError>([] { open("kinect:0"); });
  EXPECT_TRUE(contains(message, "kinect") && contains(message, "simulate")) << message;
}

TEST(OpenFrameSource, SaysWhatAnInputMayBeIfThereIsNoSuchFile) {
  const std::string message = message_of<FileError>([] { open("/no/such/film.mp4"); });
  EXPECT_TRUE(contains(message, "/no/such/film.mp4") && contains(message, "camera:N")) << message;
  EXPECT_THROW(open("C:\\film.mp4"), FileError);
  EXPECT_THROW(open(""), FileError);
}

}  // namespace
}  // namespace anneal6d
