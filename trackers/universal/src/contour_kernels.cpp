// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "contour_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contour_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace anneal6d {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, LineJob::kPadding>;
using VF = hn::Vec<F>;
using MF = hn::Mask<F>;

VF Set(float value) { return hn::Set(F(), value); }
VF Square(VF x) { return hn::Mul(x, x); }

struct Vector3 {
  VF x, y, z;
};

VF Dot(const Vector3& a, const Vector3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
/// a + factor * b
Vector3 Add(const Vector3& a, VF factor, const Vector3& b) {
  return {hn::MulAdd(factor, b.x, a.x), hn::MulAdd(factor, b.y, a.y), hn::MulAdd(factor, b.z, a.z)};
}
Vector3 Normalized(const Vector3& a) {
  const VF inverse = hn::Div(Set(1.0F), hn::Sqrt(Dot(a, a)));
  return {hn::Mul(a.x, inverse), hn::Mul(a.y, inverse), hn::Mul(a.z, inverse)};
}
Vector3 Turned(const std::array<float, 9>& rotation, const Vector3& a) {
  const auto row = [&](std::size_t i) {
    return Dot({Set(rotation[i]), Set(rotation[i + 1]), Set(rotation[i + 2])}, a);
  };
  return {row(0), row(3), row(6)};
}

/// A vector's worth of samples, an array each of their numbers.
class SampleBlock {
 public:
  enum Number {
    x,
    y,
    z,
    normal_x,
    normal_y,
    normal_z,
    curve,
    inside,
    outside,
    shift,
    shading,
    trust,
    polarity,
    kNumbers
  };

  /// Behind the last sample the first one is repeated.
  explicit SampleBlock(std::span<const ContourSample> samples) {
    for (std::size_t i = 0; i < hn::Lanes(F()); ++i) {
      const ContourSample& sample = samples[i < samples.size() ? i : 0];
      numbers_[x][i] = sample.object_mm.x();
      numbers_[y][i] = sample.object_mm.y();
      numbers_[z][i] = sample.object_mm.z();
      numbers_[normal_x][i] = sample.normal.x();
      numbers_[normal_y][i] = sample.normal.y();
      numbers_[normal_z][i] = sample.normal.z();
      numbers_[curve][i] = sample.curve_mm;
      // Colours are compared at silhouettes only.
      numbers_[inside][i] = sample.silhouette ? sample.inside_mm : -1.0F;
      numbers_[outside][i] = sample.silhouette ? sample.outside_mm : -1.0F;
      // An outline that stands alone is shifted by shading.
      const bool shaded = sample.silhouette && sample.trust == 1.0F;
      numbers_[shift][i] = shaded ? 0.0F : sample.shift_px;
      numbers_[shading][i] = shaded ? sample.shift_px : 0.0F;
      numbers_[trust][i] = sample.trust;
      numbers_[polarity][i] = static_cast<float>(sample.polarity);
    }
  }

  VF operator[](Number number) const { return hn::Load(F(), numbers_[number]); }

 private:
  HWY_ALIGN float numbers_[kNumbers][kLongestVector];
};

std::size_t ProjectContour(const ProjectionJob& job, const ProjectedContour& points) {
  constexpr F f;
  std::size_t seen = 0;
  for (std::size_t first = 0; first < job.samples.size(); first += hn::Lanes(f)) {
    const SampleBlock samples(job.samples.subspan(first));
    const Vector3 normal = {samples[SampleBlock::normal_x], samples[SampleBlock::normal_y],
                            samples[SampleBlock::normal_z]};
    const Vector3 object = {samples[SampleBlock::x], samples[SampleBlock::y],
                            samples[SampleBlock::z]};
    // On a round surface the contour slides to where the normal is square to the line of sight.
    const Vector3 eye = {Set(job.eye_mm[0]), Set(job.eye_mm[1]), Set(job.eye_mm[2])};
    const Vector3 sight = Normalized(Add(object, Set(-1.0F), eye));
    const Vector3 turned = Normalized(Add(normal, hn::Neg(Dot(normal, sight)), sight));
    const VF curve = samples[SampleBlock::curve];
    const Vector3 place = Add(Add(object, curve, turned), hn::Neg(curve), normal);

    const Vector3 rotated = Turned(job.rotation, place);
    const Vector3 p = {hn::Add(rotated.x, Set(job.translation_mm[0])),
                       hn::Add(rotated.y, Set(job.translation_mm[1])),
                       hn::Add(rotated.z, Set(job.translation_mm[2]))};
    const VF inverse_z = hn::Div(Set(1.0F), p.z);
    const VF x_z = hn::Mul(p.x, inverse_z), y_z = hn::Mul(p.y, inverse_z);
    const VF image_x = hn::MulAdd(Set(job.fx), x_z, Set(job.cx));
    const VF image_y = hn::MulAdd(Set(job.fy), y_z, Set(job.cy));
    // How the normal looks in the image.
    const Vector3 n = Turned(job.rotation, turned);
    const VF across_x = hn::Mul(Set(job.fx), hn::NegMulAdd(x_z, n.z, n.x));
    const VF across_y = hn::Mul(Set(job.fy), hn::NegMulAdd(y_z, n.z, n.y));
    const VF length = hn::Sqrt(hn::Add(Square(across_x), Square(across_y)));
    const VF inverse_length = hn::Div(Set(1.0F), length);
    const VF px_per_mm = hn::Mul(length, inverse_z);

    // False for NaN.
    const auto between = [&](VF at, float last) {
      return hn::And(hn::Gt(at, Set(1.0F)), hn::Lt(at, Set(last)));
    };
    MF visible = hn::And(hn::Ge(p.z, Set(job.near_mm)), hn::Gt(length, Set(1e-9F)));
    visible = hn::And(visible, hn::And(between(image_x, job.last_x), between(image_y, job.last_y)));
    visible = hn::And(visible, hn::FirstN(f, job.samples.size() - first));
    const auto store = [&](VF values, float* row) {
      hn::StoreU(hn::Compress(values, visible), f, row + seen);
    };
    store(p.x, points.camera_x);
    store(p.y, points.camera_y);
    store(p.z, points.camera_z);
    store(image_x, points.image_x);
    store(image_y, points.image_y);
    store(hn::Mul(across_x, inverse_length), points.normal_x);
    store(hn::Mul(across_y, inverse_length), points.normal_y);
    store(samples[SampleBlock::shift], points.shift_px);
    store(samples[SampleBlock::shading], points.shading_px);
    store(samples[SampleBlock::trust], points.trust);
    store(samples[SampleBlock::polarity], points.polarity);
    store(hn::Mul(samples[SampleBlock::inside], px_per_mm), points.inside_px);
    store(hn::Mul(samples[SampleBlock::outside], px_per_mm), points.outside_px);
    seen += hn::CountTrue(f, visible);
  }
  return seen;
}

StepSums SumStep(const StepJob& job) {
  constexpr F f;
  VF normal[21], right[6], sweep[6], whole = hn::Zero(f);
  for (VF& sum : normal) sum = hn::Zero(f);
  for (VF& sum : right) sum = hn::Zero(f);
  for (VF& sum : sweep) sum = hn::Zero(f);
  const VF cutoff = Set(job.cutoff_px), inverse_cutoff = Set(1.0F / job.cutoff_px);
  for (std::size_t first = 0; first < job.count; first += hn::Lanes(f)) {
    const MF there = hn::FirstN(f, job.count - first);
    const auto take = [&](const float* row) { return hn::LoadU(f, row + first); };
    // d(image)/d(point), then d(point)/d(twist) about the object's centre.
    const VF x = take(job.points.camera_x), y = take(job.points.camera_y);
    const VF inverse_z = hn::Div(Set(1.0F), take(job.points.camera_z));
    const VF arm_x = hn::Sub(x, Set(job.center_mm[0])), arm_y = hn::Sub(y, Set(job.center_mm[1]));
    const VF arm_z = hn::Sub(take(job.points.camera_z), Set(job.center_mm[2]));
    const VF x_x = hn::Mul(Set(job.fx), inverse_z), y_y = hn::Mul(Set(job.fy), inverse_z);
    const VF x_z = hn::Neg(hn::Mul(x_x, hn::Mul(x, inverse_z)));
    const VF y_z = hn::Neg(hn::Mul(y_y, hn::Mul(y, inverse_z)));
    const VF zero = hn::Zero(f);
    const VF along_x[6] = {hn::Mul(arm_y, x_z),
                           hn::MulSub(arm_z, x_x, hn::Mul(arm_x, x_z)),
                           hn::Neg(hn::Mul(arm_y, x_x)),
                           x_x,
                           zero,
                           x_z};
    const VF along_y[6] = {hn::MulSub(arm_y, y_z, hn::Mul(arm_z, y_y)),
                           hn::Neg(hn::Mul(arm_x, y_z)),
                           hn::Mul(arm_x, y_y),
                           zero,
                           y_y,
                           y_z};
    const VF normal_x = take(job.points.normal_x), normal_y = take(job.points.normal_y);
    VF jacobian[6], moved = zero;
    for (std::size_t k = 0; k < 6; ++k) {
      jacobian[k] = hn::MulAdd(normal_x, along_x[k], hn::Mul(normal_y, along_y[k]));
      moved = hn::MulAdd(jacobian[k], Set(job.motion[k]), moved);
    }

    VF residual = zero, weight = zero, best = zero;
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      const VF distance = hn::Sub(take(job.candidates.offset_px[k]), moved);
      const VF score =
          hn::Sub(take(job.candidates.log_score[k]), Square(hn::Mul(distance, inverse_cutoff)));
      const MF better = k == 0 ? there : hn::Gt(score, best);
      best = hn::IfThenElse(better, score, best);
      residual = hn::IfThenElse(better, distance, residual);
      weight = hn::IfThenElse(better, take(job.candidates.weight[k]), weight);
    }
    const MF counts = hn::And(there, hn::Lt(hn::Abs(residual), cutoff));
    if (hn::AllFalse(f, counts)) continue;
    const VF tukey = Square(hn::Sub(Set(1.0F), Square(hn::Mul(residual, inverse_cutoff))));
    weight = hn::IfThenElseZero(counts, hn::Mul(hn::Mul(take(job.points.trust), tukey), weight));
    residual = hn::IfThenElseZero(counts, residual);
    whole = hn::Add(whole, weight);
    for (VF& column : jacobian) column = hn::IfThenElseZero(counts, column);
    std::size_t entry = 0;
    for (std::size_t k = 0; k < 6; ++k) {
      const VF weighted = hn::Mul(weight, jacobian[k]);
      for (std::size_t j = k; j < 6; ++j, ++entry) {
        normal[entry] = hn::MulAdd(weighted, jacobian[j], normal[entry]);
      }
      right[k] = hn::MulAdd(weighted, residual, right[k]);
      const VF way = hn::Add(Square(along_x[k]), Square(along_y[k]));
      sweep[k] = hn::MulAdd(weight, hn::IfThenElseZero(counts, way), sweep[k]);
    }
  }
  StepSums sums;
  const auto total = [&](VF sum) { return hn::GetLane(hn::SumOfLanes(f, sum)); };
  std::transform(normal, normal + 21, sums.normal.begin(), total);
  std::transform(right, right + 6, sums.right.begin(), total);
  std::transform(sweep, sweep + 6, sums.sweep.begin(), total);
  sums.weight = total(whole);
  return sums;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace anneal6d
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace anneal6d {

HWY_EXPORT(ProjectContour);
std::size_t project_contour(const ProjectionJob& job, const ProjectedContour& points) {
  return HWY_DYNAMIC_DISPATCH(ProjectContour)(job, points);
}

HWY_EXPORT(SumStep);
StepSums sum_step(const StepJob& job) { return HWY_DYNAMIC_DISPATCH(SumStep)(job); }

}  // namespace anneal6d
#endif
