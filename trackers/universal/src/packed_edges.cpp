// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "packed_edges.h"

#include <algorithm>

namespace anneal6d {

void PackedEdges::assign(const cv::Mat& binary) {
  constexpr std::size_t kReadAhead = 4;  // words: 16 bytes behind the last pixel
  size_ = binary.size();
  words_a_row_ = (static_cast<std::size_t>(size_.width) + 31) / 32 + kReadAhead;
  words_.assign(words_a_row_ * static_cast<std::size_t>(size_.height), 0);
  for (int y = 0; y < size_.height; ++y) {
    const auto* const from = binary.ptr<std::uint8_t>(y);
    auto* const to = words_.data() + static_cast<std::size_t>(y) * words_a_row_;
    for (int x = 0; x < size_.width; ++x) {
      to[x / 32] |= static_cast<std::uint32_t>(from[x] != 0) << (x % 32);
    }
  }
}

void dilate_bits(std::vector<std::uint64_t>& bits, std::vector<std::uint64_t>& scratch,
                 int width_px, int height, int words, int radius_px) {
  const auto stride = static_cast<std::size_t>(words);
  scratch.resize(bits.size());
  const std::uint64_t last_mask =
      width_px % 64 ? ~std::uint64_t{0} >> (64 - width_px % 64) : ~std::uint64_t{0};
  for (int step = 0; step < radius_px; ++step) {
    for (int y = 0; y < height; ++y) {
      const std::uint64_t* const row = bits.data() + static_cast<std::size_t>(y) * stride;
      std::uint64_t* const wide = scratch.data() + static_cast<std::size_t>(y) * stride;
      for (int w = 0; w < words; ++w) {
        const std::uint64_t carried_right = w > 0 ? row[w - 1] >> 63 : 0;
        const std::uint64_t carried_left = w + 1 < words ? row[w + 1] << 63 : 0;
        wide[w] = row[w] | row[w] << 1 | carried_right | row[w] >> 1 | carried_left;
      }
      wide[words - 1] &= last_mask;
    }
    for (int y = 0; y < height; ++y) {
      const std::uint64_t* const here = scratch.data() + static_cast<std::size_t>(y) * stride;
      const std::uint64_t* const above = y > 0 ? here - stride : here;
      const std::uint64_t* const below = y + 1 < height ? here + stride : here;
      std::uint64_t* const out = bits.data() + static_cast<std::size_t>(y) * stride;
      for (int w = 0; w < words; ++w) out[w] = above[w] | here[w] | below[w];
    }
  }
}

}  // namespace anneal6d
