// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Setup of triangles, for each of Highway's targets: included by raster_fill-inl.h only.
#if defined(ANNEAL6D_RASTER_SETUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ANNEAL6D_RASTER_SETUP_INL_H_
#undef ANNEAL6D_RASTER_SETUP_INL_H_
#else
#define ANNEAL6D_RASTER_SETUP_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "raster_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
constexpr F f;
constexpr I si;
constexpr std::size_t kMostLanes = hn::MaxLanes(f);

// Pixels of a row that are filled at a time in narrow triangles, and how many such rows a vector
// has room for.
constexpr int kNarrow = std::min<int>(8, kMostLanes);
constexpr int kRowsAtOnce = static_cast<int>(kMostLanes) / kNarrow;

/// Lanes for which a mask is true, as bits.
HWY_INLINE std::uint64_t BitsOf(hn::Mask<F> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(f, mask, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

/// Triangles that wait to be drawn. Corners are copied here whole and read back de-interleaved:
/// gathering from the vertices would load each of their numbers by itself.
struct Batch {
  static constexpr std::size_t kCapacity = 4 * kMostLanes;

  HWY_ALIGN ImageVertex vertex[3][kCapacity];
  HWY_ALIGN TexturePoint texture[3][kCapacity];
  std::size_t count = 0;
};

/// One corner of as many triangles as a vector has lanes.
struct Corners {
  VF x, y, depth, grey, u, v;
};

template <bool kTextured>
HWY_INLINE Corners LoadCorners(const Batch& batch, int corner, std::size_t first) {
  Corners c;
  hn::LoadInterleaved4(f, &batch.vertex[corner][first].x, c.x, c.y, c.depth, c.grey);
  if constexpr (kTextured) {
    hn::LoadInterleaved2(f, &batch.texture[corner][first].u_over_z, c.u, c.v);
  }
  return c;
}

template <bool kTextured>
HWY_INLINE void SortByHeight(Corners& upper, Corners& lower) {
  const auto wrong = hn::Gt(upper.y, lower.y);
  const auto swap = [&](VF& a, VF& b) {
    const VF kept = a;
    a = hn::IfThenElse(wrong, b, a);
    b = hn::IfThenElse(wrong, kept, b);
  };
  swap(upper.x, lower.x);
  swap(upper.y, lower.y);
  swap(upper.depth, lower.depth);
  swap(upper.grey, lower.grey);
  if constexpr (kTextured) {
    swap(upper.u, lower.u);
    swap(upper.v, lower.v);
  }
}

/// A quantity that is linear in the image: its value at the top corner and its slopes. Those along
/// x, and the range at the corners, also an entry a triangle.
struct Planes {
  VF top, dy, dx;
  HWY_ALIGN float step[kMostLanes], least[kMostLanes], most[kMostLanes];
};

/// What drawing a vector of triangles needs: the edges as lines x = start + slope * (y - y of the
/// upper end), and what is interpolated.
struct Group {
  Corners top, middle, bottom;
  VF long_slope, upper_slope, lower_slope;
  VF y_begin, y_end;
  HWY_ALIGN std::int32_t height[kMostLanes];  ///< rows of each triangle
  int tallest;
  std::uint64_t drawn;    ///< bits of the triangles that have pixels
  std::uint64_t narrow;   ///< bits of those whose rows have at most kNarrow pixels
  std::uint64_t wide;     ///< bits of those that may have rows longer than a vector
  std::uint64_t needles;  ///< bits of those whose slopes are not to be trusted
  Planes depth, grey, u, v;
};

template <bool kTextured>
HWY_INLINE void SetUp(const TriangleJob& job, const Batch& batch, std::size_t first, Group& group) {
  Corners& top = group.top;
  Corners& middle = group.middle;
  Corners& bottom = group.bottom;
  top = LoadCorners<kTextured>(batch, 0, first);
  middle = LoadCorners<kTextured>(batch, 1, first);
  bottom = LoadCorners<kTextured>(batch, 2, first);
  SortByHeight<kTextured>(top, middle);
  SortByHeight<kTextured>(middle, bottom);
  SortByHeight<kTextured>(top, middle);

  // A pixel belongs to a triangle if its centre is inside, or on a left or upper border. Small
  // triangles often lie between the centres.
  const auto limit = [](int pixels) { return hn::Set(f, static_cast<float>(pixels)); };
  group.y_begin = hn::Ceil(hn::Max(top.y, limit(job.y0)));
  group.y_end = hn::Ceil(hn::Min(bottom.y, limit(job.y1)));
  const VF left = hn::Min(top.x, hn::Min(middle.x, bottom.x));
  const VF right = hn::Max(top.x, hn::Max(middle.x, bottom.x));
  const VF columns =
      hn::Sub(hn::Ceil(hn::Min(right, limit(job.x1))), hn::Ceil(hn::Max(left, limit(job.x0))));
  const VF e1x = hn::Sub(middle.x, top.x), e1y = hn::Sub(middle.y, top.y);
  const VF e2x = hn::Sub(bottom.x, top.x), e2y = hn::Sub(bottom.y, top.y);
  const VF area = hn::MulSub(e1x, e2y, hn::Mul(e2x, e1y));
  const VF height = hn::Sub(group.y_end, group.y_begin);
  const auto drawn = hn::And(
      hn::And(hn::Gt(height, hn::Zero(f)), hn::Gt(columns, hn::Zero(f))),
      hn::And(hn::Gt(hn::Abs(area), hn::Set(f, 1e-12F)), hn::FirstN(f, batch.count - first)));
  group.drawn = BitsOf(drawn);
  if (group.drawn == 0) return;
  hn::Store(hn::ConvertTo(si, height), si, group.height);
  // The longest row is at the middle corner. A little is left for roundings, which are not small
  // where corners are far outside the image.
  const VF length2 =
      hn::MulAdd(e1x, e1x, hn::MulAdd(e1y, e1y, hn::MulAdd(e2x, e2x, hn::Mul(e2y, e2y))));
  const auto near_by = hn::Lt(length2, hn::Set(f, 4096.0F * 4096.0F));
  const auto with_rows_of = [&](std::size_t pixels) {
    const VF most = hn::Mul(e2y, hn::Set(f, static_cast<float>(pixels) - 0.1F));
    return BitsOf(hn::And(near_by, hn::Lt(hn::Abs(area), most)));
  };
  group.narrow = with_rows_of(kNarrow);
  group.wide = ~with_rows_of(kMostLanes);
  group.tallest =
      static_cast<int>(hn::GetLane(hn::MaxOfLanes(f, hn::IfThenElseZero(drawn, height))));

  // Neighbours must agree on their common edge to the last bit: every edge is described from its
  // upper end and by the same operations, whichever side of its triangle it is.
  group.long_slope = hn::Div(e2x, e2y);
  group.upper_slope = hn::Div(e1x, e1y);
  group.lower_slope = hn::Div(hn::Sub(bottom.x, middle.x), hn::Sub(bottom.y, middle.y));

  // Roundings of the slopes below grow with the square of the length over the area.
  group.needles = BitsOf(hn::Lt(hn::Abs(area), hn::Mul(length2, hn::Set(f, 1e-3F))));
  const VF inv_area = hn::Div(hn::Set(f, 1.0F), area);
  const auto interpolate = [&](VF a, VF b, VF c, Planes& planes) {
    const VF ab = hn::Sub(b, a), ac = hn::Sub(c, a);
    planes.top = a;
    planes.dx = hn::Mul(hn::MulSub(ab, e2y, hn::Mul(ac, e1y)), inv_area);
    planes.dy = hn::Mul(hn::MulSub(ac, e1x, hn::Mul(ab, e2x)), inv_area);
    hn::Store(planes.dx, f, planes.step);
    hn::Store(hn::Min(a, hn::Min(b, c)), f, planes.least);
    hn::Store(hn::Max(a, hn::Max(b, c)), f, planes.most);
  };
  interpolate(top.depth, middle.depth, bottom.depth, group.depth);
  interpolate(top.grey, middle.grey, bottom.grey, group.grey);
  if constexpr (kTextured) {
    interpolate(top.u, middle.u, bottom.u, group.u);
    interpolate(top.v, middle.v, bottom.v, group.v);
  }
}

/// Some rows of a group of triangles: where each begins, its width, and the values at its first
/// pixel.
struct Rows {
  static constexpr int kMost = 64;
  static_assert(kMost % kRowsAtOnce == 0);

  using Values = float[kMost][kMostLanes];

  HWY_ALIGN std::int32_t place[kMost][kMostLanes];  ///< in the drawing
  HWY_ALIGN Values width, depth, grey, u, v;
};

/// Finds rows `first`, ... of all triangles of a group, a lane a triangle. Those behind its last
/// row have no pixels.
template <bool kTextured>
HWY_INLINE void FindRows(const TriangleJob& job, const Group& g, int first, int count, Rows& rows) {
  const VF left_limit = hn::Set(f, static_cast<float>(job.x0));
  const VF right_limit = hn::Set(f, static_cast<float>(job.x1));
  const auto row_place = hn::Set(si, job.stride);
  const VF one = hn::Set(f, 1.0F);
  VF row = hn::Add(g.y_begin, hn::Set(f, static_cast<float>(first)));
  auto place = hn::Mul(hn::Sub(hn::ConvertTo(si, row), hn::Set(si, job.y0)), row_place);
  place = hn::Sub(place, hn::Set(si, job.x0));
  const int whole = (count + kRowsAtOnce - 1) / kRowsAtOnce * kRowsAtOnce;
  for (int r = 0; r < whole; ++r) {
    const VF dy = hn::Sub(row, g.top.y);
    const VF long_x = hn::MulAdd(dy, g.long_slope, g.top.x);
    const VF short_x =
        hn::IfThenElse(hn::Lt(row, g.middle.y), hn::MulAdd(dy, g.upper_slope, g.top.x),
                       hn::MulAdd(hn::Sub(row, g.middle.y), g.lower_slope, g.middle.x));
    const auto above_end = hn::Lt(row, g.y_end);
    const VF begin = hn::IfThenElse(
        above_end, hn::Min(hn::Ceil(hn::Max(hn::Min(long_x, short_x), left_limit)), right_limit),
        left_limit);
    const VF end =
        hn::IfThenElseZero(above_end, hn::Ceil(hn::Min(hn::Max(long_x, short_x), right_limit)));
    const VF dx = hn::Sub(begin, g.top.x);
    const auto value = [&](const Planes& planes) {
      return hn::MulAdd(dx, planes.dx, hn::MulAdd(dy, planes.dy, planes.top));
    };
    hn::Store(hn::Add(place, hn::ConvertTo(si, begin)), si, rows.place[r]);
    hn::Store(hn::Sub(end, begin), f, rows.width[r]);
    hn::Store(value(g.depth), f, rows.depth[r]);
    hn::Store(value(g.grey), f, rows.grey[r]);
    if constexpr (kTextured) {
      hn::Store(value(g.u), f, rows.u[r]);
      hn::Store(value(g.v), f, rows.v[r]);
    }
    row = hn::Add(row, one);
    place = hn::Add(place, row_place);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#endif
