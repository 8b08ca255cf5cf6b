// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_pictures.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// A row of a drawing has a margin of as many words.
using U = hn::CappedTag<std::uint32_t, kPixelMargin>;
using U8 = hn::Rebind<std::uint8_t, U>;
using F = hn::RebindToFloat<U>;

void TakePictures(const PictureJob& job) {
  constexpr U ui;
  constexpr U8 u8;
  constexpr F f;
  const auto lanes = static_cast<int>(hn::Lanes(ui));
  const auto scale = hn::Set(f, 1.0F / job.depth_scale), inv_far = hn::Set(f, job.inv_far);
  for (int y = 0; y < job.height; ++y) {
    std::uint32_t* const row = job.pixels + static_cast<std::ptrdiff_t>(y) * job.stride;
    float* const depth_row = job.depth_mm ? job.depth_mm + y * job.depth_stride : nullptr;
    std::uint8_t* const grey_row = job.grey + y * job.grey_stride;
    for (int x = 0; x < job.width; x += lanes) {
      const auto pixels = hn::LoadU(ui, row + x);
      hn::StoreU(hn::Zero(ui), ui, row + x);
      const bool whole = x + lanes <= job.width;
      const auto count = static_cast<std::size_t>(job.width - x);
      const auto grey = hn::DemoteTo(
          u8, hn::BitCast(hn::RebindToSigned<U>(), hn::And(pixels, hn::Set(ui, 0xFF))));
      if (whole) {
        hn::StoreU(grey, u8, grey_row + x);
      } else {
        hn::BlendedStore(grey, hn::FirstN(u8, count), u8, grey_row + x);
      }
      if (!depth_row) continue;
      // The exponent is that of numbers from 1 to 2, see kFarDepth.
      const auto bits = hn::Or(hn::And(hn::ShiftRight<8>(pixels), hn::Set(ui, 0x7FFFFF)),
                               hn::Set(ui, 0x3F800000));
      const auto inv_z =
          hn::MulAdd(hn::Sub(hn::BitCast(f, bits), hn::Set(f, kFarDepth)), scale, inv_far);
      const auto there = hn::RebindMask(f, hn::Ne(pixels, hn::Zero(ui)));
      const auto depth = hn::IfThenElseZero(there, hn::Div(hn::Set(f, 1.0F), inv_z));
      if (whole) {
        hn::StoreU(depth, f, depth_row + x);
      } else {
        hn::BlendedStore(depth, hn::FirstN(f, count), f, depth_row + x);
      }
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(TakePictures);
void take_pictures(const PictureJob& job) { HWY_DYNAMIC_DISPATCH(TakePictures)(job); }

}  // namespace anneal6d
#endif
