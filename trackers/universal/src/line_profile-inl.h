// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// What a vector of lines through a picture shows, for each of Highway's targets: included by
// line_kernels.cpp only.
#if defined(ANNEAL6D_LINE_PROFILE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ANNEAL6D_LINE_PROFILE_INL_H_
#undef ANNEAL6D_LINE_PROFILE_INL_H_
#else
#define ANNEAL6D_LINE_PROFILE_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "appearance.h"
#include "encoding_bias.h"
#include "line_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, LineJob::kPadding>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using MF = hn::Mask<F>;

constexpr std::size_t kSide = kLongestVector;  // from sample to sample of one line, floats
constexpr float kFaintest = 2.5F;              // grey levels a pixel: weaker slopes are no edge
constexpr float kHalfWeight = 4.0F;            // the slope that counts half
constexpr float kPixelWeight = 0.5F;           // pixels beside each other show the same
constexpr float kNear = 0.6F;         // of the reach: what is farther away is expected less
constexpr float kMostShading = 2.0F;  // of the shift by shading before black
constexpr float kMostBlur_px = 6.0F;
constexpr float kClearSlope = 6.0F,
                kLeastClearSlope = 0.5F;  // slopes that tell how sharp an edge is
constexpr float kNone = -1e30F;           // logarithm of the score of what is no edge

VF Set(float value) { return hn::Set(F(), value); }
VF Square(VF x) { return hn::Mul(x, x); }

/// Byte `k` of each lane, lowest first.
template <int k>
VF Byte(VI four) {
  constexpr I si;
  return hn::ConvertTo(F(), hn::And(hn::ShiftRight<8 * k>(four), hn::Set(si, 255)));
}

/// What a vector of lines shows.
class Profile {
 public:
  Profile(const LineJob& job, std::size_t first)
      : job_(job),
        lines_(hn::FirstN(F(), job.count - first)),
        polarity_(Take(job.polarity + first)),
        middle_(job.reach_px + kLineMargin),
        last_(2 * middle_) {
    Sample(first);
    for (int i = 1; i < last_; ++i) {
      VF sum = hn::Zero(F());
      for (int c = 0; c < job_.channels; ++c) {
        sum = hn::Add(sum, Square(hn::Sub(Grey(c, i + 1), Grey(c, i - 1))));
      }
      hn::Store(hn::Mul(Set(0.5F), hn::Sqrt(sum)), F(), At(slope_, i));
    }
    CompareColours(first);
  }

  int first_place() const { return kLineMargin; }
  int last_place() const { return last_ - kLineMargin; }
  int middle() const { return middle_; }

  VF Grey(int channel, int i) const { return hn::Load(F(), At(grey_[channel], i)); }
  VF Slope(int i) const { return hn::Load(F(), At(slope_, i)); }

  /// Logarithm of how likely the object ends at sample i by its colours; 0 at most.
  VF Colours(int i) const { return hn::Sub(hn::Load(F(), At(region_, i)), greatest_); }
  /// The same, and by the distance from the middle.
  VF Likelihood(int i) const {
    const float away =
        static_cast<float>(i - middle_) / (static_cast<float>(job_.reach_px) * kNear);
    return hn::Sub(Colours(i), Set(away * away));
  }

  /// Where sample i is an edge; behind the last line there is none, since nothing rises there.
  MF IsEdge(int i) const {
    constexpr F f;
    const VF here = Slope(i);
    const MF ridge = hn::And(hn::And(hn::Ge(here, Set(kFaintest)), hn::Ge(here, Slope(i - 1))),
                             hn::Gt(here, Slope(i + 1)));
    VF rise = hn::Zero(f);
    for (int c = 0; c < job_.channels; ++c) {
      rise = hn::Add(rise, hn::Sub(Grey(c, i + 1), Grey(c, i - 1)));
    }
    const MF right = hn::Ge(hn::Mul(rise, polarity_), hn::Zero(f));
    return hn::And(ridge, right);
  }

  /// Logarithm of the score of an edge at sample i; there is one where `edge` says so.
  VF LogScore(int i, MF edge) const {
    constexpr F f;
    const VF score = hn::Add(hn::Log(f, Weight(hn::Max(Slope(i), Set(kFaintest)))), Likelihood(i));
    return hn::IfThenElse(edge, score, Set(kNone));
  }

  static VF Weight(VF slope) { return hn::Div(slope, hn::Add(slope, Set(kHalfWeight))); }

  // The same at a place of each lane's own.
  VF SlopeAt(VI place, int away) const { return Look(slope_, place, away); }
  /// Place of the greatest slope around a sample, between samples, from the middle: the vertex of
  /// the parabola through three slopes (ridge.h).
  VF Between(VI place) const {
    const VF before = SlopeAt(place, -1), here = SlopeAt(place, 0), after = SlopeAt(place, 1);
    const VF bend = hn::Sub(hn::Add(before, after), hn::Add(here, here));
    const VF offset = hn::Div(hn::Mul(Set(0.5F), hn::Sub(before, after)), bend);
    const VF whole = hn::Sub(hn::ConvertTo(F(), place), Set(static_cast<float>(middle_)));
    return hn::Add(whole, offset);
  }

