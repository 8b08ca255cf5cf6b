// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cmath>
#include <vector>

#include "anneal6d/framework/pose_scorer.h"
#include "pose_filter.h"
#include "refiner.h"
#include "workers.h"

namespace anneal6d {

/// What the motion model knows before a frame was looked at: camera_from_center and the deviations
/// to expect from it.
struct Expectation {
  Pose camera_from_center;
  Twist sigma = Twist::Ones();

  /// Evidence that a pose (camera_from_center) loses for being far from what was expected: decides
  /// between poses that look the same. As Student's t has it: a motion three times as large as
  /// expected is not nine times as strange.
  double strangeness(const Pose& pose) const {
    constexpr double kWeight = 0.1, kFreedom = 8;
    const double squared_deviation =
        twist_between(camera_from_center, pose).cwiseQuotient(sigma).squaredNorm();
    return kWeight * std::log1p(squared_deviation / kFreedom);
  }
};

/// Looks for the object with an annealed particle filter: layers of particles, rated by edges and
/// colours, close in on the best basins, and the refinement finds the bottom of each. Where
/// something hides a part of the object, particles are led off by a few pixels, and among clutter
/// basins are not wider than that: from the best of them hops may lead on to a better one. Colours
/// that were learned lead starts and hops nearer before they are refined.
class PoseSearch {
 public:
  struct Effort {
    int particles = 0;  ///< a layer
    int layers = 0;
  };

  /// `filter`, `refiner` and `workers` outlive the search.
  PoseSearch(PoseFilter& filter, const Refiner& refiner, Workers& workers, const Effort& effort,
             double radius_mm);

  struct ColourCue {
    const Appearance& appearance;
    double weight = 0;  ///< beside the edges, as the rating's c
  };

  /// What tells the right one of several refined poses: evidence, less what is lost for
  /// strangeness.
  double likelihood(const Refiner::Result& result, const Expectation& expected) const;

  /// The likeliest refined pose. `key` decides the random numbers, but for its layer. `focal_px`
  /// translates pixels to millimetres.
  Refiner::Result run(const Expectation& expected, const ColourCue& colours, RandomKey key,
                      double focal_px);

  /// Hops from basin to basin (Wales and Doye, J. Phys. Chem. A 1997; never to a worse one): poses
  /// a few pixels beside the best one are refined. Returns the best that is found, or what was
  /// given.
  Refiner::Result hop_from(const Refiner::Result& start, const Expectation& expected,
                           const Appearance& appearance, RandomKey key, double focal_px);

 private:
  /// What brings a pose nearer before edges do: colours from farther off, where edges lead astray,
  /// but not where an object's colours are those beside it.
  enum class Lead { edges, colours };
  /// A pose led nearer and refined.
  Refiner::Result refined(const Pose& camera_from_center, Lead lead, double reach_px,
                          const Expectation& expected, const Appearance& appearance) const;
  /// A pose a few pixels beside another; `key` decides which.
  Pose beside(const Pose& camera_from_center, const RandomKey& key, double focal_px) const;
  /// The best particles that differ from each other.
  void collect_starts();
  /// Factor of a share of the particles' covariance, no narrower than a fraction of a pixel.
  Eigen::Matrix<double, 6, 6> narrowed_spread(const Pose& mean, double focal_px) const;

  PoseFilter& filter_;
  const Refiner& refiner_;
  Workers& workers_;
  Effort effort_;
  double radius_mm_;
  std::vector<Pose> starts_;
  std::vector<Refiner::Result> found_;  ///< from each start, or by each hop
  std::vector<std::size_t> order_;
};

}  // namespace anneal6d
