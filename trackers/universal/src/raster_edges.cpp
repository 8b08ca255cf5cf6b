// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_edges.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Moves the brightness of a row of the drawing to `row`, repeats it at both ends, and clears the
/// drawing.
void TakeRow(std::uint32_t* pixels, int width, std::uint16_t* row) {
  const hn::ScalableTag<std::int32_t> wide;
  const hn::Rebind<std::uint16_t, decltype(wide)> narrow;
  const auto byte = hn::Set(wide, 0xFF);
  const int lanes = static_cast<int>(hn::Lanes(wide));
  auto* const from = reinterpret_cast<std::int32_t*>(pixels);
  for (int x = 0; x < width; x += lanes) {
    hn::StoreU(hn::DemoteTo(narrow, hn::And(hn::LoadU(wide, from + x), byte)), narrow, row + x);
    hn::StoreU(hn::Zero(wide), wide, from + x);
  }
  row[-1] = row[0];
  row[width] = row[width - 1];
}

using D = hn::ScalableTag<std::int16_t>;
using V = hn::Vec<D>;
constexpr D d;

/// Differences and sums along a row, from which the rows above and below make both gradients.
struct Across {
  V difference, sum;
};

template <bool kSobel>
HWY_INLINE V Weighted(V side1, V centre, V side2) {
  return hn::Add(hn::Add(side1, side2), kSobel ? hn::Add(centre, centre) : centre);
}

template <bool kSobel>
HWY_INLINE Across AcrossRow(const std::uint16_t* row) {
  const auto load = [&](std::ptrdiff_t shift) {
    return hn::LoadU(d, reinterpret_cast<const std::int16_t*>(row + shift));
  };
  const V left = load(-1), right = load(1);
  return {hn::Sub(right, left), Weighted<kSobel>(left, load(0), right)};
}

/// Edges of `count` rows, whose brightness begins a row earlier. Column by column of vectors, so
/// that what a row contributes to three rows of edges stays in registers.
template <bool kSobel>
void FindEdgesOfBand(const EdgeJob& job, int y, int count) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto words = static_cast<std::ptrdiff_t>((job.width + 63) / 64);
  const V threshold = hn::Set(d, static_cast<std::int16_t>(job.threshold));
  std::uint64_t* const bits = job.bits + y * words;
  for (int x = 0; x < job.width; x += lanes) {
    auto* byte = reinterpret_cast<std::uint8_t*>(bits) + x / 8;
    const std::uint16_t* row = job.rows + kRowMargin + x;
    Across above = AcrossRow<kSobel>(row);
    Across here = AcrossRow<kSobel>(row += job.row_stride);
    for (int r = 0; r < count; ++r, byte += 8 * words) {
      const Across below = AcrossRow<kSobel>(row += job.row_stride);
      const V gx = Weighted<kSobel>(above.difference, here.difference, below.difference);
      const V gy = hn::Sub(below.sum, above.sum);
      const auto edge = hn::Gt(hn::Max(hn::Abs(gx), hn::Abs(gy)), threshold);
      if (lanes >= 8) {
        hn::StoreMaskBits(d, edge, byte);
      } else {
        std::uint8_t few = 0;
        hn::StoreMaskBits(d, edge, &few);
        *byte = static_cast<std::uint8_t>((x % 8 ? *byte : 0) | few << (x % 8));
      }
      above = here;
      here = below;
    }
  }
  if (job.width % 64 == 0) return;
  for (int r = 0; r < count; ++r) {
    bits[(r + 1) * words - 1] &= ~std::uint64_t{0} >> (64 - job.width % 64);
  }
}

void FindEdges(const EdgeJob& job) {
  const auto row = [&](int i) { return job.rows + i * job.row_stride; };
  const auto copy = [&](int from, int to) { std::copy_n(row(from), job.row_stride, row(to)); };
  const auto take = [&](int y, int to) {
    TakeRow(job.pixels + static_cast<std::ptrdiff_t>(y) * job.stride, job.width,
            row(to) + kRowMargin);
  };
  take(0, 1);
  copy(1, 0);
  for (int y = 0; y < job.height; y += kBandRows) {
    const int count = std::min(kBandRows, job.height - y);
    for (int r = 1; r <= count; ++r) {
      if (y + r < job.height) {
        take(y + r, r + 1);
      } else {
        copy(r, r + 1);
      }
    }
    if (job.sobel) {
      FindEdgesOfBand<true>(job, y, count);
    } else {
      FindEdgesOfBand<false>(job, y, count);
    }
    copy(count, 0);
    copy(count + 1, 1);
  }
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
