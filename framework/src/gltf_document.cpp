// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "gltf_document.h"

#include <algorithm>
#include <array>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "base64.h"
#include "little_endian.h"
#include "mesh_data.h"
#include "text_tokens.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

// A binary file: "glTF", version, length of the file; then two chunks of length, type and content.
constexpr std::size_t kChunkAt = 12;
constexpr std::size_t kChunkHeader = 8;
constexpr int kMaxJsonDepth = 64;  // of lists and objects in each other
constexpr std::size_t kMaxNumber = std::size_t{1} << 32;

struct Component {
  std::size_t code, size;
  double white;  // what a normalised value is divided by
  double (*decode)(const char* bytes);
};

template <class Number>
constexpr Component component(std::size_t code, double white) {
  return {code, sizeof(Number), white, [](const char* bytes) {
            return static_cast<double>(decode_little_endian<Number>(bytes));
          }};
}

const std::array<Component, 6> kComponents = {
    component<std::int8_t>(5120, 127),    component<std::uint8_t>(5121, 255),
    component<std::int16_t>(5122, 32767), component<std::uint16_t>(5123, 65535),
    component<std::uint32_t>(5125, 1),    component<float>(5126, 1)};

std::size_t width_of(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 0;
}

std::string percent_decoded(const std::string& uri) {
  const auto digit = [](char c) {
    constexpr std::string_view kHexDigits = "0123456789abcdef0123456789ABCDEF";
    const std::size_t at = kHexDigits.find(c);
    return at == std::string_view::npos ? -1 : static_cast<int>(at % 16);
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_escape =
        uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    text += is_escape ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (is_escape) i += 2;
  }
  return text;
}

}  // namespace

GltfDocument::GltfDocument(const fs::path& path, std::string_view content, bool is_binary)
    : path_(path) {
  if (is_binary) {
    parse(split_binary(content), kChunkAt + kChunkHeader);
  } else {
    parse(content, 0);
  }
  const Json& asset = child(root(), "asset");
  if (!asset.contains("version") || !asset["version"].is_string() ||
      !asset["version"].get_ref<const std::string&>().starts_with("2.")) {
    fail("asset", "is no glTF 2: the version should be 2.x");
  }
  // Extensions that change what is drawn are named here; materials are simplified anyhow.
  for (const Json& extension : child(root(), "extensionsRequired")) {
    const std::string name = extension.is_string() ? extension.get<std::string>() : "?";
    if (!name.starts_with("KHR_materials_") && name != "KHR_mesh_quantization") {
      fail("extensionsRequired", excerpt(name) + " is not supported; export the model without it");
    }
  }
}

std::string_view GltfDocument::split_binary(std::string_view content) {
  const auto number_at = [&](std::size_t at) {
    return std::size_t{decode_little_endian<std::uint32_t>(content.data() + at)};
  };
  if (!content.starts_with("glTF") || content.size() < kChunkAt + kChunkHeader) {
    fail("byte 0", "is no binary glTF model");
  }
  if (number_at(4) != 2) fail("byte 4", "the version should be 2");
  if (number_at(8) != content.size()) {
    fail("byte 8", "the file should have " + std::to_string(number_at(8)) + " bytes, but has " +
                       std::to_string(content.size()));
  }
  const auto chunk = [&](std::size_t at, std::string_view type) {
    const std::size_t begin = at + kChunkHeader;
    if (begin > content.size() || content.substr(at + 4, 4) != type ||
        number_at(at) > content.size() - begin) {
      fail("byte " + std::to_string(at), "a chunk " + std::string(type.substr(0, type.find('\0'))) +
                                             " should be here and end within the file");
    }
    return content.substr(begin, number_at(at));
  };
  const std::string_view json = chunk(kChunkAt, "JSON");
  const std::size_t next = kChunkAt + kChunkHeader + json.size();
  if (next < content.size()) binary_ = chunk(next, std::string_view("BIN\0", 4));
  return json;
}

void GltfDocument::parse(std::string_view text, std::size_t text_at) {
  const auto check_depth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kMaxJsonDepth) fail("", "the JSON is nested too deeply");
    return true;
  };
  try {
    root_ = Json::parse(text, check_depth);
  } catch (const Json::parse_error& error) {
    fail("byte " + std::to_string(text_at + error.byte), "is no valid JSON");
  } catch (const Json::exception&) {
    fail("", "a number in the JSON is out of range");
  }
  if (!root_.is_object()) fail("", "should be a JSON object");
}

void GltfDocument::fail(const std::string& place, const std::string& what) const {
  throw FileError(path_, place, what);
}

const GltfDocument::Json& GltfDocument::child(const Part& part, const std::string& key) const {
  static const Json kNone;
  if (!part.json.is_object()) fail(part.name, "should be an object");
  const auto found = part.json.find(key);
  if (found == part.json.end()) return kNone;
  if (!found->is_structured()) fail(part.name, "'" + key + "' should be an object or a list");
  return *found;
}

std::size_t GltfDocument::size_of(const std::string& list) const {
  return child(root(), list).size();
}

GltfDocument::Part GltfDocument::part(const std::string& list, std::size_t index) const {
  const Json& items = child(root(), list);
  const std::string name = list + "[" + std::to_string(index) + "]";
  if (!items.is_array() || index >= items.size()) fail(name, "is named but does not exist");
  if (!items[index].is_object()) fail(name, "should be an object");
  return {items[index], name};
}

