// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "anneal6d/framework/pose_file.h"
#include "evaluation.h"
#include "tracking_job.h"

namespace anneal6d {

/// A frame with the estimated pose drawn over it (green, red when lost) and the true one (magenta,
/// where it differs).
struct EvaluationPicture {
  std::string caption;
  std::string jpeg;  ///< the bytes of a JPEG file, at most 640 pixels wide
};

/// The judged frame that is furthest off, in multiples of kPrecise_mm or kPrecise_deg. `frames` is
/// not empty.
const JudgedFrame& worst_of(std::span<const JudgedFrame> frames);

/// The first, the worst and the last of the judged frames of the sequence folder that `job` ran
/// through; it is read again. `rows` has the estimated and `truth` the true poses. Without OpenGL
/// there are none. Throws FileError and what renderers throw.
std::vector<EvaluationPicture> paint_pictures(const TrackingJob& job, std::span<const PoseRow> rows,
                                              std::span<const JudgedFrame> judged,
                                              const std::map<std::int64_t, Pose>& truth);

}  // namespace anneal6d
