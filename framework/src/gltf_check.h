// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <string_view>

namespace anneal6d {

/// Looks whether `content` is a glTF 2 file, text (.gltf) or binary (.glb), with sound JSON in it.
/// Throws FileError with the byte. It goes before assimp's reader, which says less and leaks memory
/// when the JSON is malformed.
void check_gltf(const std::filesystem::path& path, std::string_view content, bool is_binary);

}  // namespace anneal6d
