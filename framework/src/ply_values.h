// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text_tokens.h"

namespace anneal6d {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;     ///< of the value, or of a list's items
  std::optional<PlyType> length_type;  ///< of the number of items; empty: no list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

/// The header of a PLY file, then its values one by one. Keeps references to its arguments.
class PlyValues {
 public:
  /// Reads the header. Throws FileError with the line.
  PlyValues(const std::filesystem::path& path, std::string_view content);

  const std::vector<PlyElement>& elements() const { return elements_; }
  /// Of a line "comment TextureFile NAME" in the header; empty: none.
  const std::string& texture() const { return texture_; }

  /// The next value. Throws FileError: the file ends, no number, not finite, outside its type.
  double take(PlyType type);
  /// Throws FileError if there is something left.
  void expect_end() const;
  /// Throws FileError at the value taken last.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  enum class Encoding { ascii, little_endian, big_endian };

  void read_header();
  Encoding take_encoding();

  const std::filesystem::path& path_;
  std::string_view content_;
  TextTokens words_;  // of the header, then of the values of a text file
  std::optional<Encoding> encoding_;
  std::vector<PlyElement> elements_;
  std::string texture_;
  std::size_t at_ = 0;     // the next value of a binary file
  std::size_t taken_ = 0;  // the one before
};

/// Whether it is a type of whole numbers.
bool is_whole(PlyType type);

/// The largest value of the type: what a colour of whole numbers calls white.
double largest_of(PlyType type);

}  // namespace anneal6d
