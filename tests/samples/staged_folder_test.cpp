// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "staged_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

class StagedFolderTest : public ::testing::Test {
 protected:
  StagedFolderTest() { fs::create_directories(parent_); }
  ~StagedFolderTest() override { fs::remove_all(parent_); }

  static void write(const fs::path& path, const std::string& content) {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << content;
  }

  fs::path parent_ = fs::path(::testing::TempDir()) /
                     ::testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::path target_ = parent_ / "results";
};

TEST_F(StagedFolderTest, AppearsWholeOnCommit) {
  {
    StagedFolder folder(target_ / "");
    write(folder.path() / "cup" / "poses.csv", "poses");
    write(folder.path() / "summary.json", "{}");
    EXPECT_FALSE(fs::exists(target_));
    folder.commit("summary.json");
  }
  EXPECT_EQ(read_file(target_ / "cup" / "poses.csv"), "poses");
  EXPECT_EQ(read_file(target_ / "summary.json"), "{}");
  EXPECT_EQ(std::distance(fs::directory_iterator(parent_), {}), 1);
}

TEST_F(StagedFolderTest, LeavesNothingWithoutCommit) {
  { const StagedFolder folder(target_); }
  EXPECT_TRUE(fs::is_empty(parent_));
}

TEST_F(StagedFolderTest, ReplacesFilesOfTheSameNamesAndKeepsOthers) {
  write(target_ / "summary.json", "old");
  write(target_ / "notes.txt", "mine");
  StagedFolder folder(target_);
  write(folder.path() / "summary.json", "new");
  folder.commit("summary.json");
  EXPECT_EQ(read_file(target_ / "summary.json"), "new");
  EXPECT_EQ(read_file(target_ / "notes.txt"), "mine");
}

TEST_F(StagedFolderTest, LeavesAFolderThatWasThereAsItWasWithoutCommit) {
  write(target_ / "notes.txt", "mine");
  {
    const StagedFolder folder(target_);
    write(folder.path() / "summary.json", "new");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(target_), {}), 1);
}

TEST_F(StagedFolderTest, WritesWhereALinkLeadsToBeItOnAnotherDisk) {
  const fs::path other = "/dev/shm";
  if (!fs::is_directory(other)) GTEST_SKIP() << "no second disk: " << other << " is missing";
  const fs::path place = other / "anneal6d_staged_folder_test";
  fs::create_directories(place);
  fs::create_directory_symlink(place, target_);
  StagedFolder folder(target_);
  write(folder.path() / "cup" / "poses.csv", "poses");
  write(folder.path() / "summary.json", "{}");
  folder.commit("summary.json");
  EXPECT_EQ(read_file(place / "summary.json"), "{}");
  EXPECT_EQ(read_file(place / "cup" / "poses.csv"), "poses");
  EXPECT_TRUE(fs::is_symlink(target_));
  fs::remove_all(place);
}

TEST_F(StagedFolderTest, RefusesAFileAsTarget) {
  write(target_, "a file");
  EXPECT_THROW(StagedFolder{target_}, FileError);
}

}  // namespace
}  // namespace anneal6d
