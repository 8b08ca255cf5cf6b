// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include "twist.h"

namespace anneal6d {

/// First-order autoregressive motion on SE(3): the next motion is a share of the last one plus
/// noise (after Choi and Christensen, IJRR 2012). The share and the noise are learned from what was
/// seen: a hand moves smoothly (share near 1), a random walk does not (share near 0).
class MotionModel {
 public:
  /// Expected motion a frame and axis before anything was seen.
  MotionModel(double sigma_mm, double sigma_rad);

  void reset();

  /// The object went from one pose to the other within one frame.
  void observe(const Pose& before, const Pose& after);

  /// What to add to the last pose.
  Twist drift() const;

  /// Standard deviation of what the drift leaves open, for each entry of a twist.
  Twist sigma() const;

  /// The same as it was lately, without a margin or bounds.
  Twist seen_sigma() const;

 private:
  /// Running moments of the rotation or of the translation of the last motions.
  struct Moments {
    double lagged = 0;      ///< mean of v_t . v_(t-1), per axis
    double square = 0;      ///< mean of v_t . v_t, per axis
    double innovation = 0;  ///< mean squared difference from the drift, per axis
    double share() const;
  };

  double initial_sigma_[2];  ///< rotation (rad), translation (mm)
  Moments moments_[2];
  Twist last_motion_;
};

}  // namespace anneal6d
