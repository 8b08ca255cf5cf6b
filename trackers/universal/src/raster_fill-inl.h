// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Filling of triangles, for each of Highway's targets: included by raster_triangles.cpp only.
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

using PU = hn::RebindToUnsigned<F>;
constexpr PU pu;
using VU = hn::Vec<PU>;

/// Bilinear texture brightness at texture coordinates u, v with repeat.
HWY_INLINE VF SampleTexture(const QuadTexture& texture, VF u, VF v) {
  const auto wrap = [](VF t, int size, hn::Vec<I>& cell, VF& fraction) {
    const VF extent = hn::Set(f, static_cast<float>(size));
    const VF position = hn::MulSub(hn::Sub(t, hn::Floor(t)), extent, hn::Set(f, 0.5F));
    const VF floor = hn::Floor(position);
    fraction = hn::Sub(position, floor);
    const auto index = hn::ConvertTo(si, floor);
    const auto wrapped = hn::IfThenElse(hn::Lt(index, hn::Zero(si)), hn::Set(si, size - 1), index);
    cell = hn::Min(wrapped, hn::Set(si, size - 1));
  };
  hn::Vec<I> column, row;
  VF across, down;
  wrap(u, texture.width, column, across);
  wrap(v, texture.height, row, down);
  const auto index = hn::Add(hn::Mul(row, hn::Set(si, texture.width)), column);
  const auto quad = hn::GatherIndex(pu, texture.quads.data(), index);
  const auto byte = hn::Set(pu, 0xFF);
  const auto texel = [&](auto bits) {
    return hn::ConvertTo(f, hn::BitCast(si, hn::And(bits, byte)));
  };
  const VF t00 = texel(quad), t10 = texel(hn::ShiftRight<8>(quad));
  const VF t01 = texel(hn::ShiftRight<16>(quad)), t11 = texel(hn::ShiftRight<24>(quad));
  const VF upper = hn::MulAdd(hn::Sub(t10, t00), across, t00);
  const VF lower = hn::MulAdd(hn::Sub(t11, t01), across, t01);
  return hn::MulAdd(hn::Sub(lower, upper), down, upper);
}

/// Pixels of triangle i of a group, `along` pixels behind the first of their rows; 0 outside.
/// `of_row` makes a vector of what is said of rows.
template <bool kTextured, bool kNeedle, class OfRow>
HWY_INLINE VU PixelsOf(const TriangleJob& job, const Group& g, const Rows& rows, std::size_t i,
                       VF along, const OfRow& of_row) {
  VF depth = hn::MulAdd(along, hn::Set(f, g.depth.step[i]), of_row(rows.depth));
  VF grey = hn::MulAdd(along, hn::Set(f, g.grey.step[i]), of_row(rows.grey));
  if constexpr (kNeedle) {
    const auto clamp = [&](VF value, const Planes& planes) {
      return hn::Min(hn::Max(value, hn::Set(f, planes.least[i])), hn::Set(f, planes.most[i]));
    };
    depth = clamp(depth, g.depth);
    grey = clamp(grey, g.grey);
  }
  if constexpr (kTextured) {
    const VF inv_z = hn::MulAdd(hn::Sub(depth, hn::Set(f, kFarDepth)),
                                hn::Set(f, 1.0F / job.depth_scale), hn::Set(f, job.inv_far));
    const VF z_mm = hn::Div(hn::Set(f, 1.0F), inv_z);
    const VF u = hn::MulAdd(along, hn::Set(f, g.u.step[i]), of_row(rows.u));
    const VF v = hn::MulAdd(along, hn::Set(f, g.v.step[i]), of_row(rows.v));
    grey = hn::Mul(grey, SampleTexture(*job.texture, hn::Mul(u, z_mm), hn::Mul(v, z_mm)));
  }
  // Adding 1.5 * 2^23 leaves the rounded number in the lowest bits, for a third of the price of the
  // conversion.
  const auto rounded = hn::BitCast(pu, hn::Add(grey, hn::Set(f, 12582912.0F)));
  const auto pixel =
      hn::OrAnd(hn::ShiftLeft<8>(hn::BitCast(pu, depth)), rounded, hn::Set(pu, 0xFF));
  const auto inside = hn::RebindMask(pu, hn::Lt(along, of_row(rows.width)));
  return hn::IfThenElseZero(inside, pixel);
}

