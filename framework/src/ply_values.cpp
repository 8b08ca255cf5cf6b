// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "ply_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "anneal6d/framework/error.h"
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

template <bool kBig>
double decode(const char* bytes, PlyType type) {
  const auto as = [&]<class Number>(Number) {
    return static_cast<double>(kBig ? decode_big_endian<Number>(bytes)
                                    : decode_little_endian<Number>(bytes));
  };
  switch (type) {
    case PlyType::int8:
      return as(std::int8_t{});
    case PlyType::uint8:
      return as(std::uint8_t{});
    case PlyType::int16:
      return as(std::int16_t{});
    case PlyType::uint16:
      return as(std::uint16_t{});
    case PlyType::int32:
      return as(std::int32_t{});
    case PlyType::uint32:
      return as(std::uint32_t{});
    case PlyType::float32:
      return as(float{});
    case PlyType::float64:
      return as(double{});
  }
  return 0;  // unreachable
}

}  // namespace

PlyValues::PlyValues(const fs::path& path, std::string_view content)
    : path_(path), content_(content), words_(path, content) {
  if (words_.peek() != "ply")
    throw FileError(path, "", "is no PLY model: it should begin with 'ply'");
  words_.take("ply");
  read_header();
}

void PlyValues::read_header() {
  while (words_.peek() != "end_header") {
    const std::string_view word = words_.take("a line of the header");
    if (word == "format") {
      encoding_ = take_encoding();
    } else if (word == "element") {
      PlyElement& element = elements_.emplace_back();
      element.name = words_.take("the name of an element");
      element.count = words_.count("the number of elements");
    } else if (word == "property") {
      if (elements_.empty()) words_.fail_at_taken("a property without an element above it");
      elements_.back().properties.push_back(take_property(words_));
    } else if (word == "comment" || word == "obj_info") {
      if (words_.line() != words_.taken_line()) continue;
      constexpr std::string_view kTexture = "TextureFile ";
      const std::string_view comment = words_.rest_of_line();
      if (!comment.starts_with(kTexture)) continue;
      if (!texture_.empty()) words_.fail_at_taken("names a second texture; bake them into one");
      texture_ = comment.substr(kTexture.size());
    } else {
      words_.fail_at_taken(excerpt(word) + " is unknown in a header of PLY");
    }
  }
  if (!encoding_) words_.fail_at_next("the header has no format");
  const std::string_view end_word = words_.take("end_header");
  const auto end = static_cast<std::size_t>(end_word.data() - content_.data()) + end_word.size();
  at_ = std::min(content_.find('\n', end), content_.size() - 1) + 1;
  taken_ = at_;
}

PlyValues::Encoding PlyValues::take_encoding() {
  const std::string_view name = words_.take("a format");
  const bool is_known =
      name == "ascii" || name == "binary_little_endian" || name == "binary_big_endian";
  if (!is_known) words_.fail_at_taken(excerpt(name) + " is no format of PLY");
  if (words_.take("1.0") != "1.0") words_.fail_at_taken("the version of PLY should be 1.0");
  if (name == "ascii") return Encoding::ascii;
  return name == "binary_little_endian" ? Encoding::little_endian : Encoding::big_endian;
}

double PlyValues::take(PlyType type) {
  const TypeRow& row = row_of(type);
  double value = 0;
  if (encoding_ == Encoding::ascii) {
    value = words_.number("a value");
  } else {
    taken_ = at_;
    if (content_.size() - at_ < row.size) fail("the file ends inside its values");
    const char* const bytes = content_.data() + at_;
    value =
        encoding_ == Encoding::big_endian ? decode<true>(bytes, type) : decode<false>(bytes, type);
    at_ += row.size;
  }
  const bool fits = value >= row.lowest && value <= row.highest &&
                    (!is_whole(type) || value == std::floor(value));
  if (!fits) fail("a value is not finite, or not of its type, " + std::string(row.old_name));
  return value;
}

void PlyValues::expect_end() const {
  if (encoding_ == Encoding::ascii) {
    if (!words_.at_end()) words_.fail_at_next("there are more values than the header says");
  } else if (at_ != content_.size()) {
    throw FileError(path_, "byte " + std::to_string(at_),
                    "there are more values than the header says");
  }
}

void PlyValues::fail(const std::string& what) const {
  if (encoding_ == Encoding::ascii) words_.fail_at_taken(what);
  throw FileError(path_, "byte " + std::to_string(taken_), what);
}

bool is_whole(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

double largest_of(PlyType type) { return row_of(type).highest; }

}  // namespace anneal6d
