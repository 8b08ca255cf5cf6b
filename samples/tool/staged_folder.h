// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>

namespace anneal6d {

/// A folder of results that appears as a whole: files are written to a hidden folder and move to
/// `target` on `commit()`; without a commit nothing is left. The hidden one lies beside the target,
/// or inside it if that is there already: it may be a disk of its own, or a link to one.
class StagedFolder {
 public:
  /// Throws FileError if `target` is a file or its parent cannot be written.
  explicit StagedFolder(const std::filesystem::path& target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Write here.
  const std::filesystem::path& path() const { return staging_; }

  /// Moves the files to the target; those there of the same names are replaced, others stay. The
  /// file named `last` moves last, so that its presence tells that all is there. Throws FileError.
  void commit(const std::filesystem::path& last);

 private:
  std::filesystem::path target_, staging_;
};

}  // namespace anneal6d
