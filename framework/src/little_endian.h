// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace anneal6d {

/// The number that `sizeof(Number)` bytes mean, on machines of either byte order.
template <class Number>
Number decode_little_endian(const char* bytes) {
  std::array<char, sizeof(Number)> copy;
  std::copy_n(bytes, copy.size(), copy.begin());
  if constexpr (std::endian::native == std::endian::big) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

template <class Number>
Number decode_big_endian(const char* bytes) {
  std::array<char, sizeof(Number)> copy;
  std::reverse_copy(bytes, bytes + copy.size(), copy.begin());
  return decode_little_endian<Number>(copy.data());
}

}  // namespace anneal6d
