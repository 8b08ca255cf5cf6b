// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Setup of faces, for each of Highway's targets: included by raster_fill-inl.h only.
#if defined(ANNEAL6D_RASTER_SETUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ANNEAL6D_RASTER_SETUP_INL_H_
#undef ANNEAL6D_RASTER_SETUP_INL_H_
#else
#define ANNEAL6D_RASTER_SETUP_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "raster_kernels.h"
#include "raster_outline-inl.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Vectors for rows of narrow faces: the widest take twice as long where processors work on them in
/// halves.
constexpr hn::CappedTag<float, 8> narrow;

/// Lanes for which a mask is true, as bits.
HWY_INLINE std::uint64_t BitsOf(hn::Mask<F> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(f, mask, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

/// Faces that wait to be drawn, four corners each, the last two of a triangle the same. Corners are
/// copied here whole and read back de-interleaved: gathering from the vertices would load each of
/// their numbers by itself.
struct Batch {
  static constexpr std::size_t kCapacity = 8 * kMostLanes;

  HWY_ALIGN ImageVertex vertex[4][kCapacity];
  HWY_ALIGN TexturePoint texture[4][kCapacity];
  std::size_t count = 0;
};

/// One corner of as many faces as a vector has lanes.
struct Corners {
  Point at;
  VF depth, grey, u, v;
};

template <bool kTextured>
HWY_INLINE Corners LoadCorners(const Batch& batch, int corner, std::size_t first) {
  Corners c;
  hn::LoadInterleaved4(f, &batch.vertex[corner][first].x, c.at.x, c.at.y, c.depth, c.grey);
  if constexpr (kTextured) {
    hn::LoadInterleaved2(f, &batch.texture[corner][first].u_over_z, c.u, c.v);
  }
  return c;
}

constexpr float kLeastArea = 1e-12F;  // square pixels; smaller faces are not drawn

/// A quantity that is linear in the image: its value at a face's first corner and its slopes. Those
/// along x also an entry a face.
struct Plane {
  VF value, dx, dy;
  HWY_ALIGN float step[kMostLanes];
};

/// 0 instead of infinity, which makes no numbers of planes.
HWY_INLINE VF Inverse(VF area) {
  const auto some = hn::Gt(hn::Abs(area), hn::Set(f, kLeastArea));
  return hn::IfThenElseZero(some, hn::Div(hn::Set(f, 1.0F), area));
}

/// The plane with these differences between the ends of two lines.
HWY_INLINE void SetPlane(VF value, Point line1, VF difference1, Point line2, VF difference2,
                         VF inv_area, Plane& plane) {
  plane.value = value;
  plane.dx = hn::Mul(hn::MulSub(difference1, line2.y, hn::Mul(difference2, line1.y)), inv_area);
  plane.dy = hn::Mul(hn::MulSub(difference2, line1.x, hn::Mul(difference1, line2.x)), inv_area);
}

/// The range of a quantity at the corners, an entry a face.
struct Limits {
  HWY_ALIGN float least[kMostLanes], most[kMostLanes];

  HWY_INLINE void Set(VF a, VF b, VF c, VF d) {
    hn::Store(hn::Min(hn::Min(a, b), hn::Min(c, d)), f, least);
    hn::Store(hn::Max(hn::Max(a, b), hn::Max(c, d)), f, most);
  }
};

/// What drawing a vector of faces needs.
struct Group {
  Outline outline;
  Point origin;  ///< first corner, where the planes' values are
  VF y_begin, y_end;
  HWY_ALIGN std::int32_t height[kMostLanes];  ///< rows of each face
  int tallest;
  std::uint64_t drawn;    ///< bits of the faces that have pixels
  std::uint64_t narrow;   ///< bits of those whose rows fit a narrow vector
  std::uint64_t wide;     ///< bits of those that may have rows longer than a vector
  std::uint64_t wider;    ///< bits of those that may have rows longer than two vectors
  std::uint64_t needles;  ///< bits of those whose slopes are not to be trusted
  Plane depth, u, v;
  /// Brightness bends at the diagonal. Both halves' planes meet there: it is the larger of both, or
  /// the smaller, which is the larger after a change of `sign`.
  Plane grey1, grey2;
  HWY_ALIGN float sign[kMostLanes];
  Limits depth_limits, grey_limits;
};

/// Planes of brightness. `single`: there is only the first half.
HWY_INLINE void SetUpGrey(const Corners& a, const Corners& b, const Corners& c, const Corners& d,
                          VF area1, VF area2, hn::Mask<F> single, Group& group) {
  const Point ab = b.at - a.at, ac = c.at - a.at, ad = d.at - a.at;
  const VF to_b = hn::Sub(b.grey, a.grey), to_c = hn::Sub(c.grey, a.grey);
  Plane& first = group.grey1;
  Plane& second = group.grey2;
  SetPlane(a.grey, ab, to_b, ac, to_c, Inverse(area1), first);
  SetPlane(a.grey, ac, to_c, ad, hn::Sub(d.grey, a.grey), Inverse(area2), second);
  second.dx = hn::IfThenElse(single, first.dx, second.dx);
  second.dy = hn::IfThenElse(single, first.dy, second.dy);
  const VF second_at_b = hn::MulAdd(ab.x, second.dx, hn::Mul(ab.y, second.dy));
  const VF sign = hn::IfThenElse(hn::Lt(to_b, second_at_b), hn::Set(f, -1.0F), hn::Set(f, 1.0F));
  for (Plane* plane : {&first, &second}) {
    plane->value = hn::Mul(plane->value, sign);
    plane->dx = hn::Mul(plane->dx, sign);
    plane->dy = hn::Mul(plane->dy, sign);
    hn::Store(plane->dx, f, plane->step);
  }
  hn::Store(sign, f, group.sign);
  group.grey_limits.Set(hn::Mul(a.grey, sign), hn::Mul(b.grey, sign), hn::Mul(c.grey, sign),
                        hn::Mul(d.grey, sign));
}

template <bool kTextured>
HWY_INLINE void SetUp(const TriangleJob& job, const Batch& batch, std::size_t first, Group& group) {
  const Corners a = LoadCorners<kTextured>(batch, 0, first);
  const Corners b = LoadCorners<kTextured>(batch, 1, first);
  const Corners c = LoadCorners<kTextured>(batch, 2, first);
  const Corners d = LoadCorners<kTextured>(batch, 3, first);
  Outline& outline = group.outline;
  outline = OutlineOf(a.at, b.at, c.at, d.at);

  // A pixel belongs to a face if its centre is inside, or on a left or upper border. Small faces
  // often lie between the centres.
  const auto limit = [](int pixels) { return hn::Set(f, static_cast<float>(pixels)); };
  const VF bottom = hn::Max(outline.far.y, outline.side.y);
  group.y_begin = hn::Ceil(hn::Max(outline.top.y, limit(job.y0)));
  group.y_end = hn::Ceil(hn::Min(bottom, limit(job.y1)));
  const VF left = hn::Min(hn::Min(a.at.x, b.at.x), hn::Min(c.at.x, d.at.x));
  const VF right = hn::Max(hn::Max(a.at.x, b.at.x), hn::Max(c.at.x, d.at.x));
  const VF columns =
      hn::Sub(hn::Ceil(hn::Min(right, limit(job.x1))), hn::Ceil(hn::Max(left, limit(job.x0))));
  const VF height = hn::Sub(group.y_end, group.y_begin);
  const Point ac = c.at - a.at, bd = d.at - b.at;
  const VF area = Cross(ac, bd);  // twice that of the face
  const auto drawn = hn::And(
      hn::And(hn::Gt(height, hn::Zero(f)), hn::Gt(columns, hn::Zero(f))),
      hn::And(hn::Gt(hn::Abs(area), hn::Set(f, kLeastArea)), hn::FirstN(f, batch.count - first)));
  group.drawn = BitsOf(drawn);
  if (group.drawn == 0) return;
  hn::Store(hn::ConvertTo(si, height), si, group.height);
  group.tallest =
      static_cast<int>(hn::GetLane(hn::MaxOfLanes(f, hn::IfThenElseZero(drawn, height))));

  // A little is left for roundings, which are not small where corners are far outside the image.
  const VF length2 = hn::Add(SquaredLength(ac), SquaredLength(bd));
  const auto near_by = hn::Lt(length2, hn::Set(f, 4096.0F * 4096.0F));
  const VF longest = LongestRow(outline);
  const auto with_rows_of = [&](std::size_t pixels) {
    const VF most = hn::Set(f, static_cast<float>(pixels) - 0.1F);
    return BitsOf(hn::And(near_by, hn::Lt(longest, most)));
  };
  group.narrow = with_rows_of(hn::MaxLanes(narrow));
  group.wide = ~with_rows_of(kMostLanes);
  group.wider = ~with_rows_of(2 * kMostLanes);

  // Roundings of the slopes below grow with the square of the length over the area.
  const VF area1 = Cross(b.at - a.at, ac), area2 = Cross(ac, d.at - a.at);
  const auto single = hn::And(hn::Eq(c.at.x, d.at.x), hn::Eq(c.at.y, d.at.y));
  const VF smaller = hn::Min(hn::Abs(area1), hn::Abs(hn::IfThenElse(single, area1, area2)));
  group.needles = BitsOf(hn::Lt(smaller, hn::Mul(length2, hn::Set(f, 1e-3F))));
  group.origin = a.at;
  const VF inv_area = Inverse(area);
  const auto interpolate = [&](VF at_a, VF at_b, VF at_c, VF at_d, Plane& plane) {
    SetPlane(at_a, ac, hn::Sub(at_c, at_a), bd, hn::Sub(at_d, at_b), inv_area, plane);
    hn::Store(plane.dx, f, plane.step);
  };
  interpolate(a.depth, b.depth, c.depth, d.depth, group.depth);
  group.depth_limits.Set(a.depth, b.depth, c.depth, d.depth);
  SetUpGrey(a, b, c, d, area1, area2, single, group);
  if constexpr (kTextured) {
    interpolate(a.u, b.u, c.u, d.u, group.u);
    interpolate(a.v, b.v, c.v, d.v, group.v);
  }
}

/// A row of each face of a group: where it begins, its width, and the values at its first pixel.
/// Together, since an array for each would have all that belongs to a row in one set of the cache.
struct Row {
  using Values = float[kMostLanes];

  HWY_ALIGN std::int32_t place[kMostLanes];  ///< in the drawing
  HWY_ALIGN Values width, depth, grey1, grey2, u, v;
};

/// Finds rows `first`, ... of all faces of a group, a lane a face. Those behind its last
/// row have no pixels.
template <bool kTextured>
HWY_INLINE void FindRows(const TriangleJob& job, const Group& g, int first, int count, Row* rows) {
  const Outline& o = g.outline;
  const VF left_limit = hn::Set(f, static_cast<float>(job.x0));
  const VF right_limit = hn::Set(f, static_cast<float>(job.x1));
  const auto row_place = hn::Set(si, job.stride);
  const VF one = hn::Set(f, 1.0F);
  VF y = hn::Add(g.y_begin, hn::Set(f, static_cast<float>(first)));
  auto place = hn::Mul(hn::Sub(hn::ConvertTo(si, y), hn::Set(si, job.y0)), row_place);
  place = hn::Sub(place, hn::Set(si, job.x0));
  for (Row& row : std::span(rows, static_cast<std::size_t>(count))) {
    const VF last = LineAt(o.last, o.far_side, y);
    const VF near =
        hn::IfThenElse(hn::Lt(y, o.near.y), LineAt(o.top, o.top_near, y),
                       hn::IfThenElse(hn::Lt(y, o.near_end), LineAt(o.near, o.near_far, y), last));
    const VF side = hn::IfThenElse(hn::Lt(y, o.side_end), LineAt(o.top, o.top_side, y), last);
    const auto above_end = hn::Lt(y, g.y_end);
    const VF begin = hn::IfThenElse(
        above_end, hn::Min(hn::Ceil(hn::Max(hn::Min(near, side), left_limit)), right_limit),
        left_limit);
    const VF end =
        hn::IfThenElseZero(above_end, hn::Ceil(hn::Min(hn::Max(near, side), right_limit)));
    const VF dx = hn::Sub(begin, g.origin.x), dy = hn::Sub(y, g.origin.y);
    const auto value = [&](const Plane& plane) {
      return hn::MulAdd(dx, plane.dx, hn::MulAdd(dy, plane.dy, plane.value));
    };
    hn::Store(hn::Add(place, hn::ConvertTo(si, begin)), si, row.place);
    hn::Store(hn::Sub(end, begin), f, row.width);
    hn::Store(value(g.depth), f, row.depth);
    hn::Store(value(g.grey1), f, row.grey1);
    hn::Store(value(g.grey2), f, row.grey2);
    if constexpr (kTextured) {
      hn::Store(value(g.u), f, row.u);
      hn::Store(value(g.v), f, row.v);
    }
    y = hn::Add(y, one);
    place = hn::Add(place, row_place);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#endif
