// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "pose_search.h"

#include <algorithm>
#include <numeric>

namespace anneal6d {
namespace {

constexpr double kWide = 1.5;           // noise of the first layer, of the expected deviations
constexpr double kSurvivalRate = 0.25;  // of particles, from layer to layer
constexpr double kNarrowing = 0.6;      // of the particles' spread, from layer to layer
constexpr double kExpectation = 0.1;    // weight of the motion model beside the image
constexpr double kLeastSpread_px = 0.15;
constexpr std::size_t kStarts = 4;   // particles of the first layer that are refined
constexpr double kApart_rad = 0.07;  // of starts: turn, and shift in radii of the object
constexpr double kStartReach_px = 10.0;
constexpr std::uint32_t kHops = 8, kHopRounds = 2;  // hops of a round start at the same pose
constexpr double kHop_px = 6.0, kHopReach_px = 6.0;
constexpr std::uint32_t kHopLayer = 1000;  // of random numbers: behind those of all layers

}  // namespace

PoseSearch::PoseSearch(PoseFilter& filter, const Refiner& refiner, Workers& workers,
                       const Effort& effort, double radius_mm)
    : filter_(filter),
      refiner_(refiner),
      workers_(workers),
      effort_(effort),
      radius_mm_(radius_mm) {}

Refiner::Result PoseSearch::run(const Expectation& expected, const ColourCue& colours,
                                RandomKey key, double focal_px) {
  starts_.clear();
  PoseFilter::Layer step;
  step.diffusion = (kWide * expected.sigma).asDiagonal();
  step.incumbent = expected.camera_from_center;
  step.expected = expected.camera_from_center;
  step.expected_sigma = expected.sigma;
  step.expectation = kExpectation;
  step.survival_rate = kSurvivalRate;
  step.region_weight = colours.weight;
  filter_.initialize(expected.camera_from_center, static_cast<std::size_t>(effort_.particles));
  Pose mean;
  for (int layer = 0; layer < effort_.layers; ++layer) {
    filter_.set_layer(step);
    key.layer = static_cast<std::uint32_t>(layer);
    mean = filter_.run_layer(key, Resampling::systematic);
    if (layer == 0) collect_starts();
    step.incumbent = filter_.best();
    step.diffusion = narrowed_spread(mean, focal_px);
  }
  const std::size_t from_afar = starts_.size();
  starts_.push_back(mean);
  starts_.push_back(filter_.best());

  found_.resize(starts_.size());
  workers_.each(starts_.size(), 1, [&](std::size_t i) {
    found_[i] = refined(starts_[i], i < from_afar ? Lead::colours : Lead::edges, kStartReach_px,
                        expected, colours.appearance);
  });
  return *std::ranges::max_element(
      found_, {}, [&](const Refiner::Result& found) { return likelihood(found, expected); });
}

Refiner::Result PoseSearch::hop_from(const Refiner::Result& start, const Expectation& expected,
                                     const Appearance& appearance, RandomKey key, double focal_px) {
  Refiner::Result best = start;
  found_.resize(kHops);
  for (std::uint32_t round = 0; round < kHopRounds; ++round) {
    key.layer = kHopLayer + round;
    const Pose here = filter_.to_center(best.camera_from_object);
    workers_.each(kHops, 1, [&](std::size_t i) {
      RandomKey own = key;
      own.particle = static_cast<std::uint32_t>(i);
      found_[i] = refined(beside(here, own, focal_px), i % 2 == 0 ? Lead::colours : Lead::edges,
                          kHopReach_px, expected, appearance);
    });
    for (const Refiner::Result& found : found_) {
      if (likelihood(found, expected) > likelihood(best, expected)) best = found;
    }
  }
  return best;
}

Refiner::Result PoseSearch::refined(const Pose& camera_from_center, Lead lead, double reach_px,
                                    const Expectation& expected,
                                    const Appearance& appearance) const {
  Pose start = filter_.to_object(camera_from_center);
  if (lead == Lead::colours) start = refiner_.approach(start, appearance);
  return refiner_.refine(start, filter_.to_object(expected.camera_from_center), reach_px,
                         appearance);
}

double PoseSearch::likelihood(const Refiner::Result& result, const Expectation& expected) const {
  return result.evidence() - expected.strangeness(filter_.to_center(result.camera_from_object));
}

Pose PoseSearch::beside(const Pose& camera_from_center, const RandomKey& key,
                        double focal_px) const {
  const double hop_mm = kHop_px * mm_per_px(camera_from_center, focal_px);
  // Turns of a hop at the object's farthest point; shifts along the line of sight hardly show.
  const Twist sigma = (Twist() << Eigen::Vector3d::Constant(hop_mm / radius_mm_), 0.5 * hop_mm,
                       0.5 * hop_mm, 1.5 * hop_mm)
                          .finished();
  return moved(camera_from_center, sigma.cwiseProduct(random_twist(key)));
}

void PoseSearch::collect_starts() {
  const auto states = filter_.states();
  const auto weights = filter_.weights();
  order_.resize(states.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  for (const std::size_t index : order_) {
    if (starts_.size() == kStarts) break;
    const bool near = std::any_of(starts_.begin(), starts_.end(), [&](const Pose& other) {
      return displacement_mm(twist_between(other, states[index]), radius_mm_) <
             kApart_rad * radius_mm_;
    });
    if (!near) starts_.push_back(states[index]);
  }
}

Eigen::Matrix<double, 6, 6> PoseSearch::narrowed_spread(const Pose& mean, double focal_px) const {
  const double least_mm = kLeastSpread_px * mm_per_px(mean, focal_px);
  const double least_rad = least_mm / radius_mm_;
  Eigen::Matrix<double, 6, 6> covariance = kNarrowing * kNarrowing * filter_.covariance(mean);
  for (int i = 0; i < 3; ++i) {
    covariance(i, i) += least_rad * least_rad;
    covariance(i + 3, i + 3) += least_mm * least_mm;
  }
  return covariance.llt().matrixL();
}

}  // namespace anneal6d
