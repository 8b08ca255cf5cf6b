// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace anneal6d {

/// An edge image as one bit a pixel, lowest bit first. Rows are padded so that a 64-bit word can be
/// read from the byte of any pixel. For machines whose lowest byte comes first.
class PackedEdges {
 public:
  PackedEdges() = default;

  /// `binary`: CV_8UC1, 0 or not. Keeps its memory from frame to frame.
  void assign(const cv::Mat& binary);

  const std::uint8_t* row(int y) const {
    return reinterpret_cast<const std::uint8_t*>(words_.data() +
                                                 static_cast<std::size_t>(y) * words_a_row_);
  }
  /// All rows, one after the other: pixel x is bit x % 32 of its row's word x / 32.
  const std::uint32_t* words() const { return words_.data(); }
  int words_a_row() const { return static_cast<int>(words_a_row_); }
  cv::Size size() const { return size_; }

 private:
  cv::Size size_;
  std::size_t words_a_row_ = 0;
  std::vector<std::uint32_t> words_;
};

/// Widens the set bits of a packed image of `height` rows of `words` words each by `radius_px` in
/// every direction (a square), within `width_px`. `scratch` keeps its memory between calls.
void dilate_bits(std::vector<std::uint64_t>& bits, std::vector<std::uint64_t>& scratch,
                 int width_px, int height, int words, int radius_px);

/// Adds to the set bits all `candidates` that a chain of candidates joins to them, from neighbour
/// to neighbour of the eight (Canny's hysteresis). Set bits are candidates; rows as above.
void grow_bits(std::vector<std::uint64_t>& bits, const std::vector<std::uint64_t>& candidates,
               int height, int words);

}  // namespace anneal6d
