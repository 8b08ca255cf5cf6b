// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <span>

#include "anneal6d/framework/pose_scorer.h"

namespace anneal6d {

/// The ways to turn counted edge pixels into the likelihood of a particle.
enum class RatingRule {
  ratio,       ///< thesis Alg. 4: exp(-c (1 - matched / rendered))
  normalized,  ///< thesis Alg. 5: exp(-c (1 - sum c_k pi_k)) after min-max normalisation
  balanced,  ///< exp(-c (1 - pi)), pi = matched / mean(rendered, typical): missing edges count, too
};

/// Constants of the rules. The terms of `normalized` are pi_1 = matched/rendered of the raw counts,
/// pi_2 = (normalised matched)^2, pi_3 = (normalised rendered)^2 (thesis 4.2.3).
///
/// The thesis's example for two poses, c1 = 0.4, c2 = 2, c3 = 4, does not track: pi_3 pays for
/// rendered pixels whether they match or not, so that each layer is won by the pose nearest to the
/// camera. The defaults do without it and sum to 1, so that likelihoods stay at most 1.
struct RatingOptions {
  RatingRule rule = RatingRule::balanced;
  double c = 20.0;  ///< steepness, > 0
  double c1 = 0.6;  ///< weights of the terms of `normalized`, >= 0
  double c2 = 0.4;
  double c3 = 0.0;

  /// Throws ConfigError naming the bad field.
  void validate() const;
};

/// Logarithms of the likelihoods of all particles (thesis Alg. 4, 5), at most 0 for the rules that
/// are bounded; -infinity for a pose of which nothing was rendered. Both spans have the same
/// length.
///
/// `balanced` holds a pose's matches against the mean of its own rendered pixels and of the batch's
/// median: a far pose of few pixels that all match cannot win (thesis 4.2.3, "disappearing in z"),
/// and neither can a near one of many.
void rate(const RatingOptions& options, std::span<const EdgeMatch> matches,
          std::span<double> log_likelihoods);

/// matched / rendered, 0 if nothing was rendered.
double match_ratio(const EdgeMatch& match);

}  // namespace anneal6d
