// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Brightness and gradients of a drawing's rows, for each of Highway's targets: included by
// raster_edges.cpp and raster_canny.cpp only.
#if defined(ANNEAL6D_RASTER_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ANNEAL6D_RASTER_ROWS_INL_H_
#undef ANNEAL6D_RASTER_ROWS_INL_H_
#else
#define ANNEAL6D_RASTER_ROWS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "raster_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Moves the brightness of a row of the drawing to `row`, repeats it at both ends, and clears the
/// drawing.
inline void TakeRow(std::uint32_t* pixels, int width, std::uint16_t* row) {
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

/// Pixels of a row and those beside them.
struct Neighbours {
  V left, centre, right;
};

HWY_INLINE Neighbours LoadNeighbours(const std::uint16_t* row) {
  const auto load = [&](std::ptrdiff_t shift) {
    return hn::LoadU(d, reinterpret_cast<const std::int16_t*>(row + shift));
  };
  return {load(-1), load(0), load(1)};
}

template <bool kSobel>
HWY_INLINE Across AcrossRow(const Neighbours& n) {
  return {hn::Sub(n.right, n.left),
          hn::Add(hn::Add(n.left, n.right), kSobel ? hn::Add(n.centre, n.centre) : n.centre)};
}

/// Gradients of a vector of pixels in `count` rows, the first of them below `row`: `use(r, gx, gy)`
/// for r from 0. What a row contributes to three rows of gradients stays in registers. Rows are
/// loaded one ahead, so that one more is read than is used: else compilers load each pixel again
/// for each use, and loads are what takes longest here.
template <bool kSobel, class Use>
HWY_INLINE void DifferentiateColumn(const std::uint16_t* row, std::ptrdiff_t row_stride, int count,
                                    const Use& use) {
  Across above = AcrossRow<kSobel>(LoadNeighbours(row));
  Across here = AcrossRow<kSobel>(LoadNeighbours(row += row_stride));
  Neighbours next = LoadNeighbours(row += row_stride);
  V upper = hn::Add(above.difference, here.difference);
  for (int r = 0; r < count; ++r) {
    const Across below = AcrossRow<kSobel>(next);
    next = LoadNeighbours(row += row_stride);
    const V lower = hn::Add(here.difference, below.difference);
    use(r, hn::Add(upper, kSobel ? lower : below.difference), hn::Sub(below.sum, above.sum));
    above = here;
    here = below;
    upper = lower;
  }
}

/// Takes a drawing's brightness band by band into its rows, from one row above the band to one
/// below, with the borders repeated, and calls `use(y, count)` for rows y .. y + count - 1.
template <class Use>
HWY_INLINE void ForEachBand(const DrawnPicture& picture, const Use& use) {
  const auto row = [&](int i) { return picture.rows + i * picture.row_stride; };
  const auto copy = [&](int from, int to) { std::copy_n(row(from), picture.row_stride, row(to)); };
  const auto take = [&](int y, int to) {
    TakeRow(picture.pixels + static_cast<std::ptrdiff_t>(y) * picture.stride, picture.width,
            row(to) + kRowMargin);
  };
  take(0, 1);
  copy(1, 0);
  for (int y = 0; y < picture.height; y += kBandRows) {
    const int count = std::min(kBandRows, picture.height - y);
    for (int r = 1; r <= count; ++r) {
      if (y + r < picture.height) {
        take(y + r, r + 1);
      } else {
        copy(r, r + 1);
      }
    }
    use(y, count);
    copy(count, 0);
    copy(count + 1, 1);
  }
}

/// Puts a mask of the pixels x, ... of a row into its bits; vectors come from left to right.
HWY_INLINE void PutBits(hn::Mask<D> mask, int x, std::uint64_t* row_of_bits) {
  auto* const byte = reinterpret_cast<std::uint8_t*>(row_of_bits) + x / 8;
  if (hn::Lanes(d) >= 8) {
    hn::StoreMaskBits(d, mask, byte);
  } else {
    std::uint8_t few = 0;
    hn::StoreMaskBits(d, mask, &few);
    *byte = static_cast<std::uint8_t>((x % 8 ? *byte : 0) | few << (x % 8));
  }
}

/// Clears the bits behind the last pixel in rows of whole words.
inline void ClearBehind(int width, int count, std::uint64_t* bits) {
  if (width % 64 == 0) return;
  const int words = (width + 63) / 64;
  for (int r = 1; r <= count; ++r) bits[r * words - 1] &= ~std::uint64_t{0} >> (64 - width % 64);
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#endif
