// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "pose_filter.h"

namespace anneal6d {
namespace {

constexpr std::size_t kStatesPerTask = 64;

}  // namespace

PoseFilter::PoseFilter(PoseScorer& scorer, const RatingOptions& rating,
                       const Eigen::Vector3d& center_mm, Workers& workers)
    : scorer_(scorer), rating_(rating), center_mm_(center_mm), workers_(workers) {}

Pose PoseFilter::to_center(const Pose& camera_from_object) const {
  return with_origin_at(center_mm_, camera_from_object);
}

Pose PoseFilter::to_object(const Pose& camera_from_center) const {
  return with_origin_at(-center_mm_, camera_from_center);
}

void PoseFilter::predict(std::span<Pose> states, const RandomKey& key) {
  workers_.each(states.size(), kStatesPerTask, [&](std::size_t i) {
    RandomKey own = key;
    own.particle = static_cast<std::uint32_t>(i);
    const Twist twist = layer_.drift + layer_.diffusion * random_twist(own);
    states[i] = moved(states[i], twist);
  });
  if (layer_.incumbent) states[0] = *layer_.incumbent;
}

void PoseFilter::measure(std::span<const Pose> states, std::span<double> log_likelihoods) {
  camera_from_object_.resize(states.size());
  matches_.resize(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) camera_from_object_[i] = to_object(states[i]);
  scorer_.score(camera_from_object_, matches_);
  rate(rating_, matches_, log_likelihoods);
  if (region_ && layer_.region_weight > 0) {
    agreements_.resize(states.size());
    region_->score(camera_from_object_, agreements_);
    for (std::size_t i = 0; i < states.size(); ++i) {
      log_likelihoods[i] -= layer_.region_weight * (1.0 - agreements_[i]);
    }
  }
  if (layer_.expectation > 0) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Twist deviation =
          twist_between(layer_.expected, states[i]).cwiseQuotient(layer_.expected_sigma);
      log_likelihoods[i] -= 0.5 * layer_.expectation * deviation.squaredNorm();
    }
  }
  if (layer_.survival_rate > 0) {
    const double beta = annealing_exponent(log_likelihoods, layer_.survival_rate);
    for (double& value : log_likelihoods) value *= beta;
  }
}

Pose PoseFilter::mean(std::span<const Pose> states, std::span<const double> weights) const {
  return weighted_mean(states, weights);
}

Eigen::Matrix<double, 6, 6> PoseFilter::covariance(const Pose& camera_from_center) const {
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t i = 0; i < states().size(); ++i) {
    const Twist deviation = twist_between(camera_from_center, states()[i]);
    covariance += weights()[i] * deviation * deviation.transpose();
  }
  return covariance;
}

}  // namespace anneal6d
