// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>

#include "anneal6d/framework/random.h"

namespace anneal6d {

/// What a simulation draws random numbers for. The values lie far from the layers of a particle
/// filter: a tracker that is given the same seed must not draw the very steps that it has to find.
enum class SimulationStream : std::uint32_t {
  motion = 0x53494D00,
  noise,
  clutter,
  occluder,
};

inline RandomKey simulation_key(std::uint64_t seed, SimulationStream stream,
                                std::uint32_t frame = 0, std::uint32_t item = 0) {
  return {seed, frame, static_cast<std::uint32_t>(stream), item};
}

}  // namespace anneal6d
