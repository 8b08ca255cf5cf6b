// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "anneal6d/framework/particle_filter.h"
#include "anneal6d/framework/pose_scorer.h"
#include "anneal6d/framework/rating.h"
#include "region_cue.h"
#include "twist.h"
#include "workers.h"

namespace anneal6d {

/// The particle filter over poses of the thesis (ParticleFilter6D): states are camera_from_center,
/// the frame at the centre of the object's box, so that turning a particle does not shift it.
class PoseFilter final : public ParticleFilter<Pose> {
 public:
  /// What one layer does beside drawing particles.
  struct Layer {
    Twist drift = Twist::Zero();  ///< added to every particle (thesis Alg. 3)
    /// Factor L of the covariance L L^T of the diffusion, a twist's entries.
    Eigen::Matrix<double, 6, 6> diffusion = Eigen::Matrix<double, 6, 6>::Zero();
    /// Takes the place of the first particle, as it is: the best that is known so far.
    std::optional<Pose> incumbent;
    /// What the motion model expects: deviations of `expected_sigma` cost `expectation` times half
    /// their squares in logarithmic likelihood. Annealing alone would forget where the layers
    /// began.
    Pose expected;
    Twist expected_sigma = Twist::Ones();
    double expectation = 0;
    /// Share of particles to stay effective, by raising the weights to a power (Deutscher et al.
    /// 2000); 0: weights as rated.
    double survival_rate = 0;
    /// Weight of the colours beside the edges, as the rating's c; 0: none.
    double region_weight = 0;
  };

  /// `scorer` and `workers` outlive the filter. `center_mm`: the centre of the object, object
  /// frame.
  PoseFilter(PoseScorer& scorer, const RatingOptions& rating, const Eigen::Vector3d& center_mm,
             Workers& workers);

  /// Colours to rate poses by, beside the scorer; outlives the filter.
  void set_region_cue(const RegionCue& region) { region_ = &region; }

  void set_layer(const Layer& layer) { layer_ = layer; }

  /// Weighted covariance of the particles about `center`, as twists.
  Eigen::Matrix<double, 6, 6> covariance(const Pose& camera_from_center) const;

  Pose to_center(const Pose& camera_from_object) const;
  Pose to_object(const Pose& camera_from_center) const;

 protected:
  void predict(std::span<Pose> states, const RandomKey& key) override;
  void measure(std::span<const Pose> states, std::span<double> log_likelihoods) override;
  Pose mean(std::span<const Pose> states, std::span<const double> weights) const override;

 private:
  PoseScorer& scorer_;
  RatingOptions rating_;
  Eigen::Vector3d center_mm_;
  Workers& workers_;
  const RegionCue* region_ = nullptr;
  Layer layer_;
  std::vector<double> agreements_;
  std::vector<Pose> camera_from_object_;
  std::vector<EdgeMatch> matches_;
};

}  // namespace anneal6d
