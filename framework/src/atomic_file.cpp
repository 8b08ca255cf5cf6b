// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/atomic_file.h"

#include <fstream>
#include <random>
#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {

namespace fs = std::filesystem;

fs::path resolved(const fs::path& path) {
  std::error_code failure;
  fs::path result = fs::absolute(path, failure);
  if (!failure) result = fs::weakly_canonical(result, failure);
  if (failure) throw FileError(path, "", "cannot be reached: " + failure.message());
  return result.has_filename() ? result : result.parent_path();
}

fs::path temporary_beside(const fs::path& path) {
  fs::path temporary = path;
  temporary += "." + std::to_string(std::random_device{}()) + ".part";
  return temporary;
}

void write_file_atomically(const fs::path& path, std::string_view content) {
  const fs::path temporary = temporary_beside(path);
  std::error_code ignored;
  {
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (!stream) {
      fs::remove(temporary, ignored);
      throw FileError(path, "",
                      "cannot be written; check that the folder exists, that you may "
                      "write there and that the disk is not full");
    }
  }
  std::error_code failure;
  fs::rename(temporary, path, failure);
  if (failure) {
    fs::remove(temporary, ignored);
    throw FileError(path, "", "cannot be written: " + failure.message());
  }
}

std::string read_file(const fs::path& path, std::size_t limit) {
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (status.type() == fs::file_type::not_found) throw FileError(path, "", "does not exist");
  if (failure) throw FileError(path, "", "cannot be read: " + failure.message());
  if (fs::is_directory(status)) throw FileError(path, "", "is a folder; a file is expected");
  if (!fs::is_regular_file(status)) throw FileError(path, "", "is not a regular file");
  // Size and content of the same file, should another take its name meanwhile.
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0) throw FileError(path, "", "cannot be read; check that you may read it");
  if (static_cast<std::uintmax_t>(size) > limit) {
    throw FileError(path, "",
                    "has " + std::to_string(size) + " bytes; at most " + std::to_string(limit) +
                        " are accepted");
  }
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (!stream) throw FileError(path, "", "cannot be read to its end");
  return content;
}

}  // namespace anneal6d
