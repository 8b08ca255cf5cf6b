// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/sequence_folder.h"

#include <gtest/gtest.h>

#include <string>

#include "anneal6d/framework/log.h"
#include "file_test_support.h"

namespace anneal6d {
namespace {

using test::expect_file_error;
using test::TemporaryFolder;

class SequenceFolderTest : public testing::Test {
 protected:
  std::vector<std::string> image_names() {
    std::vector<std::string> names;
    for (const auto& path : open_sequence_folder(folder_.path()).images) {
      names.push_back(path.filename().string());
    }
    return names;
  }
  void add(std::initializer_list<const char*> names) {
    for (const char* name : names) folder_.write(name, "");
  }
  TemporaryFolder folder_;
};

using Names = std::vector<std::string>;

TEST_F(SequenceFolderTest, TakesFramesBeforeOtherImages) {
  add({"frame_0001.png", "frame_0000.jpg", "frame_10000.png", "frame_9999.png", "texture.png",
       "frame_12.png", "frame_0002.txt"});
  EXPECT_EQ(image_names(),
            (Names{"frame_0000.jpg", "frame_0001.png", "frame_9999.png", "frame_10000.png"}));
}

TEST_F(SequenceFolderTest, SortsOtherImagesNaturally) {
  add({"image10.png", "image2.PNG", "image1.jpeg", "b.bmp", "a.tiff", "image02b.ppm", "notes.txt",
       ".hidden.png"});
  folder_.write("folder.png/file", "");
  EXPECT_EQ(image_names(),
            (Names{"a.tiff", "b.bmp", "image1.jpeg", "image2.PNG", "image02b.ppm", "image10.png"}));
}

TEST_F(SequenceFolderTest, SortsDifferentSpellingsOfANumberReproducibly) {
  add({"i1b.png", "i001.png", "i01.png", "i1.png", "i01a.png"});
  EXPECT_EQ(image_names(), (Names{"i001.png", "i01.png", "i1.png", "i01a.png", "i1b.png"}));
}

TEST_F(SequenceFolderTest, FindsWhatLiesBesideTheImages) {
  add({"frame_0000.png", "frame_0001.png", "camera.yml", "model.obj"});
  folder_.write("groundtruth.csv", "frame,tx,ty,tz,qw,qx,qy,qz\n1,0,0,500,1,0,0,0\n");
  folder_.write("meta.json", R"({"symmetry": [0, 0, 2]})");
  const SequenceFolder sequence = open_sequence_folder(folder_.path());
  EXPECT_EQ(sequence.camera_file, folder_.path() / "camera.yml");
  EXPECT_EQ(sequence.model_file, folder_.path() / "model.obj");
  EXPECT_EQ(sequence.ground_truth.at(1).translation_mm.z(), 500);
  EXPECT_EQ(sequence.symmetry.axis, Eigen::Vector3d::UnitZ());
}

TEST_F(SequenceFolderTest, NeedsOnlyImages) {
  add({"frame_0000.png"});
  const SequenceFolder sequence = open_sequence_folder(folder_.path());
  EXPECT_FALSE(sequence.camera_file || sequence.model_file);
  EXPECT_TRUE(sequence.ground_truth.empty() && sequence.symmetry.is_none());
}

TEST_F(SequenceFolderTest, WarnsOfGapsInTheNumbers) {
  std::string warning;
  set_log_sink([&](LogLevel, std::string_view message) { warning = message; });
  add({"frame_0001.png", "frame_0002.png"});
  open_sequence_folder(folder_.path());
  EXPECT_EQ(warning, "");
  add({"frame_0005.png"});
  open_sequence_folder(folder_.path());
  set_log_sink({});
  EXPECT_NE(warning.find("gaps"), std::string::npos) << warning;
}

TEST_F(SequenceFolderTest, RejectsWhatIsNoFolderOfImages) {
  const auto missing = folder_.path() / "missing";
  expect_file_error([&] { open_sequence_folder(missing); }, missing, "", "does not exist");
  const auto file = folder_.write("notes.txt", "");
  expect_file_error([&] { open_sequence_folder(file); }, file, "", "is no folder");
  expect_file_error([&] { open_sequence_folder(folder_.path()); }, folder_.path(), "",
                    "holds no image");
}

TEST_F(SequenceFolderTest, RejectsTwoImagesOfOneFrame) {
  add({"frame_0000.png", "frame_0003.png", "frame_0003.jpg"});
  expect_file_error([&] { open_sequence_folder(folder_.path()); }, folder_.path(), "frame 3",
                    "two images");
}

TEST_F(SequenceFolderTest, RejectsGroundTruthOfFramesThatDoNotExist) {
  add({"frame_0001.png"});
  const auto truth =
      folder_.write("groundtruth.csv", "frame,tx,ty,tz,qw,qx,qy,qz\n1,0,0,500,1,0,0,0\n");
  expect_file_error([&] { open_sequence_folder(folder_.path()); }, truth, "frame 1",
                    "1 images are frames 0 to 0");
}

TEST_F(SequenceFolderTest, RejectsMalformedGroundTruthAndMeta) {
  add({"frame_0000.png"});
  const auto meta = folder_.write("meta.json", "{");
  expect_file_error([&] { open_sequence_folder(folder_.path()); }, meta, "byte 2", "JSON");
  const auto truth = folder_.write("groundtruth.csv", "");
  expect_file_error([&] { open_sequence_folder(folder_.path()); }, truth, "line 1", "columns");
}

class SymmetryFile : public testing::Test {
 protected:
  Symmetry load(const std::string& content) {
    return load_symmetry(folder_.write("meta.json", content));
  }
  void expect_error(const std::string& content, const std::string& place,
                    const std::string& words) {
    const auto path = folder_.write("meta.json", content);
    expect_file_error([&] { load_symmetry(path); }, path, place, words);
  }
  TemporaryFolder folder_;
};

TEST_F(SymmetryFile, ReadsNoneInEverySpelling) {
  EXPECT_TRUE(load("{}").is_none());
  EXPECT_TRUE(load(R"({"symmetry": "none", "name": "mug"})").is_none());
  EXPECT_TRUE(load(R"({"symmetry": []})").is_none());
}

TEST_F(SymmetryFile, ReadsAnAxis) {
  const Symmetry symmetry = load(R"({"symmetry": [3, 0, -4.0]})");
  EXPECT_TRUE(symmetry.axis.isApprox(Eigen::Vector3d(0.6, 0, -0.8)));
  EXPECT_TRUE(symmetry.rotations.empty());
}

TEST_F(SymmetryFile, ReadsRotationsAsQuaternionsAndMatrices) {
  const Symmetry symmetry = load(R"({"symmetry": [
    [0, 0, 0, 1],
    [-1, 0, 0, 0, -1, 0, 0, 0, 1],
    [[-1, 0, 0], [0, -1, 0], [0, 0, 1]],
    [1, 0, 0, 0]]})");
  EXPECT_TRUE(symmetry.axis.isZero());
  ASSERT_EQ(symmetry.rotations.size(), 3U) << "without the identity";
  for (const auto& rotation : symmetry.rotations) {
    EXPECT_NEAR(std::abs(rotation.z()), 1, 1e-9);
  }
}

