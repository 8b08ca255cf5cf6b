// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "motion_model.h"

#include <algorithm>
#include <cmath>

namespace anneal6d {
namespace {

constexpr double kForgetting = 0.15;    // weight of the newest motion in the running moments
constexpr double kLeastSigma = 0.35;    // of the initial one: motion may start at any time
constexpr double kGreatestSigma = 2.5;  // of the initial one
constexpr double kSafety = 1.3;         // noise is set wider than what was seen

}  // namespace

MotionModel::MotionModel(double sigma_mm, double sigma_rad) : initial_sigma_{sigma_rad, sigma_mm} {
  reset();
}

void MotionModel::reset() {
  for (int part = 0; part < 2; ++part) {
    const double variance = initial_sigma_[part] * initial_sigma_[part];
    moments_[part] = {.lagged = 0, .square = variance, .innovation = variance};
  }
  last_motion_.setZero();
}

double MotionModel::Moments::share() const {
  return square > 0 ? std::clamp(lagged / square, 0.0, 1.0) : 0.0;
}

void MotionModel::observe(const Pose& before, const Pose& after) {
  const Twist motion = twist_between(before, after);
  const Twist surprise = motion - drift();
  for (int part = 0; part < 2; ++part) {
    const auto of = [part](const Twist& twist) { return twist.segment<3>(3 * part); };
    const auto update = [](double& mean, double value) { mean += kForgetting * (value - mean); };
    update(moments_[part].lagged, of(motion).dot(of(last_motion_)) / 3);
    update(moments_[part].square, of(motion).squaredNorm() / 3);
    update(moments_[part].innovation, of(surprise).squaredNorm() / 3);
  }
  last_motion_ = motion;
}

Twist MotionModel::drift() const {
  Twist drift = last_motion_;
  drift.head<3>() *= moments_[0].share();
  drift.tail<3>() *= moments_[1].share();
  return drift;
}

Twist MotionModel::sigma() const {
  Twist sigma = kSafety * seen_sigma();
  for (int part = 0; part < 2; ++part) {
    const auto entries = sigma.segment<3>(3 * part).array();
    sigma.segment<3>(3 * part) = entries.max(kLeastSigma * initial_sigma_[part])
                                     .min(kGreatestSigma * initial_sigma_[part])
                                     .matrix();
  }
  return sigma;
}

Twist MotionModel::seen_sigma() const {
  Twist sigma;
  for (int part = 0; part < 2; ++part) {
    sigma.segment<3>(3 * part).setConstant(std::sqrt(moments_[part].innovation));
  }
  return sigma;
}

}  // namespace anneal6d