std::optional<std::size_t> GltfDocument::index(const Part& part, const std::string& key) const {
  if (!part.json.is_object()) fail(part.name, "should be an object");
  const auto found = part.json.find(key);
  if (found == part.json.end()) return std::nullopt;
  if (!found->is_number_unsigned() || found->get<std::uint64_t>() > kMaxNumber) {
    fail(part.name, "'" + key + "' should be a whole number from 0");
  }
  return found->get<std::size_t>();
}

std::size_t GltfDocument::needed_index(const Part& part, const std::string& key) const {
  const auto value = index(part, key);
  if (!value) fail(part.name, "'" + key + "' is missing");
  return *value;
}

std::vector<std::size_t> GltfDocument::indices(const Part& part, const std::string& key) const {
  std::vector<std::size_t> result;
  for (const Json& item : child(part, key)) {
    if (!item.is_number_unsigned()) fail(part.name, "'" + key + "' should be whole numbers from 0");
    result.push_back(item.get<std::size_t>());
  }
  return result;
}

std::vector<double> GltfDocument::numbers(const Part& part, const std::string& key,
                                          std::size_t length) const {
  const Json& list = child(part, key);
  if (list.is_null()) return {};
  const auto is_number = [](const Json& item) { return item.is_number(); };
  if (!list.is_array() || list.size() != length ||
      !std::all_of(list.begin(), list.end(), is_number)) {
    fail(part.name, "'" + key + "' should be " + std::to_string(length) + " numbers");
  }
  return list.get<std::vector<double>>();
}

fs::path GltfDocument::resolve(const std::string& uri) const {
  return path_.parent_path() / percent_decoded(uri);
}

const std::string& GltfDocument::read_buffer(std::size_t index) {
  if (const auto known = buffers_.find(index); known != buffers_.end()) return known->second;
  constexpr std::size_t kMaxSize = std::size_t{1} << 30;
  const Part buffer = part("buffers", index);
  const std::size_t size = needed_index(buffer, "byteLength");
  std::string content;
  if (!buffer.json.contains("uri")) {
    if (index != 0 || !binary_) fail(buffer.name, "has neither a 'uri' nor a binary chunk");
    content = *binary_;
  } else if (!buffer.json["uri"].is_string()) {
    fail(buffer.name, "'uri' should be a text");
  } else {
    const std::string uri = buffer.json["uri"];
    if (const auto data = decode_data_uri(uri)) {
      content = *data;
    } else if (uri.starts_with("data:")) {
      fail(buffer.name, "'uri' is no sound base64");
    } else {
      content = read_file(resolve(uri), kMaxSize);
    }
  }
  if (content.size() < size) {
    fail(buffer.name,
         "has " + std::to_string(content.size()) + " bytes instead of " + std::to_string(size));
  }
  content.resize(size);
  return buffers_.emplace(index, std::move(content)).first->second;
}

std::string_view GltfDocument::read_view(std::size_t index) {
  const Part view = part("bufferViews", index);
  const std::string& buffer = read_buffer(needed_index(view, "buffer"));
  const std::size_t offset = this->index(view, "byteOffset").value_or(0);
  const std::size_t length = needed_index(view, "byteLength");
  if (offset > buffer.size() || length > buffer.size() - offset) {
    fail(view.name, "reaches beyond its buffer");
  }
  return std::string_view(buffer).substr(offset, length);
}

GltfDocument::Numbers GltfDocument::read_accessor(std::size_t index) {
  const Part accessor = part("accessors", index);
  if (accessor.json.contains("sparse") || !accessor.json.contains("bufferView")) {
    fail(accessor.name, "sparse numbers are not supported; export the model without them");
  }
  const Json type = accessor.json.value("type", Json());
  Numbers numbers;
  numbers.width = type.is_string() ? width_of(type) : 0;
  if (numbers.width == 0) fail(accessor.name, "'type' should be SCALAR, VEC2, VEC3 or VEC4");
  const std::size_t code = needed_index(accessor, "componentType");
  const auto component = std::find_if(kComponents.begin(), kComponents.end(),
                                      [&](const Component& row) { return row.code == code; });
  if (component == kComponents.end()) fail(accessor.name, "'componentType' is unknown");

  const std::size_t view_index = needed_index(accessor, "bufferView");
  const std::string_view bytes = read_view(view_index);
  const std::size_t element_size = numbers.width * component->size;
  const std::size_t stride =
      this->index(part("bufferViews", view_index), "byteStride").value_or(element_size);
  const std::size_t offset = this->index(accessor, "byteOffset").value_or(0);
  const std::size_t count = needed_index(accessor, "count");
  if (count == 0 || count > 3 * kMaxTriangles) {
    fail(accessor.name, "'count' should be from 1 to " + std::to_string(3 * kMaxTriangles));
  }
  if (stride < element_size || offset + (count - 1) * stride + element_size > bytes.size()) {
    fail(accessor.name, "reaches beyond its buffer view");
  }
  const bool is_normalized = accessor.json.value("normalized", Json()) == true;
  numbers.values.reserve(count * numbers.width);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < numbers.width; ++j) {
      const double value =
          component->decode(bytes.data() + offset + i * stride + j * component->size);
      numbers.values.push_back(
          static_cast<float>(is_normalized ? value / component->white : value));
    }
  }
  return numbers;
}

}  // namespace anneal6d