TEST_F(SymmetryFile, RejectsWhatIsNoJsonObject) {
  const auto missing = folder_.path() / "missing.json";
  expect_file_error([&] { load_symmetry(missing); }, missing, "", "does not exist");
  expect_error("", "byte 1", "no valid JSON");
  expect_error("{\"symmetry\": [1, 2", "byte 19", "no valid JSON");
  expect_error("{\"symmetry\": [1e999, 0, 0]}", "", "out of range");
  expect_error("[1, 0, 0]", "", "JSON object");
  expect_error(std::string(100'000, '['), "byte 100001", "no valid JSON");
}

TEST_F(SymmetryFile, RejectsWhatIsNoSymmetry) {
  for (const char* value :
       {"null", "true", "7", "\"round\"", "{}", "[1, 0]", "[0, 0, 0, 1]", "[1, 0, \"z\"]"}) {
    SCOPED_TRACE(value);
    const auto path = folder_.write("meta.json", std::string("{\"symmetry\": ") + value + "}");
    EXPECT_THROW(load_symmetry(path), FileError);
  }
  expect_error(R"({"symmetry": [0, 0, 0]})", "symmetry", "not be zero");
}

TEST_F(SymmetryFile, RejectsWhatIsNoRotation) {
  expect_error(R"({"symmetry": [[0, 0, 0, 1], [0, 0, 0, 2]]})", "symmetry[1]", "unit length");
  expect_error(R"({"symmetry": [[1, 0, 0, 0, 1, 0, 0, 0, -1]]})", "symmetry[0]", "a rotation");
  expect_error(R"({"symmetry": [[2, 0, 0, 0, 1, 0, 0, 0, 1]]})", "symmetry[0]", "a rotation");
  expect_error(R"({"symmetry": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]})", "symmetry[0]", "quaternion");
  expect_error(R"({"symmetry": [[[1, 0, 0], [0, 1, 0]]]})", "symmetry[0]", "quaternion");
  expect_error(R"({"symmetry": [[[0, 0], [0, 1]]]})", "symmetry[0]", "quaternion");
}

}  // namespace
}  // namespace anneal6d
