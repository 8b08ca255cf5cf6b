// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "sparse_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sparse_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kLongestVector>;
using I = hn::RebindToSigned<F>;
using U = hn::RebindToUnsigned<F>;
using VF = hn::Vec<F>;

void LookUp(LookUpJob& job) {
  constexpr F f;
  constexpr I si;
  constexpr U ui;
  const float* const r = job.rotation;
  const VF half = hn::Set(f, 0.5F);
  const VF width = hn::Set(f, static_cast<float>(job.width));
  const VF height = hn::Set(f, static_cast<float>(job.height));
  std::size_t inside_count = 0, edge_count = 0;
  for (std::size_t i = 0; i < job.count; i += hn::Lanes(f)) {
    const VF x = hn::LoadU(f, job.x + i), y = hn::LoadU(f, job.y + i), z = hn::LoadU(f, job.z + i);
    const auto row = [&](int k, float offset) {
      return hn::MulAdd(hn::Set(f, r[k]), x,
                        hn::MulAdd(hn::Set(f, r[k + 1]), y,
                                   hn::MulAdd(hn::Set(f, r[k + 2]), z, hn::Set(f, offset))));
    };
    const VF depth = row(6, job.translation_mm[2]);
    const VF inv_z = hn::Div(hn::Set(f, 1.0F), depth);
    // Half a pixel on, so that cutting off the fraction rounds.
    const VF column = hn::Add(hn::MulAdd(hn::Mul(row(0, job.translation_mm[0]), hn::Set(f, job.fx)),
                                         inv_z, hn::Set(f, job.cx)),
                              half);
    const VF line = hn::Add(hn::MulAdd(hn::Mul(row(3, job.translation_mm[1]), hn::Set(f, job.fy)),
                                       inv_z, hn::Set(f, job.cy)),
                            half);
    // False for NaN.
    const auto inside =
        hn::And(hn::And(hn::Ge(depth, hn::Set(f, job.near_mm)),
                        hn::And(hn::Ge(column, hn::Zero(f)), hn::Lt(column, width))),
                hn::And(hn::Ge(line, hn::Zero(f)), hn::Lt(line, height)));
    const auto u = hn::ConvertTo(si, hn::IfThenElseZero(inside, column));
    const auto v = hn::ConvertTo(si, hn::IfThenElseZero(inside, line));
    const auto word = hn::Add(hn::Mul(v, hn::Set(si, job.words)), hn::ShiftRight<5>(u));
    const auto bits = hn::GatherIndex(ui, job.edges, word);
    const auto place = hn::BitCast(ui, hn::And(u, hn::Set(si, 31)));
    const auto bit = hn::And(hn::Shr(bits, place), hn::Set(ui, 1));
    const auto hit = hn::RebindMask(f, hn::Ne(bit, hn::Zero(ui)));
    inside_count += hn::CountTrue(f, inside);
    edge_count += hn::CountTrue(f, hn::And(inside, hit));
  }
  job.inside = static_cast<int>(inside_count);
  job.on_edge = static_cast<int>(edge_count);
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(LookUp);
void look_up(LookUpJob& job) { HWY_DYNAMIC_DISPATCH(LookUp)(job); }

}  // namespace anneal6d
#endif
