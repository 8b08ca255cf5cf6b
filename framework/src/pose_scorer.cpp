// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/pose_scorer.h"

#include "anneal6d/framework/error.h"

namespace anneal6d {

void ScorerSetup::validate() const {
  if (!mesh) throw ConfigError("a scorer needs a mesh");
  camera.validate();
  edges.validate();
  if (!edges.threshold) {
    throw ConfigError("the edges of rendered objects need a threshold that is a number, not auto");
  }
  if (threads < 0) throw ConfigError("threads: " + std::to_string(threads) + " is negative");
}

}  // namespace anneal6d
