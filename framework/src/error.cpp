// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

std::string compose(const std::filesystem::path& path, const std::string& place,
                    const std::string& what) {
  return path.string() + (place.empty() ? "" : ", " + place) + ": " + what;
}

}  // namespace

FileError::FileError(const std::filesystem::path& path, const std::string& place,
                     const std::string& what)
    : Error(compose(path, place, what)), path_(path), place_(place) {}

}  // namespace anneal6d
