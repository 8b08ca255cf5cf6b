// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/sequence_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <utility>

#include "anneal6d/capture/sequence_source.h"
#include "anneal6d/capture/simulation_source.h"
#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/mesh_file.h"
#include "capture_test_support.h"
#include "flat_renderer.h"
#include "full_disk.h"

namespace anneal6d {
namespace {

using test::contains;
using test::make_box;
using test::message_of;

SimulationSource short_simulation(int frames = 3) {
  SimulationOptions options;
  options.frames = frames;
  options.background = "clutter";
  return {make_box({80, 50, 30}), CameraModel{160, 120, 160, 161, 79.5, 60.25, {}}, options,
          test::make_flat_renderer};
}

std::size_t entries_of(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

// Hands out one frame, then breaks.
class BreakingSource : public FrameSource {
 public:
  std::optional<Frame> next() override {
    if (broken_) throw CaptureError("broke");
    broken_ = true;
    return Frame{cv::Mat(120, 160, CV_8UC3, cv::Scalar(0)), 0, 0, 0};
  }
  std::string description() const override { return "breaking source"; }
  std::optional<CameraModel> camera() const override {
    return CameraModel{160, 120, 160, 160, 79.5, 59.5, {}};
  }

 private:
  bool broken_ = false;
};

TEST(SequenceWriter, WritesWhatReadsBackTheSame) {
  test::TemporaryFolder folder;
  SimulationSource source = short_simulation();
  SimulationSource again = short_simulation();
  SequenceWriterOptions options;
  options.settings.set("seed", "1");
  std::int64_t last_progress = 0;
  options.progress = [&](std::int64_t count) { last_progress = count; };
  EXPECT_EQ(write_sequence(source, *make_box({80, 50, 30}), folder / "cup", options), 3);
  EXPECT_EQ(last_progress, 3);

  SequenceSource read(folder / "cup");
  EXPECT_DOUBLE_EQ(read.camera()->fy_px, 161);
  EXPECT_DOUBLE_EQ(read.camera()->cy_px, 60.25);
  while (const auto frame = read.next()) {
    EXPECT_EQ(cv::norm(frame->image, again.next()->image, cv::NORM_INF), 0);
    EXPECT_LT((read.ground_truth()->translation_mm - again.ground_truth()->translation_mm).norm(),
              1e-5);
    EXPECT_LT(angle_between(read.ground_truth()->rotation, again.ground_truth()->rotation), 1e-7);
  }
  EXPECT_FALSE(again.next());
  EXPECT_TRUE(contains(read_file(folder / "cup" / "meta.json"), "\"seed\": \"1\""));
  EXPECT_TRUE(read.folder().symmetry.is_none());
  EXPECT_EQ(entries_of(folder.path()), 1U);  // no temporary folder
}

TEST(SequenceWriter, WritesATexturedModelThatLoadsTheSame) {
  cv::Mat texture(8, 16, CV_8UC3);
  cv::randu(texture, 0, 255);
  std::vector<MeshVertex> vertices(4);
  const Eigen::Vector3f positions[] = {{0, 0, 0}, {50.3F, 0, 0}, {50, 60, 0.1F}, {0, 60, 7}};
  const Eigen::Vector2f uvs[] = {{0.1F, 0.2F}, {0.9F, 0.25F}, {0.8F, 0.7F}, {0, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    vertices[i].position_mm = positions[i];
    vertices[i].uv = uvs[i];
    vertices[i].albedo_bgr = {0.5F, 0.75F, 1};
  }
  const TriangleMesh mesh(vertices, {{0, 1, 2}, {0, 2, 3}}, texture);
  test::TemporaryFolder folder;
  SimulationSource source = short_simulation(1);
  write_sequence(source, mesh, folder / "plate");

  const TriangleMesh read = load_mesh(folder / "plate" / "model.obj");
  ASSERT_EQ(read.triangles().size(), 2U);
  EXPECT_EQ(cv::norm(read.texture_levels()[0], texture, cv::NORM_INF), 0);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const MeshVertex& a = mesh.vertices()[mesh.triangles()[i][k]];
      const MeshVertex& b = read.vertices()[read.triangles()[i][k]];
      EXPECT_EQ(a.position_mm, b.position_mm);
      EXPECT_LT((a.normal - b.normal).norm(), 1e-6);
      EXPECT_LT((a.uv - b.uv).norm(), 1e-6);
      EXPECT_LT((a.albedo_bgr - b.albedo_bgr).norm(), 1e-6);
    }
  }
}

TEST(SequenceWriter, ABlackMaterialBesideATextureStaysBlack) {
  std::vector<MeshVertex> vertices(3);
  vertices[1].position_mm = {50, 0, 0};
  vertices[2].position_mm = {0, 50, 0};
  for (MeshVertex& vertex : vertices) vertex.albedo_bgr.setZero();
  const TriangleMesh mesh(vertices, {{0, 1, 2}}, cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(200)));
  test::TemporaryFolder folder;
  SimulationSource source = short_simulation(1);
  write_sequence(source, mesh, folder / "black");
  const TriangleMesh read = load_mesh(folder / "black" / "model.obj");
  for (const MeshVertex& vertex : read.vertices()) EXPECT_LT(vertex.albedo_bgr.norm(), 1e-5);
}

TEST(SequenceWriter, KeepsColoursThatDifferBetweenTrianglesAndWithinThem) {
  for (const bool within : {false, true}) {
    std::vector<MeshVertex> vertices(6);
    for (std::size_t i = 0; i < 6; ++i) {
      vertices[i].position_mm = {i % 3 == 1 ? 40.0F : 0, i % 3 == 2 ? 40.0F : 0, i < 3 ? 0 : 30.0F};
      const float shade = static_cast<float>(within ? i : i / 3) / 8;
      vertices[i].albedo_bgr = {shade, 0.5F, 1 - shade};
    }
    const TriangleMesh mesh(vertices, {{0, 1, 2}, {3, 4, 5}});
    test::TemporaryFolder folder;
    SimulationSource source = short_simulation(1);
    write_sequence(source, mesh, folder / "colours");
    const TriangleMesh read = load_mesh(folder / "colours" / "model.obj");
    ASSERT_EQ(read.triangles().size(), 2U);
    for (const Triangle& triangle : read.triangles()) {
      for (const std::uint32_t corner : triangle) {
        const MeshVertex& vertex = read.vertices()[corner];
        const auto original =
            std::find_if(vertices.begin(), vertices.end(),
                         [&](const MeshVertex& v) { return v.position_mm == vertex.position_mm; });
        ASSERT_NE(original, vertices.end());
        EXPECT_LT((vertex.albedo_bgr - original->albedo_bgr).norm(), 1e-6);
      }
    }
  }
}

TEST(SequenceWriter, WritesJpegImagesIfAsked) {
  test::TemporaryFolder folder;
  SimulationSource source = short_simulation(1);
  SequenceWriterOptions options;
  options.jpeg_quality = 90;
  write_sequence(source, *make_box({80, 50, 30}), folder / "cup", options);
  EXPECT_TRUE(std::filesystem::exists(folder / "cup" / "frame_0000.jpg"));
  options.jpeg_quality = 101;
  EXPECT_THROW(write_sequence(source, *make_box({8, 5, 3}), folder / "other", options),
               ConfigError);
}

TEST(SequenceWriter, LeavesNothingBehindIfTheSourceFails) {
  test::TemporaryFolder folder;
  BreakingSource source;
  EXPECT_THROW(write_sequence(source, *make_box({80, 50, 30}), folder / "cup"), CaptureError);
  EXPECT_EQ(entries_of(folder.path()), 0U);
}

// Hands out noise; the frames named are broken.
class NoiseSource : public BreakingSource {
 public:
  NoiseSource(int frames, std::set<int> broken) : frames_(frames), broken_(std::move(broken)) {}

