// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Filling of faces, for each of Highway's targets: included by raster_triangles.cpp only.
#if defined(ANNEAL6D_RASTER_FILL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ANNEAL6D_RASTER_FILL_INL_H_
#undef ANNEAL6D_RASTER_FILL_INL_H_
#else
#define ANNEAL6D_RASTER_FILL_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "raster_kernels.h"
#include "raster_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Bilinear texture brightness at texture coordinates u, v with repeat.
template <class Tag>
HWY_INLINE hn::Vec<Tag> SampleTexture(Tag tag, const QuadTexture& texture, hn::Vec<Tag> u,
                                      hn::Vec<Tag> v) {
  const hn::RebindToSigned<Tag> whole;
  const hn::RebindToUnsigned<Tag> bits;
  using V = hn::Vec<Tag>;
  const auto wrap = [&](V t, int size, hn::Vec<decltype(whole)>& cell, V& fraction) {
    const V extent = hn::Set(tag, static_cast<float>(size));
    const V position = hn::MulSub(hn::Sub(t, hn::Floor(t)), extent, hn::Set(tag, 0.5F));
    const V floor = hn::Floor(position);
    fraction = hn::Sub(position, floor);
    const auto index = hn::ConvertTo(whole, floor);
    const auto last = hn::Set(whole, size - 1);
    cell = hn::Min(hn::IfThenElse(hn::Lt(index, hn::Zero(whole)), last, index), last);
  };
  hn::Vec<decltype(whole)> column, row;
  V across, down;
  wrap(u, texture.width, column, across);
  wrap(v, texture.height, row, down);
  const auto index = hn::Add(hn::Mul(row, hn::Set(whole, texture.width)), column);
  const auto quad = hn::GatherIndex(bits, texture.quads.data(), index);
  const auto texel = [&](auto shifted) {
    return hn::ConvertTo(tag, hn::BitCast(whole, hn::And(shifted, hn::Set(bits, 0xFF))));
  };
  const V t00 = texel(quad), t10 = texel(hn::ShiftRight<8>(quad));
  const V t01 = texel(hn::ShiftRight<16>(quad)), t11 = texel(hn::ShiftRight<24>(quad));
  const V upper = hn::MulAdd(hn::Sub(t10, t00), across, t00);
  const V lower = hn::MulAdd(hn::Sub(t11, t01), across, t01);
  return hn::MulAdd(hn::Sub(lower, upper), down, upper);
}

/// Pixels of face i of a group, `along` pixels behind the first of their rows; 0 outside. `of_row`
/// makes a vector of what is said of rows.
template <bool kTextured, bool kNeedle, class Tag, class OfRow>
HWY_INLINE auto PixelsOf(Tag tag, const TriangleJob& job, const Group& g, std::size_t i,
                         hn::Vec<Tag> along, const OfRow& of_row) {
  using V = hn::Vec<Tag>;
  const hn::RebindToUnsigned<Tag> bits;
  const auto value = [&](const Plane& plane, Row::Values Row::*first) {
    return hn::MulAdd(along, hn::Set(tag, plane.step[i]), of_row(first));
  };
  V depth = value(g.depth, &Row::depth);
  V grey = hn::Max(value(g.grey1, &Row::grey1), value(g.grey2, &Row::grey2));
  if constexpr (kNeedle) {
    const auto clamp = [&](V v, const Limits& limits) {
      return hn::Min(hn::Max(v, hn::Set(tag, limits.least[i])), hn::Set(tag, limits.most[i]));
    };
    depth = clamp(depth, g.depth_limits);
    grey = clamp(grey, g.grey_limits);
  }
  if constexpr (kTextured) {
    const V inv_z = hn::MulAdd(hn::Sub(depth, hn::Set(tag, kFarDepth)),
                               hn::Set(tag, 1.0F / job.depth_scale), hn::Set(tag, job.inv_far));
    const V z_mm = hn::Div(hn::Set(tag, 1.0F), inv_z);
    const V u = value(g.u, &Row::u), v = value(g.v, &Row::v);
    grey = hn::Mul(grey, SampleTexture(tag, *job.texture, hn::Mul(u, z_mm), hn::Mul(v, z_mm)));
  }
  // Adding 1.5 * 2^23 leaves the rounded number in the lowest bits, for a third of the price of the
  // conversion.
  const V rounded = hn::MulAdd(grey, hn::Set(tag, g.sign[i]), hn::Set(tag, 12582912.0F));
  const auto pixels = hn::OrAnd(hn::ShiftLeft<8>(hn::BitCast(bits, depth)),
                                hn::BitCast(bits, rounded), hn::Set(bits, 0xFF));
  const auto inside = hn::RebindMask(bits, hn::Lt(along, of_row(&Row::width)));
  return hn::IfThenElseZero(inside, pixels);
}

