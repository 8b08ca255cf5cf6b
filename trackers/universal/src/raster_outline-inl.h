// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Outlines of faces, for each of Highway's targets: included by raster_setup-inl.h only.
#if defined(ANNEAL6D_RASTER_OUTLINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ANNEAL6D_RASTER_OUTLINE_INL_H_
#undef ANNEAL6D_RASTER_OUTLINE_INL_H_
#else
#define ANNEAL6D_RASTER_OUTLINE_INL_H_
#endif

#include <hwy/highway.h>

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

/// A point in each of as many faces as a vector has lanes.
struct Point {
  VF x, y;
};

HWY_INLINE Point operator-(Point a, Point b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y)}; }
HWY_INLINE VF Cross(Point a, Point b) { return hn::MulSub(a.x, b.y, hn::Mul(b.x, a.y)); }
HWY_INLINE VF Slope(Point a) { return hn::Div(a.x, a.y); }
HWY_INLINE VF SquaredLength(Point a) { return hn::MulAdd(a.x, a.x, hn::Mul(a.y, a.y)); }
HWY_INLINE Point Choose(hn::Mask<F> first, Point a, Point b) {
  return {hn::IfThenElse(first, a.x, b.x), hn::IfThenElse(first, a.y, b.y)};
}

/// A quadrilateral's corners in turn, from its top; of the top's two neighbours `near` is the upper
/// and `side` the lower. Two edges lead down from the top: at `near` the first is followed by the
/// one to `far`. The fourth edge joins `far` and `side`, one of which is the bottom, and follows
/// the edge that ends at the upper of them. All are lines x = start + slope * (y - y of the upper
/// end). In triangles two neighbouring corners are the same.
struct Outline {
  Point top, near, far, side;
  Point last;                                 ///< the upper of `far` and `side`
  VF near_end, side_end;                      ///< where the last edge takes over, or nowhere
  VF top_near, near_far, top_side, far_side;  ///< slopes
};

HWY_INLINE VF LineAt(Point start, VF slope, VF y) {
  return hn::MulAdd(hn::Sub(y, start.y), slope, start.x);
}

/// The outline of a, b, c, d.
HWY_INLINE Outline OutlineOf(Point a, Point b, Point c, Point d) {
  const auto swap = [](hn::Mask<F> wrong, Point& p, Point& q) {
    const Point kept = p;
    p = Choose(wrong, q, p);
    q = Choose(wrong, kept, q);
  };
  // Turned until the top comes first, and the lower of its neighbours last.
  const auto opposite = hn::Lt(hn::Min(c.y, d.y), hn::Min(a.y, b.y));
  swap(opposite, a, c);
  swap(opposite, b, d);
  const auto next = hn::Lt(b.y, a.y);
  swap(next, a, b);
  swap(next, c, d);
  swap(hn::Gt(b.y, d.y), b, d);

  Outline o;
  o.top = a;
  o.near = b;
  o.far = c;
  o.side = d;
  const auto far_ends = hn::Le(c.y, d.y);
  const VF nowhere = hn::Set(f, 1e30F);
  o.last = Choose(far_ends, c, d);
  o.near_end = hn::IfThenElse(far_ends, c.y, nowhere);
  o.side_end = hn::IfThenElse(far_ends, nowhere, d.y);
  // Neighbours must agree on their common edge to the last bit: every edge is described from its
  // upper end and by the same operations, whichever side of its face it is.
  o.top_near = Slope(b - a);
  o.near_far = Slope(c - b);
  o.top_side = Slope(d - a);
  o.far_side = Slope(d - c);
  return o;
}

/// The length of the longest row, which is at a corner.
HWY_INLINE VF LongestRow(const Outline& o) {
  const VF at_near = hn::Sub(o.near.x, LineAt(o.top, o.top_side, o.near.y));
  const VF other = hn::IfThenElse(hn::Le(o.far.y, o.side.y), LineAt(o.top, o.top_side, o.far.y),
                                  LineAt(o.near, o.near_far, o.side.y));
  return hn::Max(hn::Abs(at_near), hn::Abs(hn::Sub(o.last.x, other)));
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#endif
