// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "raster_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_canny.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

#include "raster_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Gradients of two rows above a band, and of the band: row r of a band is row r + 2 here.
class GradientRows {
 public:
  explicit GradientRows(const CannyJob& job)
      : stride_(job.picture.row_stride), width_(job.picture.width), begin_(job.gradients) {}

  std::int16_t* gx(int row) const { return at(0, row); }
  std::int16_t* gy(int row) const { return at(1, row); }
  std::int16_t* magnitude(int row) const { return at(2, row); }  ///< |Gx| + |Gy|

  /// There is no gradient beside the picture.
  void close_magnitude(int row) const { magnitude(row)[-1] = magnitude(row)[width_] = 0; }
  void clear_magnitude(int row) const { std::fill_n(magnitude(row) - 1, width_ + 2, 0); }

  void copy(int from, int to) const {
    for (int kind = 0; kind < 3; ++kind)
      std::copy_n(at(kind, from) - 1, width_ + 2, at(kind, to) - 1);
  }

 private:
  std::int16_t* at(int kind, int row) const {
    return begin_ + (kind * kGradientRows + row) * stride_ + kRowMargin;
  }

  std::ptrdiff_t stride_;
  int width_;
  std::int16_t* begin_;
};

/// Gradients of the `count` rows of a band, column by column of vectors.
void Differentiate(const DrawnPicture& picture, int count, const GradientRows& gradients) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int x = 0; x < picture.width; x += lanes) {
    DifferentiateColumn<true>(
        picture.rows + kRowMargin + x, picture.row_stride, count, [&](int r, V gx, V gy) {
          hn::StoreU(gx, d, gradients.gx(r + 2) + x);
          hn::StoreU(gy, d, gradients.gy(r + 2) + x);
          hn::StoreU(hn::Add(hn::Abs(gx), hn::Abs(gy)), d, gradients.magnitude(r + 2) + x);
        });
  }
  for (int r = 2; r < count + 2; ++r) gradients.close_magnitude(r);
}

/// Whether the magnitude at x, ... of a row is the largest across the edge, in one of four
/// directions; of two equal ones it is the upper, or the left one, but neither on a diagonal.
HWY_INLINE hn::Mask<D> IsLargest(const GradientRows& gradients, int row, int x, V magnitude) {
  const auto beside = [&](int down, int right) {
    return hn::LoadU(d, gradients.magnitude(row + down) + x + right);
  };
  const auto above_both = [&](V first, V second) {
    return hn::And(hn::Gt(magnitude, first), hn::Gt(magnitude, second));
  };
  const auto above_first = [&](V first, V second) {
    return hn::AndNot(hn::Gt(second, magnitude), hn::Gt(magnitude, first));
  };
  const V gx = hn::LoadU(d, gradients.gx(row) + x), gy = hn::LoadU(d, gradients.gy(row) + x);
  const V ax = hn::Abs(gx), ay = hn::Abs(gy);
  // OpenCV's tangent of 22.5 degrees is 13573 / 2^15; that of 67.5 degrees is 2 more. The product,
  // rounded down here, is whole for no gradient but 0, which is above no threshold.
  const V lower = hn::MulHigh(hn::Add(ax, ax), hn::Set(d, std::int16_t{13573}));
  const auto across = hn::Not(hn::Gt(ay, lower));
  const auto along = hn::Gt(hn::Sub(ay, hn::Add(ax, ax)), lower);
  const auto falling = hn::Lt(hn::Xor(gx, gy), hn::Zero(d));
  const auto diagonal = hn::Or(hn::And(falling, above_both(beside(-1, 1), beside(1, -1))),
                               hn::AndNot(falling, above_both(beside(-1, -1), beside(1, 1))));
  return hn::Or(hn::And(across, above_first(beside(0, -1), beside(0, 1))),
                hn::Or(hn::And(along, above_first(beside(-1, 0), beside(1, 0))),
                       hn::AndNot(hn::Or(across, along), diagonal)));
}

/// Candidates in row y of the picture, whose gradients are in `row`, with those of the rows beside.
void FindCandidatesOfRow(const CannyJob& job, int y, const GradientRows& gradients, int row) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  const V low = hn::Set(d, static_cast<std::int16_t>(job.low));
  const V high = hn::Set(d, static_cast<std::int16_t>(job.high));
  const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(y) * ((job.picture.width + 63) / 64);
  std::uint64_t* const candidates = job.candidates + begin;
  std::uint64_t* const strong = job.strong + begin;
  for (int x = 0; x < job.picture.width; x += lanes) {
    const V magnitude = hn::LoadU(d, gradients.magnitude(row) + x);
    auto above_low = hn::Gt(magnitude, low);
    if (!hn::AllFalse(d, above_low)) {
      above_low = hn::And(above_low, IsLargest(gradients, row, x, magnitude));
    }
    PutBits(above_low, x, candidates);
    PutBits(hn::And(above_low, hn::Gt(magnitude, high)), x, strong);
  }
  ClearBehind(job.picture.width, 1, candidates);
  ClearBehind(job.picture.width, 1, strong);
}

void FindCannyCandidates(const CannyJob& job) {
  const GradientRows gradients(job);
  gradients.clear_magnitude(1);
  // A row's candidates are known when the gradients of the row below are: one row late.
  ForEachBand(job.picture, [&](int y, int count) {
    Differentiate(job.picture, count, gradients);
    for (int r = y == 0 ? 2 : 1; r <= count; ++r) {
      FindCandidatesOfRow(job, y + r - 2, gradients, r);
    }
    gradients.copy(count, 0);
    gradients.copy(count + 1, 1);
  });
  gradients.clear_magnitude(2);
  FindCandidatesOfRow(job, job.picture.height - 1, gradients, 1);
}

}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(FindCannyCandidates);
void find_canny_candidates(const CannyJob& job) { HWY_DYNAMIC_DISPATCH(FindCannyCandidates)(job); }

}  // namespace anneal6d
#endif
