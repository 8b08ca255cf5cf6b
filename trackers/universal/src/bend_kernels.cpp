// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "bend_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bend_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kLongestVector>;
using VF = hn::Vec<F>;

void ClearBorder(const BendJob& job, int width, float* picture) {
  const std::ptrdiff_t columns = job.columns, rows = job.rows;
  std::fill_n(picture, width * columns, 0.0F);
  std::fill_n(picture + (rows - width) * columns, width * columns, 0.0F);
  for (std::ptrdiff_t y = width; y < rows - width; ++y) {
    std::fill_n(picture + y * columns, width, 0.0F);
    std::fill_n(picture + (y + 1) * columns - width, width, 0.0F);
  }
}

/// Calls `vector(x, y)` for the first pixels of vectors that cover all but the border. The last
/// vector of a row takes some pixels again.
template <class Vector>
void ForEachInside(const BendJob& job, int border, const Vector& vector) {
  const int lanes = static_cast<int>(hn::Lanes(F()));
  const int last = job.columns - border - lanes;
  for (int y = border; y < job.rows - border; ++y) {
    for (int x = border; x < last; x += lanes) vector(x, y);
    vector(last, y);
  }
}

void FindNormals(const BendJob& job) {
  constexpr F f;
  for (float* const normal : job.normals) ClearBorder(job, 1, normal);
  const VF fx = hn::Set(f, job.fx), fy = hn::Set(f, job.fy), half = hn::Set(f, 0.5F);
  const VF jump = hn::Set(f, job.jump_mm);
  ForEachInside(job, 1, [&](int x, int y) HWY_ATTR {
    const float* const here = job.depth_mm + y * job.depth_stride + x;
    const VF z = hn::LoadU(f, here);
    const VF left = hn::LoadU(f, here - 1), right = hn::LoadU(f, here + 1);
    const VF above = hn::LoadU(f, here - job.depth_stride);
    const VF below = hn::LoadU(f, here + job.depth_stride);
    // The cross product of the surface's derivatives along x and y.
    const VF u = hn::Add(hn::Iota(f, 0.0F), hn::Set(f, static_cast<float>(x) - job.cx));
    const VF v = hn::Set(f, static_cast<float>(y) - job.cy);
    const VF zx = hn::Mul(half, hn::Sub(right, left)), zy = hn::Mul(half, hn::Sub(below, above));
    const VF nx = hn::Neg(hn::Mul(fx, zx)), ny = hn::Neg(hn::Mul(fy, zy));
    const VF nz = hn::MulAdd(zx, u, hn::MulAdd(zy, v, z));
    const VF step = hn::Max(hn::Max(hn::AbsDiff(left, z), hn::AbsDiff(right, z)),
                            hn::Max(hn::AbsDiff(above, z), hn::AbsDiff(below, z)));
    const VF length = hn::Sqrt(hn::MulAdd(nx, nx, hn::MulAdd(ny, ny, hn::Mul(nz, nz))));
    const auto surface = hn::And(hn::Gt(z, hn::Zero(f)), hn::Lt(step, jump));
    const VF scale = hn::IfThenElseZero(surface, hn::Div(hn::Set(f, 1.0F), length));
    const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(y) * job.columns + x;
    hn::StoreU(hn::Mul(nx, scale), f, job.normals[0] + place);
    hn::StoreU(hn::Mul(ny, scale), f, job.normals[1] + place);
    hn::StoreU(hn::Mul(nz, scale), f, job.normals[2] + place);
  });
}

void FindTurns(const BendJob& job) {
  constexpr F f;
  ClearBorder(job, BendJob::kReach_px, job.turns);
  const std::ptrdiff_t aside = BendJob::kReach_px, down = aside * job.columns;
  const VF half = hn::Set(f, 0.5F);
  ForEachInside(job, BendJob::kReach_px, [&](int x, int y) HWY_ATTR {
    const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(y) * job.columns + x;
    VF xx = hn::Zero(f), yy = hn::Zero(f), xy = hn::Zero(f), least = hn::Zero(f);
    for (const float* const normal : job.normals) {
      const VF left = hn::LoadU(f, normal + place - aside);
      const VF right = hn::LoadU(f, normal + place + aside);
      const VF above = hn::LoadU(f, normal + place - down);
      const VF below = hn::LoadU(f, normal + place + down);
      const VF along_x = hn::Sub(right, left), along_y = hn::Sub(below, above);
      xx = hn::MulAdd(along_x, along_x, xx);
      yy = hn::MulAdd(along_y, along_y, yy);
      xy = hn::MulAdd(along_x, along_y, xy);
      // Of z, at last: normals have one; where there is none there is no surface.
      least =
          hn::Min(hn::Min(hn::Abs(left), hn::Abs(right)), hn::Min(hn::Abs(above), hn::Abs(below)));
    }
    // The larger eigenvalue of the structure tensor.
    const VF skew = hn::Mul(half, hn::Sub(xx, yy));
    const VF root = hn::Sqrt(hn::MulAdd(skew, skew, hn::Mul(xy, xy)));
    const VF turn = hn::Sqrt(hn::MulAdd(half, hn::Add(xx, yy), root));
    hn::StoreU(
        hn::IfThenElseZero(hn::Gt(least, hn::Zero(f)), hn::Max(turn, hn::Set(f, BendJob::kFlat))),
        f, job.turns + place);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(FindNormals);
void find_normals(const BendJob& job) { HWY_DYNAMIC_DISPATCH(FindNormals)(job); }

HWY_EXPORT(FindTurns);
void find_turns(const BendJob& job) { HWY_DYNAMIC_DISPATCH(FindTurns)(job); }

}  // namespace anneal6d
#endif
