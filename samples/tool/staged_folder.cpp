// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "staged_folder.h"

#include <random>
#include <string>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"

namespace anneal6d {

namespace fs = std::filesystem;

namespace {

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::rename(from, to, error);
  if (error) throw FileError(to, "", "cannot be written: " + error.message());
}

}  // namespace

StagedFolder::StagedFolder(const fs::path& target) : target_(resolved(target)) {
  std::error_code error;
  const bool exists = fs::exists(target_, error);
  if (exists && !fs::is_directory(target_, error)) {
    throw FileError(target, "", "is a file; a folder is needed");
  }
  const std::string unique = std::to_string(std::random_device{}());
  staging_ = exists ? target_ / (".partial-" + unique)
                    : target_.parent_path() / ("." + target_.filename().string() + "." + unique);
  fs::create_directories(staging_, error);
  if (error) throw FileError(target, "", "cannot be written: " + error.message());
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

void StagedFolder::commit(const fs::path& last) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(staging_)) {
    if (!entry.is_regular_file()) continue;
    const fs::path file = fs::relative(entry.path(), staging_);
    if (file != last) files.push_back(file);
  }
  // An older `last` must not vouch for a mixture of old and new files.
  std::error_code ignored;
  fs::remove(target_ / last, ignored);
  for (const fs::path& file : files) move_file(staging_ / file, target_ / file);
  move_file(staging_ / last, target_ / last);
}

}  // namespace anneal6d
