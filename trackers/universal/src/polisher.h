// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <vector>

#include "exact_contour.h"
#include "neighbourhood.h"
#include "pose_search.h"
#include "refiner.h"
#include "workers.h"

namespace anneal6d {

/// Has the last word on a frame's pose: views do not tell all false bottoms from the true one, the
/// contour as it is drawn at the pose does.
class Polisher {
 public:
  /// All but the last outlive the polisher. `turn_matters`: the object is no body of revolution.
  Polisher(const Refiner& refiner, const PoseSearch& search, const Neighbourhood& neighbourhood,
           Workers& workers, bool turn_matters)
      : refiner_(refiner),
        search_(search),
        neighbourhood_(neighbourhood),
        workers_(workers),
        turn_matters_(turn_matters) {}

  /// What else is known of the frame.
  struct Scene {
    const ExactContour& exact;    ///< drawn at the refined pose or a degree or so beside it
    const Expectation& expected;  ///< of the motion model
    const Pose& guess;            ///< what it expects, camera_from_object
    Twist blur;                   ///< the object's motion while the shutter is open
    const Appearance& appearance;
  };

  /// A refined pose on the exact contour. One of its neighbours, or the guess, takes its place if
  /// the exact contour likes it better; what polishing would spoil stays as it was.
  Refiner::Result polish(const Refiner::Result& refined, const Scene& scene) const;

 private:
  /// Where rivals of a refined pose are looked for: at the guess and on both sides along each
  /// motion; `blind`: farther along the weakest one.
  std::vector<Pose> rival_starts(const Refiner::Result& refined, const Pose& guess,
                                 bool blind) const;

  const Refiner& refiner_;
  const PoseSearch& search_;
  const Neighbourhood& neighbourhood_;
  Workers& workers_;
  bool turn_matters_;
};

}  // namespace anneal6d