  /// Grey levels before and behind an edge, of the channel with the most contrast.
  struct Levels {
    VF from, to;
  };
  Levels LevelsBeside(VI place) const {
    Levels levels = {Look(grey_[0], place, -2), Look(grey_[0], place, 2)};
    for (int c = 1; c < job_.channels; ++c) {
      const VF a = Look(grey_[c], place, -2), b = Look(grey_[c], place, 2);
      const MF clearer = hn::Gt(hn::Abs(hn::Sub(b, a)), hn::Abs(hn::Sub(levels.to, levels.from)));
      levels.from = hn::IfThenElse(clearer, a, levels.from);
      levels.to = hn::IfThenElse(clearer, b, levels.to);
    }
    return levels;
  }

  /// Brightness that fades towards an outline moves the greatest slope of a blurred picture by the
  /// fading over the step at the outline. Fading is a share of the object's brightness. So is the
  /// step, but only before a black background: before another it is the difference of both. Where
  /// there is little of it, no more than kMostShading is believed.
  VF ShadingShift(std::size_t first, const Levels& levels) const {
    const VF fading = Take(job_.shading_px + first);
    const VF step = hn::Sub(levels.from, levels.to);
    const VF most = Set(kMostShading);
    const MF clear = hn::Lt(levels.from, hn::Mul(most, hn::Abs(step)));
    const VF share = hn::IfThenElse(clear, hn::Div(levels.from, step), hn::CopySign(most, step));
    return hn::Mul(fading, share);
  }

  /// How much farther the encoding moves an edge that is blurred by motion than one that is not: a
  /// step before black that pixels of 1, 1.5, 2 and 3 times the width mix is found 1, 1.6, 2.2 and
  /// 3.8 times as far off.
  VF BlurredEncoding(std::size_t first) const {
    constexpr F f;
    const VF blur = hn::Min(Take(job_.blur_px + first), Set(kMostBlur_px));
    return hn::Exp(f, hn::Mul(Set(0.6F), hn::Log(f, hn::MulAdd(blur, blur, Set(1.0F)))));
  }

  /// See LineEdges.
  VF Sharpness(VI place) const {
    constexpr F f;
    const VF before = SlopeAt(place, -1), here = SlopeAt(place, 0), after = SlopeAt(place, 1);
    const MF clear = hn::And(hn::Ge(here, Set(kClearSlope)),
                             hn::Ge(hn::Min(before, after), Set(kLeastClearSlope)));
    const auto log = [&](VF slope) { return hn::Log(f, hn::Max(slope, Set(kLeastClearSlope))); };
    const VF beside = hn::Mul(Set(0.5F), hn::Add(log(before), log(after)));
    return hn::IfThenElseZero(clear, hn::Sub(log(here), beside));
  }

  /// See EncodingBias.
  VF EncodingShift(const Levels& levels) const {
    constexpr F f;
    const EncodingBias& bias = EncodingBias::table();
    const auto level = [&](VF grey) {
      return hn::NearestInt(hn::Max(hn::Zero(f), hn::Min(grey, Set(255.0F))));
    };
    const VI i = level(levels.from), j = level(levels.to);
    const auto rise = [&](const std::array<float, 256>& table) {
      return hn::Sub(hn::GatherIndex(f, table.data(), j), hn::GatherIndex(f, table.data(), i));
    };
    const VF mean_level = hn::Div(rise(bias.integral), rise(bias.light));
    const VF low = hn::Mul(hn::ConvertTo(f, i), Set(1.0F / 255.0F));
    const VF high = hn::Mul(hn::ConvertTo(f, j), Set(1.0F / 255.0F));
    const VF shift =
        hn::Div(hn::NegMulAdd(Set(0.5F), hn::Neg(hn::Add(low, high)), hn::Neg(mean_level)),
                hn::Sub(high, low));
    return hn::IfThenElse(hn::RebindMask(f, hn::Eq(i, j)), hn::Zero(f), shift);
  }

 private:
  static const float* At(const float* values, int i) {
    return values + static_cast<std::size_t>(i) * kSide;
  }
  static float* At(float* values, int i) { return values + static_cast<std::size_t>(i) * kSide; }

  /// Entries of lines, 0 behind the last one.
  VF Take(const float* values) const { return hn::IfThenElseZero(lines_, hn::LoadU(F(), values)); }

  VF Look(const float* values, VI place, int away) const {
    constexpr I si;
    const VI row = hn::Add(place, hn::Set(si, away));
    return hn::GatherIndex(
        F(), values,
        hn::Add(hn::Mul(row, hn::Set(si, static_cast<std::int32_t>(kSide))), hn::Iota(si, 0)));
  }

