// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "line_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "line_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, LineJob::kPadding>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;

/// Byte `k` of each lane, lowest first.
template <int k>
VF Byte(VI four) {
  constexpr I si;
  return hn::ConvertTo(F(), hn::And(hn::ShiftRight<8 * k>(four), hn::Set(si, 255)));
}

void SampleLine(const LineJob& job) {
  constexpr F f;
  constexpr I si;
  const VF right = hn::Set(f, static_cast<float>(job.columns) - 1.001F);
  const VF bottom = hn::Set(f, static_cast<float>(job.rows) - 1.001F);
  const VI stride = hn::Set(si, static_cast<std::int32_t>(job.stride));
  const auto* const base = reinterpret_cast<const std::int32_t*>(job.data);
  const auto bytes_at = [&](VI offset) { return hn::GatherOffset(si, base, offset); };
  for (int i = 0; i < job.count; i += static_cast<int>(hn::Lanes(f))) {
    const VF along = hn::Add(hn::Iota(f, 0.0F), hn::Set(f, static_cast<float>(i)));
    const VF x = hn::Max(
        hn::Zero(f), hn::Min(right, hn::MulAdd(along, hn::Set(f, job.step_x), hn::Set(f, job.x))));
    const VF y = hn::Max(
        hn::Zero(f), hn::Min(bottom, hn::MulAdd(along, hn::Set(f, job.step_y), hn::Set(f, job.y))));
    const VI column = hn::ConvertTo(si, x), row = hn::ConvertTo(si, y);
    const VF share_x = hn::Sub(x, hn::ConvertTo(f, column));
    const VF share_y = hn::Sub(y, hn::ConvertTo(f, row));
    const VI upper = hn::Add(hn::Mul(row, stride), hn::Mul(column, hn::Set(si, job.channels)));
    const VI lower = hn::Add(upper, stride);
    const auto store = [&](int channel, VF a, VF b, VF p, VF q) {
      const VF above = hn::MulAdd(share_x, hn::Sub(b, a), a);
      const VF below = hn::MulAdd(share_x, hn::Sub(q, p), p);
      hn::StoreU(hn::MulAdd(share_y, hn::Sub(below, above), above), f, job.grey[channel] + i);
    };
    // Four bytes are read at once, and none that the picture does not have.
    if (job.channels == 1) {
      // Behind the upper pixels and before the lower ones there is another row.
      const VI above = bytes_at(upper), below = bytes_at(hn::Sub(lower, hn::Set(si, 2)));
      store(0, Byte<0>(above), Byte<1>(above), Byte<2>(below), Byte<3>(below));
    } else {
      // Six bytes of two pixels: the first four, and the last four.
      const VI two = hn::Set(si, 2);
      const VI above = bytes_at(upper), above_end = bytes_at(hn::Add(upper, two));
      const VI below = bytes_at(lower), below_end = bytes_at(hn::Add(lower, two));
      store(0, Byte<0>(above), Byte<3>(above), Byte<0>(below), Byte<3>(below));
      store(1, Byte<1>(above), Byte<2>(above_end), Byte<1>(below), Byte<2>(below_end));
      store(2, Byte<2>(above), Byte<3>(above_end), Byte<2>(below), Byte<3>(below_end));
    }
  }
  for (int i = 1; i < job.count - 1; i += static_cast<int>(hn::Lanes(f))) {
    VF sum = hn::Zero(f);
    for (int channel = 0; channel < job.channels; ++channel) {
      const float* const here = job.grey[channel] + i;
      const VF rise = hn::Sub(hn::LoadU(f, here + 1), hn::LoadU(f, here - 1));
      sum = hn::MulAdd(rise, rise, sum);
    }
    hn::StoreU(hn::Mul(hn::Set(f, 0.5F), hn::Sqrt(sum)), f, job.slope + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(SampleLine);
void sample_line(const LineJob& job) { HWY_DYNAMIC_DISPATCH(SampleLine)(job); }

}  // namespace anneal6d
#endif