  std::optional<Frame> next() override {
    if (count_ == frames_) return std::nullopt;
    const int index = count_++;
    if (broken_.contains(index)) throw FileError("noise.png", "", "broken");
    Frame frame{cv::Mat(120, 160, CV_8UC3), index, 0, 0};
    cv::randu(frame.image, 0, 256);
    return frame;
  }

 private:
  int frames_, count_ = 0;
  std::set<int> broken_;
};

TEST(SequenceWriter, ARecordingLeavesOutBrokenFrames) {
  test::TemporaryFolder folder;
  NoiseSource source(5, {0, 2, 3});
  const Recording recording = record_sequence(source, nullptr, folder / "take");
  EXPECT_EQ(recording.frames, 2);
  EXPECT_EQ(recording.broken, 3);
  EXPECT_TRUE(std::filesystem::exists(folder / "take" / "frame_0001.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "take" / "frame_0002.png"));
}

TEST(SequenceWriter, ARecordingKeepsWhatTheDiskHadRoomFor) {
  test::TemporaryFolder folder;
  NoiseSource source(5, {});
  SequenceWriterOptions options;
  std::optional<test::FullDisk> full;
  options.progress = [&](std::int64_t count) {
    if (count == 3) full.emplace(20'000);
  };
  const std::string message =
      message_of<CaptureError>([&] { record_sequence(source, nullptr, folder / "take", options); });
  full.reset();
  EXPECT_TRUE(contains(message, "full")) << message;
  EXPECT_TRUE(contains(message, "kept")) << message;
  SequenceSource kept(folder / "take", source.camera());
  int frames = 0;
  while (kept.next()) ++frames;
  EXPECT_EQ(frames, 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "take" / "frame_0003.png")) << "a half image";
  EXPECT_EQ(entries_of(folder.path()), 1U);
}

TEST(SequenceWriter, WhatCannotBeFinishedIsKeptWhereTheMessageSays) {
  test::TemporaryFolder folder;
  NoiseSource source(3, {});
  SequenceWriterOptions options;
  options.progress = [&](std::int64_t count) {
    if (count != 3) return;
    std::filesystem::create_directory(folder / "take");  // somebody else's, meanwhile
    std::ofstream(folder / "take" / "letter.txt") << "dear";
  };
  const std::string message =
      message_of<FileError>([&] { record_sequence(source, nullptr, folder / "take", options); });
  EXPECT_TRUE(contains(message, "kept here")) << message;
  EXPECT_TRUE(std::filesystem::exists(folder / "take" / "letter.txt"));
  const std::filesystem::path kept = message.substr(0, message.find(':'));
  EXPECT_TRUE(std::filesystem::exists(kept / "frame_0002.png")) << message;
  EXPECT_EQ(entries_of(folder.path()), 2U);
}

// Hands out the same image for ever.
class StillSource : public BreakingSource {
 public:
  explicit StillSource(cv::Mat image) : image_(std::move(image)) {}
  std::optional<Frame> next() override { return Frame{image_, 0, 0, 0}; }

 private:
  cv::Mat image_;
};

TEST(SequenceWriter, AnImageThatCannotBeEncodedIsAnErrorOfItsFile) {
  test::TemporaryFolder folder;
  SequenceWriterOptions options;
  StillSource empty{cv::Mat()};
  EXPECT_TRUE(contains(
      message_of<FileError>([&] { record_sequence(empty, nullptr, folder / "take", options); }),
      "frame_0000.png"));
  StillSource wide{cv::Mat(1, 70000, CV_8UC1, cv::Scalar(0))};
  options.jpeg_quality = 90;  // whose images may have 65,535 columns
  EXPECT_TRUE(contains(
      message_of<FileError>([&] { record_sequence(wide, nullptr, folder / "take", options); }),
      "70000x1"));
  EXPECT_EQ(entries_of(folder.path()), 0U);
}

// Three cameras; the third has more in its pictures from the second set on.
class NoiseSets : public FrameSetSource {
 public:
  std::optional<FrameSet> next() override {
    if (count_ == 4) return std::nullopt;
    FrameSet set;
    for (int camera = 0; camera < 3; ++camera) {
      Frame frame{cv::Mat(120, 160, CV_8UC3, cv::Scalar(0)), count_, 0, 0};
      if (camera == 2 && count_ > 0) cv::randu(frame.image, 0, 256);
      set.frames.push_back(frame);
    }
    ++count_;
    return set;
  }
  std::size_t size() const override { return 3; }
  std::string description() const override { return "noise sets"; }

 private:
  int count_ = 0;
};

TEST(SequenceWriter, ARecordingOfSeveralCamerasKeepsWholeSets) {
  test::TemporaryFolder folder;
  NoiseSets source;
  {
    const test::FullDisk full(20'000);
    EXPECT_THROW(record_sequences(source, folder / "takes"), CaptureError);
  }
  for (const char* camera : {"camera_0", "camera_1", "camera_2"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "takes" / camera / "frame_0000.png")) << camera;
    EXPECT_FALSE(std::filesystem::exists(folder / "takes" / camera / "frame_0001.png")) << camera;
  }
}

TEST(SequenceWriter, WritesWhereALinkLeads) {
  test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "disk");
  std::filesystem::create_directory_symlink(folder / "disk", folder / "take");
  SimulationSource source = short_simulation(1);
  write_sequence(source, *make_box({80, 50, 30}), folder / "take");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "take"));
  EXPECT_TRUE(std::filesystem::exists(folder / "disk" / "frame_0000.png"));
}

