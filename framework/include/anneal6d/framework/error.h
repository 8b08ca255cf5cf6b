// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace anneal6d {

/// Root of everything this library throws. Messages say what was wrong, where, and what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file is missing, unreadable, truncated or malformed, or could not be written.
class FileError : public Error {
 public:
  /// `place` locates the fault inside the file ("line 12", "byte 29", a key); may be empty.
  FileError(const std::filesystem::path& path, const std::string& place, const std::string& what);

  const std::filesystem::path& path() const noexcept { return path_; }
  const std::string& place() const noexcept { return place_; }

 private:
  std::filesystem::path path_;
  std::string place_;
};

/// A setting, option or name is unknown, out of range or contradicts another.
class ConfigError : public Error {
 public:
  using Error::Error;
};

/// A camera or another source of frames failed while it was in use.
class CaptureError : public Error {
 public:
  using Error::Error;
};

/// An OpenGL context or operation failed.
class GraphicsError : public Error {
 public:
  using Error::Error;
};

/// A CUDA device or operation failed.
class CudaError : public Error {
 public:
  using Error::Error;
};

/// A device or optional part is not there: no camera, no GPU, a module left out of the build.
class BackendUnavailable : public Error {
 public:
  using Error::Error;
};

}  // namespace anneal6d
