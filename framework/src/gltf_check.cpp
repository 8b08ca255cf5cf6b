// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "gltf_check.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "anneal6d/framework/error.h"
#include "little_endian.h"

namespace anneal6d {
namespace {

// Binary: "glTF", version, length of the file; then chunks of length, type, content, JSON first.
constexpr std::size_t kChunkAt = 12;
constexpr std::size_t kJsonAt = 20;
// Of lists and objects in each other; assimp's reader calls itself for each.
constexpr int kMaxDepth = 64;

[[noreturn]] void fail(const std::filesystem::path& path, std::size_t byte,
                       const std::string& what) {
  throw FileError(path, "byte " + std::to_string(byte), "is malformed: " + what);
}

std::string_view json_of_binary(const std::filesystem::path& path, std::string_view content) {
  if (!content.starts_with("glTF") || content.size() < kJsonAt) {
    fail(path, 0, "it is no binary glTF model");
  }
  const auto number_at = [&](std::size_t at) {
    return decode_little_endian<std::uint32_t>(content.data() + at);
  };
  if (number_at(4) != 2) fail(path, 4, "its version should be 2");
  if (number_at(8) != content.size()) {
    fail(path, 8,
         "it should have " + std::to_string(number_at(8)) + " bytes, but has " +
             std::to_string(content.size()));
  }
  const std::size_t length = number_at(kChunkAt);
  if (length > content.size() - kJsonAt || content.substr(kChunkAt + 4, 4) != "JSON") {
    fail(path, kChunkAt, "its first chunk should be JSON and end within the file");
  }
  return content.substr(kJsonAt, length);
}

}  // namespace

void check_gltf(const std::filesystem::path& path, std::string_view content, bool is_binary) {
  const std::string_view text = is_binary ? json_of_binary(path, content) : content;
  const std::size_t text_at = is_binary ? kJsonAt : 0;
  const auto check_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMaxDepth) fail(path, text_at, "its JSON is nested too deeply");
    return true;
  };
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text, check_depth);
  } catch (const nlohmann::json::parse_error& error) {
    fail(path, text_at + error.byte, "it is no valid JSON");
  } catch (const nlohmann::json::exception&) {
    fail(path, text_at, "a number in its JSON is out of range");
  }
  const bool is_gltf = json.is_object() && json.contains("asset") && json["asset"].is_object() &&
                       json["asset"].contains("version");
  if (!is_gltf) fail(path, text_at, "it is no glTF: asset.version is missing");
}

}  // namespace anneal6d
