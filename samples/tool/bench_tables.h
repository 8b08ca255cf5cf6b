// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <span>
#include <string>

#include "bench_trial.h"

namespace anneal6d {

// Tables for people from measured trials, each with a title above and an empty line below. Where
// the scorer `reference` was measured with the same settings, they tell how many times as fast the
// others are.

/// Of `scorer_trials`: poses a second.
std::string scorer_table(std::span<const BenchTrial> trials);

/// Of `frame_trials`, the thesis's mode: a frame by edges, particles and layers.
std::string frame_table(std::span<const BenchTrial> trials);

/// Of `frame_trials`: the stages of a frame, with the most particles and layers and in the default
/// mode.
std::string stage_table(std::span<const BenchTrial> trials);

/// Of `step_trials`.
std::string step_table(std::span<const BenchTrial> trials);

/// Of `draw_trials`.
std::string draw_table(std::span<const BenchTrial> trials);

}  // namespace anneal6d
