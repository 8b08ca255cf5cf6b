// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "ridge_kernels.h"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ridge_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using I = hn::CappedTag<std::int32_t, 16>;
using I16 = hn::Rebind<std::int16_t, I>;
using VI = hn::Vec<I>;

std::size_t FindRidges(const RidgeJob& job) {
  constexpr I si;
  constexpr I16 d16;
  const auto lanes = static_cast<int>(hn::Lanes(si));
  const auto widened = [&](const std::int16_t* values) {
    return hn::PromoteTo(si, hn::LoadU(d16, values));
  };
  for (int y = 0; y < job.rows; ++y) {
    const std::ptrdiff_t row = y * job.stride;
    int x = 0;
    for (; x + lanes <= job.columns; x += lanes) {
      const VI u = widened(job.along_x + row + x), v = widened(job.along_y + row + x);
      hn::StoreU(hn::Add(hn::Mul(u, u), hn::Mul(v, v)), si, job.squared + row + x);
    }
    for (; x < job.columns; ++x) {
      const int u = job.along_x[row + x], v = job.along_y[row + x];
      job.squared[row + x] = u * u + v * v;
    }
  }
  std::size_t count = 0;
  const int end = job.columns - job.margin;
  for (int y = job.margin; y < job.rows - job.margin; ++y) {
    const auto add = [&](int x) {
      job.places[count++] = static_cast<std::uint32_t>(y * job.columns + x);
    };
    int x = job.margin;
    for (; x + lanes <= end; x += lanes) {
      const std::ptrdiff_t place = y * job.stride + x;
      const std::int32_t* const squared = job.squared + place;
      const VI here = hn::LoadU(si, squared);
      const auto steep = hn::Gt(here, hn::Set(si, job.least - 1));
      if (hn::AllFalse(si, steep)) continue;
      const VI u = hn::Abs(widened(job.along_x + place)), v = hn::Abs(widened(job.along_y + place));
      const auto upright = hn::Gt(v, u);
      const VI before =
          hn::IfThenElse(upright, hn::LoadU(si, squared - job.stride), hn::LoadU(si, squared - 1));
      const VI after =
          hn::IfThenElse(upright, hn::LoadU(si, squared + job.stride), hn::LoadU(si, squared + 1));
      const auto ridge = hn::And(steep, hn::AndNot(hn::Gt(before, here), hn::Gt(here, after)));
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(si, ridge, bytes);
      for (unsigned bits = bytes[0] | bytes[1] << 8; bits; bits &= bits - 1) {
        add(x + std::countr_zero(bits));
      }
    }
    for (; x < end; ++x) {
      const std::ptrdiff_t place = y * job.stride + x;
      const std::int32_t* const squared = job.squared + place;
      if (*squared < job.least) continue;
      const int u = job.along_x[place], v = job.along_y[place];
      const std::ptrdiff_t next = v * v > u * u ? job.stride : 1;
      if (squared[-next] <= *squared && *squared > squared[next]) add(x);
    }
  }
  return count;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(FindRidges);
std::size_t find_ridges(const RidgeJob& job) { return HWY_DYNAMIC_DISPATCH(FindRidges)(job); }

}  // namespace anneal6d
#endif
