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
  PlyType type = PlyType::float32;      ///< of the value, or of a list's items
  std::optional<PlyType> length_type;  ///< of the number of items; empty: no list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

/// What comes before the values of a PLY file.
struct PlyHeader {
  enum class Encoding { ascii, little_endian, big_endian };
  Encoding encoding = Encoding::ascii;
  std::vector<PlyElement> elements;
  std::string texture;  ///< of a line "comment TextureFile NAME"; empty: none
  std::size_t size = 0;  ///< bytes up to the values
};

/// Reads the header. Throws FileError with the line.
PlyHeader parse_ply_header(const std::filesystem::path& path, std::string_view content);

/// Takes the values after the header one by one. Keeps references to its arguments.
class PlyValues {
 public:
  PlyValues(const std::filesystem::path& path, std::string_view content, const PlyHeader& header);

  /// The next value; throws FileError: the file ends, no number, not finite, not within its type.
  double take(PlyType type);
  /// The next value as the number of a list's items.
  std::size_t take_length(PlyType type);
  bool at_end() const;
  /// Throws FileError at the value taken last.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  double take_text(PlyType type);
  double take_binary(PlyType type);

  const std::filesystem::path& path_;
  std::string_view content_;
  PlyHeader::Encoding encoding_;
  TextTokens tokens_;    // after the header of a text file
  int header_lines_;     // before those of tokens_
  std::size_t at_ = 0;   // the next byte of a binary file
};

/// Largest value of a colour of this type.
double ply_white(PlyType type);

}  // namespace anneal6d