TEST(SequenceWriter, ReplacesASequenceOnlyIfForced) {
  test::TemporaryFolder folder;
  const auto write = [&](int frames, bool force) {
    SimulationSource source = short_simulation(frames);
    SequenceWriterOptions options;
    options.force = force;
    write_sequence(source, *make_box({80, 50, 30}), folder / "cup" / "", options);
  };
  std::filesystem::create_directory(folder / "cup");  // empty: no obstacle
  write(3, false);
  EXPECT_TRUE(contains(message_of<FileError>([&] { write(2, false); }), "--force"));
  EXPECT_TRUE(std::filesystem::exists(folder / "cup" / "frame_0002.png"));
  write(2, true);
  EXPECT_FALSE(std::filesystem::exists(folder / "cup" / "frame_0002.png"));
  EXPECT_EQ(entries_of(folder.path()), 1U);
}

TEST(SequenceWriter, NeverReplacesAFolderThatHoldsAnythingElse) {
  test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "home");
  std::ofstream(folder / "home" / "letter.txt") << "dear";
  SimulationSource source = short_simulation(1);
  SequenceWriterOptions options;
  options.force = true;
  const std::string message = message_of<FileError>([&] {
    write_sequence(source, *make_box({80, 50, 30}), folder / "home", options);
  });
  EXPECT_TRUE(contains(message, "letter.txt")) << message;
  EXPECT_TRUE(std::filesystem::exists(folder / "home" / "letter.txt"));
  EXPECT_THROW(write_sequence(source, *make_box({80, 50, 30}), folder / "home" / "letter.txt"),
               FileError);
}

}  // namespace
}  // namespace anneal6d
