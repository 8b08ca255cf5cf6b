// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// The particle filter skeleton with another kind of state: a point that walks over a plane, of
// which only the noisy distances to three beacons are measured.
//
//   03_particle_filter_2d

#include <Eigen/Core>
#include <array>
#include <cstdio>

#include "anneal6d/framework/particle_filter.h"

namespace {

using Eigen::Vector2d;

constexpr double kStep_mm = 5;   // the point's, from time to time, standard deviation
constexpr double kNoise_mm = 2;  // of a distance
const std::array<Vector2d, 3> kBeacons_mm = {Vector2d(0, 0), Vector2d(400, 0), Vector2d(0, 300)};

Vector2d random_step(const anneal6d::RandomKey& key, double sigma) {
  const auto [x, y] = anneal6d::random_normals(key, 0);
  return sigma * Vector2d(x, y);
}

class PointFilter final : public anneal6d::ParticleFilter<Vector2d> {
 public:
  void observe(const std::array<double, 3>& distances_mm) { distances_mm_ = distances_mm; }

 protected:
  void predict(std::span<Vector2d> points, const anneal6d::RandomKey& key) override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      anneal6d::RandomKey own = key;
      own.particle = static_cast<std::uint32_t>(i);
      points[i] += random_step(own, kStep_mm);
    }
  }

  void measure(std::span<const Vector2d> points, std::span<double> log_likelihoods) override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      log_likelihoods[i] = 0;
      for (std::size_t k = 0; k < kBeacons_mm.size(); ++k) {
        const double error = ((points[i] - kBeacons_mm[k]).norm() - distances_mm_[k]) / kNoise_mm;
        log_likelihoods[i] -= 0.5 * error * error;
      }
    }
  }

  Vector2d mean(std::span<const Vector2d> points, std::span<const double> weights) const override {
    Vector2d sum = Vector2d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * points[i];
    return sum;
  }

 private:
  std::array<double, 3> distances_mm_{};
};

}  // namespace

int main() {
  constexpr std::uint32_t kTimes = 50;
  constexpr std::uint64_t kWorldSeed = 2;
  constexpr std::uint64_t kFilterSeed = 1;

  Vector2d truth(150, 120);
  PointFilter filter;
  filter.initialize(truth, 500);
  double sum_of_errors = 0;
  for (std::uint32_t time = 1; time <= kTimes; ++time) {
    truth += random_step({kWorldSeed, time, 0, 0}, kStep_mm);
    std::array<double, 3> distances_mm;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double noise = anneal6d::random_normals({kWorldSeed, time, 1, k}, 0)[0];
      distances_mm[k] = (truth - kBeacons_mm[k]).norm() + kNoise_mm * noise;
    }
    filter.observe(distances_mm);
    const Vector2d estimate =
        filter.run_layer({kFilterSeed, time, 0, 0}, anneal6d::Resampling::systematic);
    sum_of_errors += (estimate - truth).norm();
    std::printf("time %2u  truth %7.2f %7.2f  estimate %7.2f %7.2f mm  effective samples %5.1f\n",
                time, truth.x(), truth.y(), estimate.x(), estimate.y(),
                filter.effective_sample_size());
  }
  std::printf("mean error %.2f mm\n", sum_of_errors / kTimes);
}
