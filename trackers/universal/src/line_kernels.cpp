// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "line_kernels.h"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "line_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "line_profile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

void FindCandidates(const LineJob& job, const LineCandidates& out) {
  constexpr F f;
  constexpr I si;
  for (std::size_t first = 0; first < job.count; first += hn::Lanes(f)) {
    const Profile lines(job, first);
    VF best[LineJob::kCandidates];
    VI place[LineJob::kCandidates];
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      best[k] = Set(kNone);
      place[k] = hn::Set(si, lines.middle());
    }
    for (int i = lines.first_place(); i <= lines.last_place(); ++i) {
      const MF edge = lines.IsEdge(i);
      if (hn::AllFalse(f, edge)) continue;
      VF score = lines.LogScore(i, edge);
      VI at = hn::Set(si, i);
      for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
        // The better one stays here, the other goes on to the next place.
        const MF better = hn::Gt(score, best[k]);
        const VF lesser = hn::IfThenElse(better, best[k], score);
        const VI lesser_at = hn::IfThenElse(hn::RebindMask(si, better), place[k], at);
        best[k] = hn::IfThenElse(better, score, best[k]);
        place[k] = hn::IfThenElse(hn::RebindMask(si, better), at, place[k]);
        score = lesser;
        at = lesser_at;
      }
    }
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      const MF there = hn::Gt(best[k], Set(kNone));
      const Profile::Levels levels = lines.LevelsBeside(place[k]);
      VF encoding = lines.EncodingShift(levels);
      if (job.blur_px) encoding = hn::Mul(encoding, lines.BlurredEncoding(first));
      VF offset = hn::Sub(lines.Between(place[k]), encoding);
      if (job.shading_px) {
        const VF whole = lines.ShadingShift(first, levels);
        offset = hn::NegMulAdd(Set(job.shading_share), whole, offset);
        if (k == 0 && out.whole_shading_px) hn::StoreU(whole, f, out.whole_shading_px + first);
      }
      const VF weight = Profile::Weight(lines.SlopeAt(place[k], 0));
      hn::StoreU(hn::IfThenElseZero(there, offset), f, out.offset_px[k] + first);
      hn::StoreU(hn::IfThenElseZero(there, weight), f, out.weight[k] + first);
      hn::StoreU(best[k], f, out.log_score[k] + first);
    }
  }
}

void FindStrongest(const LineJob& job, const LineEdges& out) {
  constexpr F f;
  constexpr I si;
  for (std::size_t first = 0; first < job.count; first += hn::Lanes(f)) {
    const Profile lines(job, first);
    VF best = Set(kNone);
    VI place = hn::Set(si, lines.middle());
    for (int i = lines.first_place(); i <= lines.last_place(); ++i) {
      const MF edge = lines.IsEdge(i);
      if (hn::AllFalse(f, edge)) continue;
      const VF score = lines.LogScore(i, edge);
      const MF better = hn::Gt(score, best);
      best = hn::IfThenElse(better, score, best);
      place = hn::IfThenElse(hn::RebindMask(si, better), hn::Set(si, i), place);
    }
    const MF there = hn::Gt(best, Set(kNone));
    VF offset = lines.Between(place);
    if (job.shading_px) {
      offset = hn::NegMulAdd(Set(job.shading_share),
                             lines.ShadingShift(first, lines.LevelsBeside(place)), offset);
    }
    hn::StoreU(hn::IfThenElseZero(there, offset), f, out.offset_px + first);
    hn::StoreU(hn::IfThenElseZero(there, lines.SlopeAt(place, 0)), f, out.strength + first);
    hn::StoreU(hn::Exp(f, lines.Colours(lines.middle())), f, out.agreement + first);
    if (out.sharpness) {
      hn::StoreU(hn::IfThenElseZero(there, lines.Sharpness(place)), f, out.sharpness + first);
    }
  }
}

void FindBorders(const LineJob& job, float* offset_px, float* variance_px2) {
  constexpr F f;
  for (std::size_t first = 0; first < job.count; first += hn::Lanes(f)) {
    const Profile lines(job, first);
    VF sum = hn::Zero(f), first_moment = hn::Zero(f), second = hn::Zero(f);
    for (int i = lines.first_place(); i <= lines.last_place(); ++i) {
      const VF here = hn::Exp(f, lines.Likelihood(i));
      const VF along = Set(static_cast<float>(i - lines.middle()));
      sum = hn::Add(sum, here);
      first_moment = hn::MulAdd(here, along, first_moment);
      second = hn::MulAdd(here, Square(along), second);
    }
    const VF mean = hn::Div(first_moment, sum);
    const VF variance = hn::Max(hn::Zero(f), hn::Sub(hn::Div(second, sum), Square(mean)));
    hn::StoreU(mean, f, offset_px + first);
    hn::StoreU(variance, f, variance_px2 + first);
  }
}

int CountEdgesBeside(const LineJob& job, int from_px, int to_px) {
  constexpr F f;
  std::size_t count = 0;
  for (std::size_t first = 0; first < job.count; first += hn::Lanes(f)) {
    const Profile lines(job, first);
    for (const int side : {-1, 1}) {
      const int a = lines.middle() + side * from_px, b = lines.middle() + side * to_px;
      const int begin = std::max(std::min(a, b), lines.first_place());
      const int end = std::min(std::max(a, b), lines.last_place());
      MF some = hn::FirstN(f, 0);
      for (int i = begin; i <= end; ++i) some = hn::Or(some, lines.IsEdge(i));
      count += hn::CountTrue(f, some);
    }
  }
  return static_cast<int>(count);
}

void SampleLines(const LineJob& job, const LineSamples& out) {
  const Profile lines(job, 0);
  for (int i = 0; i <= 2 * lines.middle(); ++i) {
    const std::size_t place = static_cast<std::size_t>(i) * kSide;
    for (int c = 0; c < job.channels; ++c) hn::StoreU(lines.Grey(c, i), F(), out.grey[c] + place);
    if (i > 0 && i < 2 * lines.middle()) hn::StoreU(lines.Slope(i), F(), out.slope + place);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(FindCandidates);
void find_candidates(const LineJob& job, const LineCandidates& candidates) {
  HWY_DYNAMIC_DISPATCH(FindCandidates)(job, candidates);
}

HWY_EXPORT(FindStrongest);
void find_strongest(const LineJob& job, const LineEdges& edges) {
  HWY_DYNAMIC_DISPATCH(FindStrongest)(job, edges);
}

HWY_EXPORT(FindBorders);
void find_borders(const LineJob& job, float* offset_px, float* variance_px2) {
  HWY_DYNAMIC_DISPATCH(FindBorders)(job, offset_px, variance_px2);
}

HWY_EXPORT(CountEdgesBeside);
int count_edges_beside(const LineJob& job, int from_px, int to_px) {
  return HWY_DYNAMIC_DISPATCH(CountEdgesBeside)(job, from_px, to_px);
}

HWY_EXPORT(SampleLines);
void sample_lines(const LineJob& job, const LineSamples& samples) {
  HWY_DYNAMIC_DISPATCH(SampleLines)(job, samples);
}

}  // namespace anneal6d
#endif
