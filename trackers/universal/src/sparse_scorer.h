// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <memory>

#include "anneal6d/framework/pose_scorer.h"

namespace anneal6d {

/// The `sparse` scorer: instead of drawing the object it looks up a few hundred edge pixels, drawn
/// once per model from all around it, where the pose puts them in the frame's edge image. Counts
/// are scaled to mean what those of the exact scorers mean.
std::unique_ptr<PoseScorer> make_sparse_scorer(const ScorerSetup& setup);

}  // namespace anneal6d
