// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/trackers/plugins.h"

#include "anneal6d/trackers/universal_tracker.h"
#include "cpu_scorer.h"
#include "sparse_scorer.h"

namespace anneal6d {
namespace {

std::string always_available() { return {}; }

}  // namespace

TrackerTable tracker_plugins() {
  return {{"universal", "annealed particle filter on rendered edges, objects of any shape",
           always_available, make_universal_tracker}};
}

ScorerTable cpu_scorer_plugins() {
  return {{"cpu", "exact, own rasterizer and edge counting on all cores, no GPU", always_available,
           make_cpu_scorer},
          {"sparse", "edge points of precomputed views, projected and looked up: the quickest",
           always_available, make_sparse_scorer}};
}

}  // namespace anneal6d