  void Sample(std::size_t first) {
    constexpr F f;
    constexpr I si;
    const VF right = Set(static_cast<float>(job_.columns) - 1.001F);
    const VF bottom = Set(static_cast<float>(job_.rows) - 1.001F);
    const VI stride = hn::Set(si, static_cast<std::int32_t>(job_.stride));
    const auto* const base = reinterpret_cast<const std::int32_t*>(job_.data);
    const auto bytes_at = [&](VI offset) { return hn::GatherOffset(si, base, offset); };
    const VF step_x = Take(job_.normal_x + first), step_y = Take(job_.normal_y + first);
    const VF middle_x = Take(job_.x + first), middle_y = Take(job_.y + first);
    for (int i = 0; i <= last_; ++i) {
      const VF along = Set(static_cast<float>(i - middle_));
      const VF x = hn::Max(hn::Zero(f), hn::Min(right, hn::MulAdd(along, step_x, middle_x)));
      const VF y = hn::Max(hn::Zero(f), hn::Min(bottom, hn::MulAdd(along, step_y, middle_y)));
      const VI column = hn::ConvertTo(si, x), row = hn::ConvertTo(si, y);
      const VF share_x = hn::Sub(x, hn::ConvertTo(f, column));
      const VF share_y = hn::Sub(y, hn::ConvertTo(f, row));
      const VI upper = hn::Add(hn::Mul(row, stride), hn::Mul(column, hn::Set(si, job_.channels)));
      const VI lower = hn::Add(upper, stride);
      const auto store = [&](int channel, VF a, VF b, VF p, VF q) {
        const VF above = hn::MulAdd(share_x, hn::Sub(b, a), a);
        const VF below = hn::MulAdd(share_x, hn::Sub(q, p), p);
        hn::Store(hn::MulAdd(share_y, hn::Sub(below, above), above), f, At(grey_[channel], i));
      };
      // Four bytes are read at once, and none that the picture does not have.
      if (job_.channels == 1) {
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
  }

  /// Index of a colour; see Appearance::bin.
  VI Bin(int i) const {
    constexpr I si;
    const auto byte = [&](int c) { return hn::ConvertTo(si, hn::Add(Grey(c, i), Set(0.5F))); };
    if (job_.channels == 1) return hn::ShiftRight<1>(byte(0));
    return hn::Or(hn::Or(hn::ShiftLeft<10>(hn::ShiftRight<3>(byte(0))),
                         hn::ShiftLeft<5>(hn::ShiftRight<3>(byte(1)))),
                  hn::ShiftRight<3>(byte(2)));
  }

  /// Sums up the log odds of what lies before each sample: the object ends where they are greatest.
  void CompareColours(std::size_t first) {
    constexpr F f;
    constexpr I si;
    VF sum = hn::Zero(f);
    if (!job_.log_odds) {
      for (int i = 1; i < last_; ++i) hn::Store(sum, f, At(region_, i));
      greatest_ = sum;
      return;
    }
    const auto whole = [&](VF x) { return hn::ConvertTo(f, hn::ConvertTo(si, x)); };
    const VF begin = hn::Neg(whole(Take(job_.inside_px + first)));
    const VF end = whole(Take(job_.outside_px + first));
    const MF compared = hn::And(lines_, hn::Ge(Take(job_.inside_px + first), hn::Zero(f)));
    const auto* const odds = reinterpret_cast<const std::int32_t*>(job_.log_odds);
    constexpr float kHalf = 0.5F * kPixelWeight / Appearance::kScale;
    greatest_ = Set(kNone);
    for (int i = 1; i < last_; ++i) {
      const VF along = Set(static_cast<float>(i - middle_));
      const MF speaks = hn::And(hn::And(hn::Ge(along, begin), hn::Le(along, end)), compared);
      VF half = hn::Zero(f);
      if (!hn::AllFalse(f, speaks)) {
        // Four bytes from the place on; the lowest is the one.
        const VI four = hn::GatherOffset(si, odds, Bin(i));
        const VI one = hn::ShiftRight<24>(hn::ShiftLeft<24>(four));
        half = hn::IfThenElseZero(speaks, hn::Mul(hn::ConvertTo(f, one), Set(kHalf)));
      }
      sum = hn::Add(sum, half);
      hn::Store(sum, f, At(region_, i));
      greatest_ = hn::Max(greatest_, sum);
      sum = hn::Add(sum, half);
    }
  }

  const LineJob& job_;
  MF lines_;
  VF polarity_;
  int middle_, last_;
  VF greatest_;
  HWY_ALIGN float grey_[3][kLongestLine * kSide];
  HWY_ALIGN float slope_[kLongestLine * kSide];
  HWY_ALIGN float region_[kLongestLine * kSide];
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#endif