/// Draws pixels over others: nearer is larger, so that the depth test is a maximum.
template <class Pixels>
HWY_INLINE void DrawOver(Pixels pixels, std::uint32_t* at) {
  const hn::DFromV<Pixels> tag;
  hn::StoreU(hn::Max(hn::LoadU(tag, at), pixels), tag, at);
}

/// Fills rows of face i of a group with this many vectors of pixels each; 0: as many as they need.
template <bool kTextured, bool kNeedle, int kVectors, class Tag>
HWY_INLINE void FillRows(Tag tag, const TriangleJob& job, const Group& g, const Row* rows,
                         std::size_t i, int count) {
  std::uint32_t* const drawing = job.pixels;
  const auto lanes = static_cast<float>(hn::Lanes(tag));
  for (int r = 0; r < count; ++r) {
    const Row& row = rows[r];
    if (kTextured && !(row.width[i] > 0)) continue;  // without texture that takes longer
    const auto of_row = [&](Row::Values Row::*values) { return hn::Set(tag, (row.*values)[i]); };
    std::uint32_t* at = drawing + row.place[i];
    auto along = hn::Iota(tag, 0.0F);
    float x = 0;
    do {
      DrawOver(PixelsOf<kTextured, kNeedle>(tag, job, g, i, along, of_row), at);
      along = hn::Add(along, hn::Set(tag, lanes));
      at += hn::Lanes(tag);
      x += lanes;
    } while (kVectors != 1 && x < (kVectors > 0 ? kVectors * lanes : row.width[i]));
  }
}

/// Fills rows that fit a narrow vector. With texture, where a pixel takes long, two at a time in
/// vectors twice as wide.
template <bool kTextured>
HWY_INLINE void FillNarrowRows(const TriangleJob& job, const Group& g, const Row* rows,
                               std::size_t i, int count) {
#if HWY_MAX_BYTES == 64
  if constexpr (kTextured) {
    constexpr auto kHalf = static_cast<float>(hn::MaxLanes(narrow));
    const hn::Half<hn::RebindToUnsigned<F>> half;
    const auto second = hn::Ge(hn::Iota(f, 0.0F), hn::Set(f, kHalf));
    const VF along = hn::Sub(hn::Iota(f, 0.0F), hn::IfThenElseZero(second, hn::Set(f, kHalf)));
    for (int r = 0; r + 1 < count; r += 2) {
      const Row &upper = rows[r], &lower = rows[r + 1];
      if (!(upper.width[i] > 0) && !(lower.width[i] > 0)) continue;
      const auto of_row = [&](Row::Values Row::*values) {
        return hn::IfThenElse(second, hn::Set(f, (lower.*values)[i]),
                              hn::Set(f, (upper.*values)[i]));
      };
      const auto pixels = PixelsOf<kTextured, false>(f, job, g, i, along, of_row);
      DrawOver(hn::LowerHalf(half, pixels), job.pixels + upper.place[i]);
      DrawOver(hn::UpperHalf(half, pixels), job.pixels + lower.place[i]);
    }
    rows += count & ~1;
    count &= 1;
  }
#endif
  FillRows<kTextured, false, 1>(narrow, job, g, rows, i, count);
}

/// Rows of more than one vector are so many that two are filled without a loop, whose end cannot be
/// predicted, if that is enough for all rows of a face. With texture an empty one takes too long.
constexpr bool kOftenTwo = kMostLanes <= 8;

/// Draws the faces of a batch and empties it.
template <bool kTextured>
void DrawBatch(const TriangleJob& job, Batch& batch) {
  constexpr int kRows = 64;  // found at a time
  Group group;
  Row rows[kRows];
  for (std::size_t first = 0; first < batch.count; first += hn::Lanes(f)) {
    SetUp<kTextured>(job, batch, first, group);
    if (group.drawn == 0) continue;
    for (int row = 0; row < group.tallest; row += kRows) {
      FindRows<kTextured>(job, group, row, std::min(kRows, group.tallest - row), rows);
      for (std::uint64_t drawn = group.drawn; drawn; drawn &= drawn - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(drawn));
        const int count = std::clamp(group.height[i] - row, 0, kRows);
        if (group.needles >> i & 1) [[unlikely]] {
          FillRows<kTextured, true, 0>(f, job, group, rows, i, count);
        } else if (group.narrow >> i & 1) {
          FillNarrowRows<kTextured>(job, group, rows, i, count);
        } else if (!(group.wide >> i & 1)) {
          FillRows<kTextured, false, 1>(f, job, group, rows, i, count);
        } else if (kOftenTwo && !kTextured && !(group.wider >> i & 1)) {
          FillRows<kTextured, false, 2>(f, job, group, rows, i, count);
        } else {
          FillRows<kTextured, false, 0>(f, job, group, rows, i, count);
        }
      }
    }
  }
  batch.count = 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#endif
