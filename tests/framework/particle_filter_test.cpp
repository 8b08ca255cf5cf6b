// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/particle_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "parameter_names.h"
#include "special_numbers.h"

namespace anneal6d {
namespace {

using test::kInfinity;
using test::kNaN;

/// A filter of another state than a pose: a point in the plane that follows a target seen with
/// Gaussian noise.
class PointFilter final : public ParticleFilter<Eigen::Vector2d> {
 public:
  double step = 0.5;   ///< standard deviation of the diffusion
  double noise = 0.5;  ///< and of the measurement
  Eigen::Vector2d target = Eigen::Vector2d::Zero();

 protected:
  void predict(std::span<Eigen::Vector2d> states, const RandomKey& key) override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      RandomKey own = key;
      own.particle = static_cast<std::uint32_t>(i);
      const auto normals = random_normals(own, 0);
      states[i] += step * Eigen::Vector2d(normals[0], normals[1]);
    }
  }
  void measure(std::span<const Eigen::Vector2d> states,
               std::span<double> log_likelihoods) override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      log_likelihoods[i] = -0.5 * (states[i] - target).squaredNorm() / (noise * noise);
    }
  }
  Eigen::Vector2d mean(std::span<const Eigen::Vector2d> states,
                       std::span<const double> weights) const override {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < states.size(); ++i) sum += weights[i] * states[i];
    return sum;
  }
};

class FilteringBy : public testing::TestWithParam<Resampling> {};

TEST_P(FilteringBy, FollowsAMovingPoint) {
  PointFilter filter;
  filter.initialize({0, 0}, 400);
  for (std::uint32_t frame = 0; frame < 60; ++frame) {
    filter.target = {0.3 * frame, 10 * std::sin(0.1 * frame)};
    const Eigen::Vector2d estimate = filter.run_layer({.seed = 1, .frame = frame}, GetParam());
    ASSERT_LT((estimate - filter.target).norm(), 1.5) << "frame " << frame;
  }
}

TEST_P(FilteringBy, ClosesInOnTheTargetFromLayerToLayer) {
  PointFilter filter;
  filter.target = {2.0, -1.0};
  filter.noise = 0.1;
  filter.initialize({0, 0}, 300);
  Eigen::Vector2d estimate = Eigen::Vector2d::Zero();
  filter.step = 2.0;
  for (std::uint32_t layer = 0; layer < 8; ++layer) {
    estimate = filter.run_layer({.seed = 1, .layer = layer}, GetParam());
    filter.step *= 0.5;
  }
  EXPECT_LT((estimate - filter.target).norm(), 0.03);
}

TEST_P(FilteringBy, GivesTheSameForTheSameKey) {
  PointFilter a, b;
  a.target = b.target = {1, 1};
  a.initialize({0, 0}, 50);
  b.initialize({0, 0}, 50);
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    const RandomKey key{.seed = 9, .frame = frame};
    EXPECT_EQ(a.run_layer(key, GetParam()), b.run_layer(key, GetParam()));
  }
  EXPECT_TRUE(std::equal(a.states().begin(), a.states().end(), b.states().begin()));
  EXPECT_NE(a.run_layer({.seed = 10}, GetParam()), b.run_layer({.seed = 11}, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Resampling, FilteringBy,
                         testing::Values(Resampling::multinomial, Resampling::systematic),
                         [](const auto& test) { return parameter_name(test.param); });

/// States are numbers; the test says what each of them is worth, and the hooks are written down.
class ScriptedFilter final : public ParticleFilter<int> {
 public:
  mutable std::string hooks;
  std::vector<int> seen;
  std::vector<double> log_likelihoods;

 protected:
  void predict(std::span<int> states, const RandomKey& key) override {
    hooks += "predict(layer " + std::to_string(key.layer) + ") ";
    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i] = 100 * states[i] + static_cast<int>(i);
    }
  }
  void measure(std::span<const int> states, std::span<double> out) override {
    hooks += "measure ";
    seen.assign(states.begin(), states.end());
    std::copy(log_likelihoods.begin(), log_likelihoods.end(), out.begin());
  }
  int mean(std::span<const int> states, std::span<const double> weights) const override {
    hooks += "mean ";
    double sum = 0;
    for (std::size_t i = 0; i < states.size(); ++i) sum += weights[i] * states[i];
    return static_cast<int>(std::lround(sum));
  }
};

