// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_edges.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

#include <bit>
#include <cstring>

#include "raster_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Edges of `count` rows, whose brightness begins a row earlier, column by column of vectors.
template <bool kSobel>
void FindEdgesOfBand(const EdgeJob& job, int y, int count) {
  const DrawnPicture& picture = job.picture;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto words = static_cast<std::ptrdiff_t>((picture.width + 63) / 64);
  const V threshold = hn::Set(d, static_cast<std::int16_t>(job.threshold));
  std::uint64_t* const bits = job.bits + y * words;
  for (int x = 0; x < picture.width; x += lanes) {
    DifferentiateColumn<kSobel>(
        picture.rows + kRowMargin + x, picture.row_stride, count, [&](int r, V gx, V gy) {
          PutBits(hn::Gt(hn::Max(hn::Abs(gx), hn::Abs(gy)), threshold), x, bits + r * words);
        });
  }
  ClearBehind(picture.width, count, bits);
}

void FindEdges(const EdgeJob& job) {
  ForEachBand(job.picture, [&](int y, int count) {
    if (job.sobel) {
      FindEdgesOfBand<true>(job, y, count);
    } else {
      FindEdgesOfBand<false>(job, y, count);
    }
  });
}

/// Here, since instruction sets that have an instruction for it are not assumed elsewhere.
EdgeMatch CountEdgeBits(const CountJob& job) {
  EdgeMatch match;
  const std::uint64_t* bits = job.bits;
  const std::uint8_t* frame = job.frame;
  for (int y = 0; y < job.height; ++y, bits += job.words, frame += job.frame_stride) {
    for (int word = 0; word < job.words; ++word) {
      std::uint64_t seen;
      std::memcpy(&seen, frame + 8 * word, sizeof seen);
      match.rendered += std::popcount(bits[word]);
      match.matched += std::popcount(bits[word] & seen);
    }
  }
  return match;
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(FindEdges);
void find_edges(const EdgeJob& job) { HWY_DYNAMIC_DISPATCH(FindEdges)(job); }

HWY_EXPORT(CountEdgeBits);
EdgeMatch count_edge_bits(const CountJob& job) { return HWY_DYNAMIC_DISPATCH(CountEdgeBits)(job); }

}  // namespace anneal6d
#endif
