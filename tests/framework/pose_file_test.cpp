// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/pose_file.h"

#include <gtest/gtest.h>

#include <string>

#include "file_test_support.h"

namespace anneal6d {
namespace {

using test::content_of;
using test::expect_file_error;
using test::TemporaryFolder;

const std::string kHeader = "frame,tx,ty,tz,qw,qx,qy,qz\n";

Pose tilted_pose() {
  Pose pose;
  pose.translation_mm = {1.25, -2.5, 600.125};
  pose.rotation = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  return pose;
}

class PoseFile : public testing::Test {
 protected:
  std::map<std::int64_t, Pose> load(const std::string& content) {
    return load_poses(folder_.write("poses.csv", content));
  }
  void expect_error(const std::string& content, const std::string& place,
                    const std::string& words) {
    const auto path = folder_.write("poses.csv", content);
    expect_file_error([&] { load_poses(path); }, path, place, words);
  }
  TemporaryFolder folder_;
};

TEST_F(PoseFile, ReadsPosesByFrame) {
  const auto poses = load(kHeader + "7,1.25,-2.5,600.125,0.5,0.5,-0.5,0.5\n0,0,0,+1e2,1,0,0,0\n");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses.at(7).translation_mm, tilted_pose().translation_mm);
  EXPECT_TRUE(poses.at(7).rotation.isApprox(tilted_pose().rotation));
  EXPECT_EQ(poses.at(0).translation_mm.z(), 100);
}

TEST_F(PoseFile, ReadsFurtherColumnsByteOrderMarksAndWindowsLineEnds) {
  const auto poses = load(
      "\xEF\xBB\xBF"
      "frame,tx,ty,tz,qw,qx,qy,qz,quality,status\r\n3,0,0,500,1,0,0,0,0.9,tracking\r\n");
  EXPECT_EQ(poses.at(3).translation_mm.z(), 500);
}

TEST_F(PoseFile, ReadsATableWithoutRows) { EXPECT_TRUE(load(kHeader).empty()); }

TEST_F(PoseFile, NormalisesQuaternionsThatAreNearlyUnit) {
  const auto poses = load(kHeader + "0,0,0,500,0.9995,0,0,0");
  EXPECT_EQ(poses.at(0).rotation.w(), 1);
}

TEST_F(PoseFile, ReadsWhatItWrites) {
  const auto path = folder_.path() / "truth.csv";
  save_poses({{4, tilted_pose()}, {12, Pose{}}}, path);
  EXPECT_EQ(content_of(path),
            kHeader +
                "4,1.250000,-2.500000,600.125000,0.500000000,0.500000000,-0.500000000,0.500000000\n"
                "12,0.000000,0.000000,0.000000,1.000000000,0.000000000,0.000000000,0.000000000\n");
  const auto poses = load_poses(path);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses.at(4).translation_mm, tilted_pose().translation_mm);
}

TEST_F(PoseFile, IsIndependentOfTheLocale) {
  const test::CommaLocale comma;
  const auto path = folder_.path() / "truth.csv";
  save_poses({{1000, tilted_pose()}}, path);
  EXPECT_EQ(load_poses(path).at(1000).translation_mm, tilted_pose().translation_mm);
}

TEST_F(PoseFile, RejectsAMissingAnEmptyAndABinaryFile) {
  const auto missing = folder_.path() / "missing.csv";
  expect_file_error([&] { load_poses(missing); }, missing, "", "does not exist");
  expect_file_error([&] { load_poses(folder_.path()); }, folder_.path(), "", "is a folder");
  expect_error("", "line 1", "the columns should be frame,tx");
  expect_error(content_of(test::golden("box.png")), "line 1", "the columns should be frame,tx");
}

TEST_F(PoseFile, RejectsAnotherHeader) {
  expect_error("frame,x,y,z,qw,qx,qy,qz\n", "line 1", "'frame,x,y,z,qw,qx,qy,qz'");
  expect_error("frame,tx,ty,tz,qw,qx,qy,qzz\n", "line 1", "the columns");
  expect_error("0,0,0,500,1,0,0,0\n", "line 1", "the columns");
}

TEST_F(PoseFile, RejectsRowsOfAnotherLength) {
  expect_error(kHeader + "0,0,0,500,1,0,0,0\n1,0,0,500,1,0,0\n", "line 3", "7 columns");
  expect_error(kHeader + "0,0,0,500,1,0,0,0,9\n", "line 2", "9 columns");
  expect_error(kHeader + "\n0,0,0,500,1,0,0,0\n", "line 2", "1 columns");
}

