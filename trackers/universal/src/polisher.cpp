// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "polisher.h"

#include <algorithm>
#include <array>

namespace anneal6d {
namespace {

// Of the weakest motion that edges leave open: more, and the exact contour looks along it in every
// frame, so many steps far.
constexpr double kHardlySeen = 0.3;
constexpr std::array kBlindSteps = {1.0, 2.0};
// Of the exact contour, by which rivals are judged; where edges hardly tell them apart, all of it.
constexpr std::size_t kJudgedPoints = 160;
constexpr double kExactGain = 0.01;  // by which a rival must be likelier: else noise decides
// In evidence, by how much polishing may make a pose less likely: else it stays as it was.
constexpr double kSpoiled = 0.1;

}  // namespace

Refiner::Result Polisher::polish(const Refiner::Result& refined, const Scene& scene) const {
  const ExactContour& exact = scene.exact;
  const Appearance& appearance = scene.appearance;
  const auto polish = [&](const Refiner::Result& start) {
    return refiner_.polish(start, exact.contour(), exact.feigned_share(), scene.blur, appearance);
  };
  // The little that shows a mug's turn while its handle is hidden adds up over frames. The turn
  // of a body of revolution does not matter.
  const bool blind = turn_matters_ && neighbourhood_.unseen_share(refined) > kHardlySeen;
  const std::vector<Pose> starts = rival_starts(refined, scene.guess, blind);
  const auto examine = [&](const Pose& pose) {
    return refiner_.examine_in(exact.contour(), pose, appearance,
                               blind ? Refiner::kMostPolished : kJudgedPoints);
  };
  const auto likelihood_of = [&](const Refiner::Result& result) {
    return search_.likelihood(result, scene.expected);
  };
  std::vector<Pose> poses(1 + starts.size());
  Refiner::Result here;
  workers_.each(poses.size(), 1, [&](std::size_t i) {
    if (i == 0) {
      here = polish(refined);
      poses[0] = here.camera_from_object;
    } else {
      poses[i] =
          refiner_.refine_in(exact.contour(), starts[i - 1], Neighbourhood::kReach_px, appearance);
    }
  });
  poses.erase(
      std::remove_if(poses.begin() + 1, poses.end(),
                     [&](const Pose& other) { return neighbourhood_.same_place(other, poses[0]); }),
      poses.end());
  poses.push_back(refined.camera_from_object);
  std::vector<Refiner::Result> examined(poses.size());
  workers_.each(poses.size(), 1, [&](std::size_t i) { examined[i] = examine(poses[i]); });
  const Refiner::Result unpolished = examined.back();
  examined.pop_back();
  const auto rival = std::max_element(
      examined.begin(), examined.end(),
      [&](const auto& a, const auto& b) { return likelihood_of(a) < likelihood_of(b); });
  Refiner::Result best = here;
  double most = likelihood_of(examined[0]);
  bool elsewhere = false;
  if (rival != examined.begin()) {
    const Refiner::Result there = polish(*rival);
    const double likely = likelihood_of(examine(there.camera_from_object));
    if (likely > most + kExactGain) {
      best = there;
      most = likely;
      elsewhere = true;
    }
  }
  const Refiner::Result& rough =
      likelihood_of(*rival) > likelihood_of(unpolished) ? *rival : unpolished;
  if (likelihood_of(rough) > most + kSpoiled) {
    best.camera_from_object = rough.camera_from_object;
    elsewhere = true;
  }
  if (elsewhere) {
    best.support = refiner_.examine(best.camera_from_object, appearance).support;
  }
  return best;
}

std::vector<Pose> Polisher::rival_starts(const Refiner::Result& refined, const Pose& guess,
                                         bool blind) const {
  std::vector<Pose> starts{guess};
  const auto look_along = [&](std::uint32_t motion, double steps) {
    for (const Pose& start : neighbourhood_.beside(refined, motion, steps)) starts.push_back(start);
  };
  if (blind) {
    for (const double steps : kBlindSteps) look_along(0, steps);
  }
  for (std::uint32_t motion = blind ? 1 : 0; motion < Neighbourhood::kMotions; ++motion) {
    look_along(motion, 1.0);
  }
  return starts;
}

}  // namespace anneal6d
