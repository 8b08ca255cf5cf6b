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

using PI = hn::RebindToSigned<PF>;
using PU = hn::RebindToUnsigned<PF>;
using VP = hn::Vec<PF>;
constexpr PI pi;
constexpr PU pu;

/// Bilinear texture brightness at texture coordinates u, v with repeat.
HWY_INLINE VP SampleTexture(const QuadTexture& texture, VP u, VP v) {
  const auto wrap = [](VP t, int size, hn::Vec<PI>& cell, VP& fraction) {
    const VP extent = hn::Set(pf, static_cast<float>(size));
    const VP position = hn::MulSub(hn::Sub(t, hn::Floor(t)), extent, hn::Set(pf, 0.5F));
    const VP floor = hn::Floor(position);
    fraction = hn::Sub(position, floor);
    const auto index = hn::ConvertTo(pi, floor);
    const auto wrapped = hn::IfThenElse(hn::Lt(index, hn::Zero(pi)), hn::Set(pi, size - 1), index);
    cell = hn::Min(wrapped, hn::Set(pi, size - 1));
  };
  hn::Vec<PI> column, row;
  VP across, down;
  wrap(u, texture.width, column, across);
  wrap(v, texture.height, row, down);
  const auto index = hn::Add(hn::Mul(row, hn::Set(pi, texture.width)), column);
  const auto quad = hn::GatherIndex(pu, texture.quads.data(), index);
  const auto byte = hn::Set(pu, 0xFF);
  const auto texel = [&](auto bits) {
    return hn::ConvertTo(pf, hn::BitCast(pi, hn::And(bits, byte)));
  };
  const VP t00 = texel(quad), t10 = texel(hn::ShiftRight<8>(quad));
  const VP t01 = texel(hn::ShiftRight<16>(quad)), t11 = texel(hn::ShiftRight<24>(quad));
  const VP upper = hn::MulAdd(hn::Sub(t10, t00), across, t00);
  const VP lower = hn::MulAdd(hn::Sub(t11, t01), across, t01);
  return hn::MulAdd(hn::Sub(lower, upper), down, upper);
}

/// Fills rows of triangle i of a group, a vector of pixels at a time.
template <bool kTextured, bool kNeedle>
HWY_INLINE void FillRows(const TriangleJob& job, const Group& g, const Rows& rows, std::size_t i,
                         int count) {
  const VP lanes = hn::Set(pf, static_cast<float>(hn::Lanes(pf)));
  const VP depth_step = hn::Set(pf, g.depth.step[i]), grey_step = hn::Set(pf, g.grey.step[i]);
  const bool wide = g.wide >> i & 1;
  for (int r = 0; r < count; ++r) {
    std::uint32_t* at = job.pixels + rows.place[r][i];
    const float width = rows.width[r][i];
    VP along = hn::Iota(pf, 0.0F);
    float x = 0;
    do {
      VP depth = hn::MulAdd(along, depth_step, hn::Set(pf, rows.depth[r][i]));
      VP grey = hn::MulAdd(along, grey_step, hn::Set(pf, rows.grey[r][i]));
      if constexpr (kNeedle) {
        const auto clamp = [&](VP value, const Planes& planes) {
          return hn::Min(hn::Max(value, hn::Set(pf, planes.least[i])), hn::Set(pf, planes.most[i]));
        };
        depth = clamp(depth, g.depth);
        grey = clamp(grey, g.grey);
      }
      if constexpr (kTextured) {
        const VP inv_z = hn::MulAdd(hn::Sub(depth, hn::Set(pf, kFarDepth)),
                                    hn::Set(pf, 1.0F / job.depth_scale), hn::Set(pf, job.inv_far));
        const VP z_mm = hn::Div(hn::Set(pf, 1.0F), inv_z);
        const VP u = hn::MulAdd(along, hn::Set(pf, g.u.step[i]), hn::Set(pf, rows.u[r][i]));
        const VP v = hn::MulAdd(along, hn::Set(pf, g.v.step[i]), hn::Set(pf, rows.v[r][i]));
        grey = hn::Mul(grey, SampleTexture(*job.texture, hn::Mul(u, z_mm), hn::Mul(v, z_mm)));
      }
      // Adding 1.5 * 2^23 leaves the rounded number in the lowest bits, for a third of the price of
      // the conversion. Nearer is larger: the depth test is a maximum.
      const auto rounded = hn::BitCast(pu, hn::Add(grey, hn::Set(pf, 12582912.0F)));
      const auto pixel =
          hn::OrAnd(hn::ShiftLeft<8>(hn::BitCast(pu, depth)), rounded, hn::Set(pu, 0xFF));
      const auto inside = hn::RebindMask(pu, hn::Lt(along, hn::Set(pf, width)));
      hn::StoreU(hn::Max(hn::LoadU(pu, at), hn::IfThenElseZero(inside, pixel)), pu, at);
      along = hn::Add(along, lanes);
      at += hn::Lanes(pf);
      x += static_cast<float>(hn::Lanes(pf));
    } while (wide && x < width);
  }
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
          FillRows<kTextured, true>(job, group, rows, i, count);
        } else {
          FillRows<kTextured, false>(job, group, rows, i, count);
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