/// Draws pixels over others: nearer is larger, so that the depth test is a maximum.
template <class Tag>
HWY_INLINE void DrawOver(Tag tag, hn::Vec<Tag> pixels, std::uint32_t* at) {
  hn::StoreU(hn::Max(hn::LoadU(tag, at), pixels), tag, at);
}

/// Fills rows of triangle i of a group, a vector of pixels at a time; without kWide none is longer.
template <bool kTextured, bool kNeedle, bool kWide>
HWY_INLINE void FillRows(const TriangleJob& job, const Group& g, const Rows& rows, std::size_t i,
                         int count) {
  const VF lanes = hn::Set(f, static_cast<float>(hn::Lanes(f)));
  for (int r = 0; r < count; ++r) {
    const auto of_row = [&](const Rows::Values& values) { return hn::Set(f, values[r][i]); };
    std::uint32_t* at = job.pixels + rows.place[r][i];
    VF along = hn::Iota(f, 0.0F);
    float x = 0;
    do {
      DrawOver(pu, PixelsOf<kTextured, kNeedle>(job, g, rows, i, along, of_row), at);
      along = hn::Add(along, lanes);
      at += hn::Lanes(f);
      x += static_cast<float>(hn::Lanes(f));
    } while (kWide && x < rows.width[r][i]);
  }
}

/// The same for rows of at most kNarrow pixels, two at a time.
template <bool kTextured>
HWY_INLINE void FillPairsOfRows(const TriangleJob& job, const Group& g, const Rows& rows,
                                std::size_t i, int count) {
#if HWY_MAX_BYTES == 64
  const hn::Half<PU> row;
  const auto second = hn::Ge(hn::Iota(f, 0.0F), hn::Set(f, float{kNarrow}));
  const VF along =
      hn::Sub(hn::Iota(f, 0.0F), hn::IfThenElseZero(second, hn::Set(f, float{kNarrow})));
  for (int r = 0; r < count; r += 2) {
    const auto of_row = [&](const Rows::Values& values) {
      return hn::IfThenElse(second, hn::Set(f, values[r + 1][i]), hn::Set(f, values[r][i]));
    };
    const VU pixels = PixelsOf<kTextured, false>(job, g, rows, i, along, of_row);
    DrawOver(row, hn::LowerHalf(row, pixels), job.pixels + rows.place[r][i]);
    DrawOver(row, hn::UpperHalf(row, pixels), job.pixels + rows.place[r + 1][i]);
  }
#else
  FillRows<kTextured, false, false>(job, g, rows, i, count);
#endif
}

/// Draws the triangles of a batch and empties it.
template <bool kTextured>
void DrawBatch(const TriangleJob& job, Batch& batch) {
  Group group;
  Rows rows;
  for (std::size_t first = 0; first < batch.count; first += hn::Lanes(f)) {
    SetUp<kTextured>(job, batch, first, group);
    if (group.drawn == 0) continue;
    for (int row = 0; row < group.tallest; row += Rows::kMost) {
      FindRows<kTextured>(job, group, row, std::min(Rows::kMost, group.tallest - row), rows);
      for (std::uint64_t drawn = group.drawn; drawn; drawn &= drawn - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(drawn));
        const int count = std::min(Rows::kMost, group.height[i] - row);
        if (group.needles >> i & 1) [[unlikely]] {
          FillRows<kTextured, true, true>(job, group, rows, i, count);
        } else if (group.narrow >> i & 1) {
          FillPairsOfRows<kTextured>(job, group, rows, i, count);
        } else if (group.wide >> i & 1) {
          FillRows<kTextured, false, true>(job, group, rows, i, count);
        } else {
          FillRows<kTextured, false, false>(job, group, rows, i, count);
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
