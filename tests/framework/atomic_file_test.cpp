// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/atomic_file.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>

#include "file_test_support.h"

namespace anneal6d {
namespace {

using test::expect_file_error;
using test::TemporaryFolder;

TEST(AtomicFile, ReadersSeeOneOfTheFilesWrittenAndAllOfIt) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "file";
  const std::string shorter(100'000, 'a'), longer(3'000'000, 'b');
  write_file_atomically(path, shorter);
  std::atomic<bool> done = false;
  const auto write = [&](const std::string& content) {
    while (!done) write_file_atomically(path, content);
  };
  std::thread one(write, shorter), other(write, longer);
  for (int i = 0; i < 200; ++i) {
    const std::string content = read_file(path);
    EXPECT_TRUE(content == shorter || content == longer) << content.size();
  }
  done = true;
  one.join();
  other.join();
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(AtomicFile, LeavesNothingBehindWhereItCannotWrite) {
  const TemporaryFolder folder;
  folder.write("folder/file", "");
  const std::filesystem::path occupied = folder.path() / "folder";
  expect_file_error([&] { write_file_atomically(occupied, "x"); }, occupied, "",
                    "cannot be written");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(AtomicFile, ReadsNothingLargerThanAllowed) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write("file", "12345");
  EXPECT_EQ(read_file(path, 5), "12345");
  expect_file_error([&] { read_file(path, 4); }, path, "", "5 bytes; at most 4");
  EXPECT_EQ(read_file(folder.write("empty", "")), "");
  expect_file_error([&] { read_file(folder.path()); }, folder.path(), "", "is a folder");
}

}  // namespace
}  // namespace anneal6d
