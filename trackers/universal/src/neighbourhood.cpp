// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "neighbourhood.h"

#include <algorithm>

#include "twist.h"

namespace anneal6d {
namespace {

constexpr double kStep_px = 4.0, kStepAside_px = 3.0;
constexpr double kApart_px = 1.0;  // less is the same place

}  // namespace

std::array<Pose, 2> Neighbourhood::beside(const Refiner::Result& refined, std::uint32_t motion,
                                          double steps) const {
  const Pose center = with_origin_at(center_mm_, refined.camera_from_object);
  const Twist step = motion % 2 == 0 ? Twist(kStep_px * steps * refined.weak_motions[motion / 2])
                                     : Twist(kStepAside_px * steps * mm_per_px(center, focal_px_) *
                                             Twist::Unit(motion == 1 ? 4 : 3));
  return {with_origin_at(-center_mm_, moved(center, -step)),
          with_origin_at(-center_mm_, moved(center, step))};
}

bool Neighbourhood::same_place(const Pose& a, const Pose& b) const {
  const Pose center = with_origin_at(center_mm_, a);
  const Twist apart = twist_between(center, with_origin_at(center_mm_, b));
  return displacement_mm(apart, radius_mm_) < kApart_px * mm_per_px(center, focal_px_);
}

double Neighbourhood::unseen_share(const Refiner::Result& refined) const {
  const Twist& weakest = refined.weak_motions[0];
  return displacement_mm(refined.unseen * weakest, radius_mm_) /
         std::max(1e-9, displacement_mm(weakest, radius_mm_));
}

}  // namespace anneal6d
