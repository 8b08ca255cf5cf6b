// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <assimp/IOSystem.hpp>
#include <map>
#include <optional>
#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {

/// Hands assimp the model's file and those it names, read whole and of limited size, and remembers
/// what could not be read: assimp itself goes on without a missing material file.
class AssimpFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char* name) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

  /// The whole of a file, which `Open` then serves without reading it again. Throws FileError.
  const std::string& content(const std::string& name);

  /// The first file that could not be read.
  const std::optional<FileError>& failure() const { return failure_; }

 private:
  std::map<std::string, std::string> contents_;  // streams point into it
  std::optional<FileError> failure_;
};

}  // namespace anneal6d