TEST(ParticleFilterLayer, PredictsMeasuresAndTakesTheMeanInThisOrder) {
  ScriptedFilter filter;
  filter.log_likelihoods = {0, 0};
  filter.initialize(1, 2);
  filter.run_layer({.layer = 3}, Resampling::systematic);
  EXPECT_EQ(filter.hooks, "predict(layer 3) measure mean ");
}

TEST(ParticleFilterLayer, DrawsByTheLastWeightsBeforeItPredicts) {
  ScriptedFilter filter;
  filter.initialize(0, 4);
  filter.log_likelihoods = {-kInfinity, -kInfinity, 0, -kInfinity};
  filter.run_layer({}, Resampling::systematic);
  EXPECT_EQ(filter.seen, (std::vector<int>{0, 1, 2, 3}));
  filter.run_layer({}, Resampling::systematic);
  // Only particle 2 was possible: all descend from it.
  EXPECT_EQ(filter.seen, (std::vector<int>{200, 201, 202, 203}));
}

TEST(ParticleFilterLayer, ReturnsTheWeightedMeanAndKnowsTheBest) {
  ScriptedFilter filter;
  filter.initialize(1, 4);
  filter.log_likelihoods = {std::log(1.0), std::log(2.0), std::log(5.0), std::log(2.0)};
  const int mean = filter.run_layer({}, Resampling::systematic);
  EXPECT_EQ(mean, 102);  // 100 + (0*1 + 1*2 + 2*5 + 3*2) / 10 = 101.8
  EXPECT_EQ(filter.best_index(), 2U);
  EXPECT_EQ(filter.best(), 102);
  EXPECT_DOUBLE_EQ(filter.weights()[2], 0.5);
  EXPECT_DOUBLE_EQ(filter.effective_sample_size(), 1 / (0.01 + 0.04 + 0.25 + 0.04));
}

TEST(ParticleFilterLayer, TakesTheFirstOfEquallyGoodParticlesAsTheBest) {
  ScriptedFilter filter;
  filter.initialize(1, 3);
  filter.log_likelihoods = {-1, 0, 0};
  filter.run_layer({}, Resampling::systematic);
  EXPECT_EQ(filter.best_index(), 1U);
}

TEST(ParticleFilterLayer, NeverDividesByZero) {
  for (const double impossible : {-kInfinity, kNaN, -1e308}) {
    ScriptedFilter filter;
    filter.initialize(1, 3);
    filter.log_likelihoods = {impossible, impossible, impossible};
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
      filter.run_layer({.frame = frame}, Resampling::multinomial);
      for (const double weight : filter.weights()) EXPECT_DOUBLE_EQ(weight, 1.0 / 3);
    }
  }
}

TEST(ParticleFilterLayer, KeepsWeightsSummingToOne) {
  ScriptedFilter filter;
  filter.initialize(1, 3);
  filter.log_likelihoods = {-1e5, -1e5 - 3, kNaN};
  filter.run_layer({}, Resampling::systematic);
  EXPECT_NEAR(std::accumulate(filter.weights().begin(), filter.weights().end(), 0.0), 1.0, 1e-15);
  EXPECT_EQ(filter.weights()[2], 0.0);
}

TEST(ParticleFilterStart, PutsEveryParticleAtTheInitialStateWithEqualWeight) {
  ScriptedFilter filter;
  filter.initialize(7, 5);
  ASSERT_EQ(filter.states().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(filter.states()[i], 7);
    EXPECT_DOUBLE_EQ(filter.weights()[i], 0.2);
  }
  EXPECT_DOUBLE_EQ(filter.effective_sample_size(), 5);
}

TEST(ParticleFilterStart, ForgetsWhatWasBefore) {
  ScriptedFilter filter;
  filter.initialize(1, 4);
  filter.log_likelihoods = {0, -1, -2, -3};
  filter.run_layer({}, Resampling::systematic);
  filter.initialize(2, 3);
  EXPECT_EQ(filter.states().size(), 3U);
  EXPECT_EQ(filter.best(), 2);
  filter.run_layer({}, Resampling::systematic);
  EXPECT_EQ(filter.seen, (std::vector<int>{200, 201, 202}));
}

TEST(ParticleFilterStart, WorksWithASingleParticle) {
  ScriptedFilter filter;
  filter.initialize(3, 1);
  filter.log_likelihoods = {-50};
  EXPECT_EQ(filter.run_layer({}, Resampling::multinomial), 300);
  EXPECT_EQ(filter.weights()[0], 1.0);
}

}  // namespace
}  // namespace anneal6d
