// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "assimp_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <filesystem>

#include "anneal6d/framework/atomic_file.h"

namespace anneal6d {
namespace {

constexpr std::size_t kMaxFileSize = std::size_t{256} << 20;

}  // namespace

bool AssimpFiles::Exists(const char* name) const {
  std::error_code ignored;
  return std::filesystem::is_regular_file(name, ignored);
}

const std::string& AssimpFiles::content(const std::string& name) {
  auto found = contents_.find(name);
  if (found == contents_.end()) {
    found = contents_.emplace(name, read_file(name, kMaxFileSize)).first;
  }
  return found->second;
}

Assimp::IOStream* AssimpFiles::Open(const char* name, const char* /*mode*/) {
  try {
    const std::string& bytes = content(name);
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                      bytes.size());
  } catch (const FileError& error) {
    if (!failure_) failure_ = error;
    return nullptr;  // how assimp expects to be told
  }
}

void AssimpFiles::Close(Assimp::IOStream* stream) { delete stream; }

}  // namespace anneal6d
