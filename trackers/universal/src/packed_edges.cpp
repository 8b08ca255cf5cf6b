// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "packed_edges.h"

#include <algorithm>
#include <cstring>

namespace anneal6d {
namespace {

/// Which of eight pixels are not 0, the first as the lowest bit.
std::uint32_t bits_of(std::uint64_t eight_pixels) {
  constexpr std::uint64_t kTop = 0x8080808080808080;
  // Adding 127 carries into the top bit of a byte unless its lower bits are all 0.
  const std::uint64_t tops = (((eight_pixels & ~kTop) + ~kTop) | eight_pixels) & kTop;
  // Byte k's bit is shifted to place 56 + k; no two of the products meet.
  return static_cast<std::uint32_t>((tops >> 7) * 0x0102040810204080 >> 56);
}

/// Of the runs of set bits in `runs`, those bits that are at or above a bit of `seeds`: a sum
/// carries through the rest of a run.
std::uint64_t filled_up(std::uint64_t seeds, std::uint64_t runs) {
  return runs & (~(runs + seeds) | seeds);
}

/// The same, at or below.
std::uint64_t filled_down(std::uint64_t seeds, std::uint64_t runs) {
  for (int shift = 1; shift < 64; shift *= 2) {
    seeds |= runs & seeds >> shift;
    runs &= runs >> shift;
  }
  return seeds;
}

/// Adds to a row of bits what the rows beside it, which may be itself, and runs of candidates join
/// to it. Whether that was anything.
bool grow_row(std::uint64_t* row, const std::uint64_t* above, const std::uint64_t* below,
              const std::uint64_t* candidates, int words) {
  bool grown = false;
  const auto around = [&](int w) { return above[w] | row[w] | below[w]; };
  for (int w = 0; w < words; ++w) {
    if (candidates[w] == row[w]) continue;
    std::uint64_t near = around(w) | around(w) << 1 | around(w) >> 1;
    if (w > 0) near |= around(w - 1) >> 63;
    if (w + 1 < words) near |= around(w + 1) << 63;
    if ((near & candidates[w] & ~row[w]) == 0) continue;
    row[w] = filled_up(near & candidates[w], candidates[w]);
    grown = true;
  }
  if (!grown) return false;
  for (int w = words - 1; w >= 0; --w) {
    if (w + 1 < words) row[w] |= candidates[w] & row[w + 1] << 63;
    row[w] = filled_down(row[w], candidates[w]);
  }
  return true;
}

}  // namespace

void PackedEdges::assign(const cv::Mat& binary) {
  constexpr std::size_t kReadAhead = 4;  // words: 16 bytes behind the last pixel
  size_ = binary.size();
  words_a_row_ = (static_cast<std::size_t>(size_.width) + 31) / 32 + kReadAhead;
  words_.assign(words_a_row_ * static_cast<std::size_t>(size_.height), 0);
  for (int y = 0; y < size_.height; ++y) {
    const auto* const from = binary.ptr<std::uint8_t>(y);
    auto* const to = words_.data() + static_cast<std::size_t>(y) * words_a_row_;
    const auto pack = [&](int x, std::size_t count) {
      std::uint64_t pixels = 0;
      std::memcpy(&pixels, from + x, count);
      if (pixels != 0) to[x / 32] |= bits_of(pixels) << (x % 32);
    };
    int x = 0;
    for (; x + 8 <= size_.width; x += 8) pack(x, 8);
    pack(x, static_cast<std::size_t>(size_.width - x));
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

void grow_bits(std::vector<std::uint64_t>& bits, const std::vector<std::uint64_t>& candidates,
               int height, int words) {
  const auto grow = [&](int y) {
    const auto row_of = [&](int other) {
      return static_cast<std::size_t>(std::clamp(other, 0, height - 1)) *
             static_cast<std::size_t>(words);
    };
    return grow_row(bits.data() + row_of(y), bits.data() + row_of(y - 1),
                    bits.data() + row_of(y + 1), candidates.data() + row_of(y), words);
  };
  for (bool grown = true; grown;) {
    grown = false;
    for (int y = 0; y < height; ++y) grown |= grow(y);
    for (int y = height - 1; y >= 0; --y) grown |= grow(y);
  }
}

}  // namespace anneal6d
