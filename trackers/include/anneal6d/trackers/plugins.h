// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include "anneal6d/framework/pose_scorer.h"
#include "anneal6d/framework/rigid_object_tracker.h"

namespace anneal6d {

/// The trackers of this module: "universal".
TrackerTable tracker_plugins();

/// The scorers of this module, which need nothing but the processor: "cpu"
/// and "sparse".
ScorerTable cpu_scorer_plugins();

}  // namespace anneal6d
