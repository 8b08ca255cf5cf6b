// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace anneal6d {

/// A path that need not be there, absolute and with links followed; "out/" is "out". Throws
/// FileError.
std::filesystem::path resolved(const std::filesystem::path& path);

/// Another name in the same folder for what becomes `path` when it is whole; one of its own for
/// each caller, since several may write the same file.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

/// Writes `content` to a temporary file beside `path` and renames it: readers see the old file or
/// the whole new one. Throws FileError.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// The whole file. Throws FileError: missing, unreadable, a folder, larger than `limit` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t limit = std::size_t{1} << 31);

}  // namespace anneal6d
