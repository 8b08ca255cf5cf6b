// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "ply_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"
#include "little_endian.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

struct TypeRow {
  std::string_view name, old_name;
  PlyType type;
  std::size_t size;
  double lowest, highest;
};

template <class Number>
constexpr TypeRow row(std::string_view name, std::string_view old_name, PlyType type) {
  using Limits = std::numeric_limits<Number>;
  return {name, old_name, type, sizeof(Number), Limits::lowest(), Limits::max()};
}

constexpr std::array<TypeRow, 8> kTypes = {row<std::int8_t>("int8", "char", PlyType::int8),
                                           row<std::uint8_t>("uint8", "uchar", PlyType::uint8),
                                           row<std::int16_t>("int16", "short", PlyType::int16),
                                           row<std::uint16_t>("uint16", "ushort", PlyType::uint16),
                                           row<std::int32_t>("int32", "int", PlyType::int32),
                                           row<std::uint32_t>("uint32", "uint", PlyType::uint32),
                                           row<float>("float32", "float", PlyType::float32),
                                           row<double>("float64", "double", PlyType::float64)};

const TypeRow& row_of(PlyType type) { return kTypes[static_cast<std::size_t>(type)]; }

bool is_whole(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

PlyType take_type(TextTokens& words) {
  const std::string_view name = words.take("a type");
  for (const TypeRow& row : kTypes) {
    if (row.name == name || row.old_name == name) return row.type;
  }
  words.fail_at_taken(excerpt(name) + " is no type of PLY");
}

PlyProperty take_property(TextTokens& words) {
  PlyProperty property;
  if (words.peek() == "list") {
    words.take("list");
    property.length_type = take_type(words);
    if (!is_whole(*property.length_type)) {
      words.fail_at_taken("the length of a list should be a whole number");
    }
  }
  property.type = take_type(words);
  property.name = words.take("the name of a property");
  return property;
}

PlyHeader::Encoding take_encoding(TextTokens& words) {
  const std::string_view name = words.take("a format");
  PlyHeader::Encoding encoding = PlyHeader::Encoding::ascii;
  if (name == "binary_little_endian") {
    encoding = PlyHeader::Encoding::little_endian;
  } else if (name == "binary_big_endian") {
    encoding = PlyHeader::Encoding::big_endian;
  } else if (name != "ascii") {
    words.fail_at_taken(excerpt(name) + " is no format of PLY");
  }
  if (words.take("1.0") != "1.0") words.fail_at_taken("the version of PLY should be 1.0");
  return encoding;
}

template <bool kBig>
double decode(const char* bytes, PlyType type) {
  const auto as = [&]<class Number>(Number) {
    return static_cast<double>(kBig ? decode_big_endian<Number>(bytes)
                                    : decode_little_endian<Number>(bytes));
  };
  switch (type) {
    case PlyType::int8: return as(std::int8_t{});
    case PlyType::uint8: return as(std::uint8_t{});
    case PlyType::int16: return as(std::int16_t{});
    case PlyType::uint16: return as(std::uint16_t{});
    case PlyType::int32: return as(std::int32_t{});
    case PlyType::uint32: return as(std::uint32_t{});
    case PlyType::float32: return as(float{});
    case PlyType::float64: return as(double{});
  }
  return 0;  // unreachable
}

}  // namespace

PlyHeader parse_ply_header(const fs::path& path, std::string_view content) {
  // Only the header is text: nothing may look for words behind it.
  const std::size_t last = content.find("end_header");
  const std::size_t end =
      last == std::string_view::npos ? last : content.find('\n', last);
  if (!content.starts_with("ply") || end == std::string_view::npos) {
    throw FileError(path, "", "is no PLY model: it should have a header from 'ply' to 'end_header'");
  }
  PlyHeader header;
  header.size = end + 1;
  const std::string_view text = content.substr(0, header.size);
  TextTokens words(path, text);
  words.take("ply");
  bool has_format = false;
  while (words.peek() != "end_header") {
    const std::string_view word = words.take("a line of the header");
    const bool is_comment = word == "comment" || word == "obj_info";
    if (word == "format") {
      header.encoding = take_encoding(words);
      has_format = true;
    } else if (word == "element") {
      PlyElement& element = header.elements.emplace_back();
      element.name = words.take("the name of an element");
      element.count = words.count("the number of elements");
    } else if (word == "property") {
      if (header.elements.empty()) words.fail_at_taken("a property without an element above it");
      header.elements.back().properties.push_back(take_property(words));
    } else if (is_comment && words.line() == words.taken_line()) {
      const std::string_view comment = words.rest_of_line();
      constexpr std::string_view kTexture = "TextureFile ";
      if (comment.starts_with(kTexture)) {
        if (!header.texture.empty()) words.fail_at_taken("names a second texture; bake them into one");
        header.texture = comment.substr(kTexture.size());
      }
    } else if (!is_comment) {
      words.fail_at_taken(excerpt(word) + " is unknown in a header of PLY");
    }
  }
  if (!has_format) words.fail_at_next("the header has no format");
  return header;
}

PlyValues::PlyValues(const fs::path& path, std::string_view content, const PlyHeader& header)
    : path_(path),
      content_(content.substr(header.size)),
      encoding_(header.encoding),
      tokens_(path, encoding_ == PlyHeader::Encoding::ascii ? content : "", 0),
      header_lines_(0),
      at_(header.size) {}

}  // namespace anneal6d
