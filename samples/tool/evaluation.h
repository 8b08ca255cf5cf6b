// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/symmetry.h"

namespace anneal6d {

/// An estimate against the truth.
struct PoseError {
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();  ///< estimate - truth, camera frame
  double rotation_deg = 0;  ///< smallest angle over the object's symmetry

  /// Both errors lie below the limits.
  bool is_within(double limit_mm, double limit_deg) const {
    return translation_mm.norm() < limit_mm && rotation_deg < limit_deg;
  }
};

/// Compares two camera_from_object poses.
PoseError pose_error(const Pose& estimate, const Pose& truth, const Symmetry& symmetry);

/// A frame succeeds below both: the limits of the `rbot` protocol.
inline constexpr double kSuccess_mm = 50;
inline constexpr double kSuccess_deg = 5;
/// The stricter pair that is reported beside them.
inline constexpr double kPrecise_mm = 10;
inline constexpr double kPrecise_deg = 2;

/// Mean, median (of an even count: the mean of the middle two) and maximum.
struct Spread {
  double mean = 0;
  double median = 0;
  double max = 0;
};

/// `values` is not empty.
Spread spread_of(std::vector<double> values);

/// The smallest value that at least `share` (0..1) of the values do not exceed (nearest rank).
/// `values` is not empty.
double quantile(std::vector<double> values, double share);

/// An estimated frame for which the truth is known. A frame whose pose was given is none.
struct JudgedFrame {
  PoseError error;
  double milliseconds = 0;  ///< of `track()` alone
  std::int64_t frame = 0;   ///< its index in the sequence
  double quality = 0;       ///< that the tracker gave
  bool restarted = false;   ///< the tracker was reset to the truth afterwards
};

/// What one sequence came to, or the mean of several.
struct Summary {
  std::string name;
  double frames = 0;         ///< judged: estimated and with ground truth
  double broken_frames = 0;  ///< could not be read
  double restarts = 0;       ///< resets to the ground truth after a failed frame
  double success_share = 0;  ///< of the judged frames: within kSuccess_mm and kSuccess_deg
  double precise_share = 0;  ///< within kPrecise_mm and kPrecise_deg
  std::array<Spread, 3> translation_mm;  ///< absolute errors along the camera's x, y, z
  Spread rotation_deg;
  double median_ms = 0;
  double p95_ms = 0;
};

/// Summarises one sequence; the counts of broken frames and restarts are the caller's. Throws
/// Error if no frame was judged.
Summary summarise(std::string name, std::span<const JudgedFrame> frames);

/// The mean of each number, every sequence counting alike. `summaries` is not empty.
Summary mean_of(std::span<const Summary> summaries);

/// The keys of summary.json.
nlohmann::ordered_json to_json(const Summary& summary);

/// A table for people, one line a sequence and, for several, their mean.
std::string to_table(std::span<const Summary> summaries);

}  // namespace anneal6d
