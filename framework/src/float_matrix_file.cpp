// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/float_matrix_file.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "little_endian.h"
#include "text_tokens.h"

namespace anneal6d {
namespace {

// "MATRIX cccccccccc rrrrrrrrrr ": columns come first.
constexpr std::string_view kMagic = "MATRIX ";
constexpr std::size_t kDigits = 10;
constexpr std::size_t kColumnsAt = kMagic.size();
constexpr std::size_t kRowsAt = kColumnsAt + kDigits + 1;
constexpr std::size_t kHeaderSize = kRowsAt + kDigits + 1;

[[noreturn]] void fail(const std::filesystem::path& path, std::size_t byte,
                       const std::string& what) {
  throw FileError(path, "byte " + std::to_string(byte), what);
}

std::uint64_t parse_size(const std::filesystem::path& path, const std::string& content,
                         std::size_t at, const std::string& what) {
  const std::string_view digits(content.data() + at, kDigits);
  std::uint64_t size = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + kDigits, size);
  if (error != std::errc{} || stop != digits.data() + kDigits) {
    fail(path, at, excerpt(digits) + " should be the number of " + what + " as ten decimal digits");
  }
  if (size == 0) fail(path, at, "the matrix has no " + what);
  if (content[at + kDigits] != ' ') {
    fail(path, at + kDigits, "a space should follow the number of " + what);
  }
  return size;
}

void append(std::string& content, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) content += static_cast<char>(bits >> shift & 0xFF);
}

std::string padded(Eigen::Index size) {
  const std::string digits = std::to_string(size);
  return std::string(kDigits - std::min(kDigits, digits.size()), '0') + digits;
}

}  // namespace

FloatMatrix load_float_matrix(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  if (!content.starts_with(kMagic)) {
    fail(path, 0, "is no IVT matrix: it should begin with 'MATRIX '");
  }
  if (content.size() < kHeaderSize) {
    fail(path, content.size(), "the file ends inside its header of 29 bytes");
  }
  const std::uint64_t columns = parse_size(path, content, kColumnsAt, "columns");
  const std::uint64_t rows = parse_size(path, content, kRowsAt, "rows");

  // Both numbers have at most ten digits, so that the quotient, unlike the product, can't overflow.
  const std::uint64_t payload = content.size() - kHeaderSize;
  const std::string shape =
      std::to_string(columns) + " columns and " + std::to_string(rows) + " rows of 4-byte numbers";
  if (rows > payload / 4 / columns) {
    fail(path, content.size(), "the file is too short for " + shape + " after the header");
  }
  const std::uint64_t expected = 4 * columns * rows;
  if (payload > expected) {
    fail(path, kHeaderSize + expected,
         std::to_string(payload - expected) + " bytes too many after " + shape);
  }

  FloatMatrix matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    const std::size_t at = kHeaderSize + 4 * static_cast<std::size_t>(i);
    matrix.data()[i] = decode_little_endian<float>(content.data() + at);
    if (!std::isfinite(matrix.data()[i])) {
      fail(path, at,
           "the number in row " + std::to_string(i / matrix.cols()) + ", column " +
               std::to_string(i % matrix.cols()) + " is not finite");
    }
  }
  return matrix;
}

void save_float_matrix(const FloatMatrix& matrix, const std::filesystem::path& path) {
  std::string content(kMagic);
  content += padded(matrix.cols()) + ' ' + padded(matrix.rows()) + ' ';
  content.reserve(kHeaderSize + 4 * static_cast<std::size_t>(matrix.size()));
  for (Eigen::Index i = 0; i < matrix.size(); ++i) append(content, matrix.data()[i]);
  write_file_atomically(path, content);
}

}  // namespace anneal6d