TEST_F(PoseFile, RejectsWhatIsNoNumber) {
  expect_error(kHeader + "0,0,zero,500,1,0,0,0\n", "line 2", "'zero' in column 3");
  expect_error(kHeader + "0,0,,500,1,0,0,0\n", "line 2", "'' in column 3");
  expect_error(kHeader + "0,0,0,nan,1,0,0,0\n", "line 2", "'nan' in column 4");
  expect_error(kHeader + "0,0,0,1e999,1,0,0,0\n", "line 2", "'1e999' in column 4");
  expect_error(kHeader + "1.5,0,0,500,1,0,0,0\n", "line 2", "'1.5' should be a frame");
  expect_error(kHeader + "-1,0,0,500,1,0,0,0\n", "line 2", "'-1' should be a frame");
  expect_error(kHeader + "99999999999999999999,0,0,500,1,0,0,0\n", "line 2", "should be a frame");
}

TEST_F(PoseFile, RejectsQuaternionsThatAreNotUnit) {
  expect_error(kHeader + "0,0,0,500,0,0,0,0\n", "line 2", "unit length");
  expect_error(kHeader + "0,0,0,500,1,0.1,0,0\n", "line 2", "unit length");
  expect_error(kHeader + "0,0,0,500,1e200,1e200,0,0\n", "line 2", "unit length");
}

TEST_F(PoseFile, RejectsAFrameGivenTwice) {
  expect_error(kHeader + "5,0,0,500,1,0,0,0\n05,0,0,500,1,0,0,0\n", "line 3",
               "frame 5 is given a second time");
}

TEST(ParsePose, ReadsSevenNumbers) {
  const Pose pose = parse_pose(" 1.25 -2.5  600.125\t0.5 0.5 -0.5 0.5 ");
  EXPECT_EQ(pose.translation_mm, tilted_pose().translation_mm);
  EXPECT_TRUE(pose.rotation.isApprox(tilted_pose().rotation));
  EXPECT_EQ(parse_pose("0,0,500,1,0,0,0").translation_mm.z(), 500);
}

TEST(ParsePose, RejectsAnythingElse) {
  for (const char* text : {"", "0 0 500 1 0 0", "0 0 500 1 0 0 0 0", "0 0 far 1 0 0 0",
                           "0 0 inf 1 0 0 0", "0 0 500 2 0 0 0", "0 0 500 0 0 0 0"}) {
    EXPECT_THROW(parse_pose(text), ConfigError) << text;
  }
}

TEST(PoseWriter, WritesRowsInTheOrderOfTheTool) {
  TemporaryFolder folder;
  const auto path = folder.path() / "poses.csv";
  {
    PoseWriter writer(path);
    writer.write({3, tilted_pose(), 0.75, TrackStatus::tracking, true, 12.5});
    writer.write({4, Pose{}, 0, TrackStatus::lost, false, 0.25});
    EXPECT_FALSE(std::filesystem::exists(path)) << "not before the commit";
    writer.commit();
  }
  EXPECT_EQ(content_of(path),
            "frame,tx,ty,tz,qw,qx,qy,qz,quality,status,reset,milliseconds\n"
            "3,1.250000,-2.500000,600.125000,0.500000000,0.500000000,-0.500000000,0.500000000,"
            "0.7500,tracking,1,12.500\n"
            "4,0.000000,0.000000,0.000000,1.000000000,0.000000000,0.000000000,0.000000000,"
            "0.0000,lost,0,0.250\n");
  EXPECT_EQ(load_poses(path).size(), 2U);
}

TEST(PoseWriter, LeavesNothingWithoutACommit) {
  TemporaryFolder folder;
  const auto path = folder.write("poses.csv", "old");
  { PoseWriter(path).write({}); }
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(PoseWriter, SaysWhereItCannotWrite) {
  TemporaryFolder folder;
  const auto path = folder.path() / "no such folder" / "poses.csv";
  expect_file_error([&] { PoseWriter writer(path); }, path, "", "cannot be written");
  const auto occupied = folder.path() / "folder.csv";
  folder.write("folder.csv/file", "");
  PoseWriter writer(occupied);
  expect_file_error([&] { writer.commit(); }, occupied, "", "cannot be written");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace anneal6d
