// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "region_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "region_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, ColourJob::kPadding>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;

// Where colours are looked up, from the silhouette to both sides, pixels.
constexpr float kDistances_px[] = {3.0F, 8.0F, 16.0F};

/// Odds at places of the image, 0 outside the picture.
VI OddsAt(const ColourJob& job, VF x, VF y) {
  constexpr F f;
  constexpr I si;
  const VF half = hn::Set(f, 0.5F);
  const VF column = hn::Mul(x, half), row = hn::Mul(y, half);
  // False for NaN.
  const auto inside = hn::And(
      hn::And(hn::Ge(column, hn::Zero(f)),
              hn::Lt(column, hn::Set(f, static_cast<float>(job.columns)))),
      hn::And(hn::Ge(row, hn::Zero(f)), hn::Lt(row, hn::Set(f, static_cast<float>(job.rows)))));
  const VI u = hn::ConvertTo(si, hn::IfThenElseZero(inside, column));
  const VI v = hn::ConvertTo(si, hn::IfThenElseZero(inside, row));
  const VI place = hn::Add(hn::Mul(v, hn::Set(si, job.columns)), u);
  // Four bytes from the place on; the lowest is the one.
  const VI four = hn::GatherOffset(si, reinterpret_cast<const std::int32_t*>(job.log_odds), place);
  return hn::IfThenElseZero(hn::RebindMask(si, inside),
                            hn::ShiftRight<24>(hn::ShiftLeft<24>(four)));
}

float CompareColours(const ColourJob& job) {
  constexpr F f;
  constexpr I si;
  const float* const r = job.rotation;
  const VF one = hn::Set(f, 1.0F);
  const VF fx = hn::Set(f, job.fx), fy = hn::Set(f, job.fy);
  VF sum = hn::Zero(f);
  std::size_t visible_count = 0;
  for (std::size_t i = 0; i < job.count; i += hn::Lanes(f)) {
    const auto row = [&](int k, VF x, VF y, VF z) {
      return hn::MulAdd(hn::Set(f, r[k]), x,
                        hn::MulAdd(hn::Set(f, r[k + 1]), y, hn::Mul(hn::Set(f, r[k + 2]), z)));
    };
    const VF x = hn::LoadU(f, job.x + i), y = hn::LoadU(f, job.y + i), z = hn::LoadU(f, job.z + i);
    const VF depth = hn::Add(row(6, x, y, z), hn::Set(f, job.translation_mm[2]));
    const VF inv_z = hn::Div(one, depth);
    const VF x_z = hn::Mul(hn::Add(row(0, x, y, z), hn::Set(f, job.translation_mm[0])), inv_z);
    const VF y_z = hn::Mul(hn::Add(row(3, x, y, z), hn::Set(f, job.translation_mm[1])), inv_z);
    const VF u = hn::MulAdd(fx, x_z, hn::Set(f, job.cx));
    const VF v = hn::MulAdd(fy, y_z, hn::Set(f, job.cy));
    // How the normal looks in the image.
    const VF nx = hn::LoadU(f, job.nx + i), ny = hn::LoadU(f, job.ny + i);
    const VF nz = hn::LoadU(f, job.nz + i);
    const VF n_depth = row(6, nx, ny, nz);
    const VF across_u = hn::Mul(fx, hn::NegMulAdd(x_z, n_depth, row(0, nx, ny, nz)));
    const VF across_v = hn::Mul(fy, hn::NegMulAdd(y_z, n_depth, row(3, nx, ny, nz)));
    const VF length = hn::Sqrt(hn::MulAdd(across_u, across_u, hn::Mul(across_v, across_v)));
    const VF step_u = hn::Div(across_u, length), step_v = hn::Div(across_v, length);
    const VF px_per_mm = hn::Mul(length, inv_z);
    const VF inside_px = hn::Mul(hn::LoadU(f, job.inside + i), px_per_mm);
    const VF outside_px = hn::Mul(hn::LoadU(f, job.outside + i), px_per_mm);

    VI contrast = hn::Zero(si);
    for (const float distance_px : kDistances_px) {
      const VF in = hn::Min(hn::Set(f, distance_px), inside_px);
      const VF out = hn::Min(hn::Set(f, distance_px), outside_px);
      contrast = hn::Add(contrast,
                         OddsAt(job, hn::NegMulAdd(in, step_u, u), hn::NegMulAdd(in, step_v, v)));
      contrast =
          hn::Sub(contrast, OddsAt(job, hn::MulAdd(out, step_u, u), hn::MulAdd(out, step_v, v)));
    }
    const auto visible = hn::Ge(depth, hn::Set(f, job.near_mm));  // false for NaN
    const VF certainty = hn::Mul(hn::ConvertTo(f, contrast), hn::Set(f, 1.0F / job.clear));
    sum = hn::Add(sum, hn::IfThenElseZero(visible, hn::Max(hn::Neg(one), hn::Min(one, certainty))));
    visible_count += hn::CountTrue(f, visible);
  }
  if (visible_count == 0) return 0;
  return hn::GetLane(hn::SumOfLanes(f, sum)) / static_cast<float>(visible_count);
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(CompareColours);
float compare_colours(const ColourJob& job) { return HWY_DYNAMIC_DISPATCH(CompareColours)(job); }

}  // namespace anneal6d
#endif
