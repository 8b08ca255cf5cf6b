// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "blur_kernels.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blur_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using U16 = hn::CappedTag<std::uint16_t, 32>;
using U8 = hn::Rebind<std::uint8_t, U16>;
using V16 = hn::Vec<U16>;

constexpr int kReach = 2;
// In 256ths: of the middle, of its neighbours, of the next ones; together 256.
constexpr std::uint16_t kMiddle = 104, kNext = 62, kLast = 14;

/// Entries behind a row that are read or written with it.
constexpr std::size_t kMargin = 32;

V16 Weighted(std::uint16_t weight, V16 values) { return hn::Mul(hn::Set(U16(), weight), values); }

/// Of an intermediate value in 256ths.
V16 Share(std::uint16_t weight, V16 values) {
  return hn::MulHigh(hn::Set(U16(), static_cast<std::uint16_t>(256 * weight)), values);
}

void BlurRows(const cv::Mat& image, const cv::Rect& window, int from_row, int to_row,
              cv::Mat& smooth) {
  constexpr U16 d;
  constexpr U8 d8;
  const std::size_t lanes = hn::Lanes(d);
  const auto channels = static_cast<std::size_t>(image.channels());
  const std::size_t width = static_cast<std::size_t>(window.width) * channels;
  // Columns that there are, with those around the window; beyond are copies of the outermost.
  const int begin = std::max(window.x - kReach, 0);
  const int end = std::min(window.x + window.width + kReach, image.cols);
  const auto missing = static_cast<std::size_t>(begin - (window.x - kReach)) * channels;
  const std::size_t there = static_cast<std::size_t>(end - begin) * channels;
  const std::size_t whole = width + 2 * kReach * channels;
  thread_local std::vector<std::uint16_t> columns;  // sums of five rows, 256ths
  columns.resize(whole + kMargin);
  for (int y = from_row; y < to_row; ++y) {
    const std::uint8_t* rows[2 * kReach + 1];
    for (int k = 0; k <= 2 * kReach; ++k) {
      const int row = std::clamp(window.y + y + k - kReach, 0, image.rows - 1);
      rows[k] = image.ptr<std::uint8_t>(row) + static_cast<std::size_t>(begin) * channels;
    }
    const auto sum_up = [&](std::size_t i) {
      const auto row = [&](int k) { return hn::PromoteTo(d, hn::LoadU(d8, rows[k] + i)); };
      V16 sum = Weighted(kMiddle, row(2));
      sum = hn::Add(sum, Weighted(kNext, hn::Add(row(1), row(3))));
      sum = hn::Add(sum, Weighted(kLast, hn::Add(row(0), row(4))));
      hn::StoreU(sum, d, columns.data() + missing + i);
    };
    std::size_t i = 0;
    for (; i + lanes <= there; i += lanes) sum_up(i);
    // No byte is read behind the row: the last vector covers some columns once more.
    if (there >= lanes) {
      sum_up(there - lanes);
    } else {
      for (i = 0; i < there; ++i) {
        columns[missing + i] =
            static_cast<std::uint16_t>(kMiddle * rows[2][i] + kNext * (rows[1][i] + rows[3][i]) +
                                       kLast * (rows[0][i] + rows[4][i]));
      }
    }
    for (i = missing; i > 0; --i) columns[i - 1] = columns[i - 1 + channels];
    for (i = missing + there; i < whole; ++i) columns[i] = columns[i - channels];

    std::uint8_t* const out = smooth.ptr<std::uint8_t>(y);
    const auto blurred = [&](std::size_t at) {
      const auto beside = [&](std::size_t k) {
        return hn::LoadU(d, columns.data() + at + k * channels);
      };
      // Products are cut off: half a 256th each on average.
      V16 sum = hn::Set(d, 128 + 2);
      sum = hn::Add(sum, Share(kMiddle, beside(2)));
      sum = hn::Add(sum, hn::Add(Share(kNext, beside(1)), Share(kNext, beside(3))));
      sum = hn::Add(sum, hn::Add(Share(kLast, beside(0)), Share(kLast, beside(4))));
      return hn::DemoteTo(d8, hn::BitCast(hn::RebindToSigned<U16>(), hn::ShiftRight<8>(sum)));
    };
    for (i = 0; i + lanes <= width; i += lanes) hn::StoreU(blurred(i), d8, out + i);
    if (i < width) {
      HWY_ALIGN std::uint8_t last[kMargin];
      hn::Store(blurred(i), d8, last);
      std::copy_n(last, width - i, out + i);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(BlurRows);
void blur_rows(const cv::Mat& image, const cv::Rect& window, int from_row, int to_row,
               cv::Mat& smooth) {
  HWY_DYNAMIC_DISPATCH(BlurRows)(image, window, from_row, to_row, smooth);
}

}  // namespace anneal6d
#endif
