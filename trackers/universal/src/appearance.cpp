// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "appearance.h"

#include <algorithm>
#include <cmath>

namespace anneal6d {
namespace {

constexpr float kLearningRate = 0.2F;  // as SRT3D (Stoiber et al., IJCV 2022)
constexpr std::size_t kFewest = 100;   // pixels
constexpr float kUnseen = 4e-4F;       // frequency below which a colour says nothing
constexpr float kForgotten = 4e-6F;    // too little to change the odds by a step

}  // namespace

Appearance::Appearance(int channels)
    : channels_(channels),
      object_(channels == 1 ? kGreyLevels : kLevels * kLevels * kLevels),
      beside_(object_.size()),
      log_odds_(object_.size() + 3) {}

void Appearance::learn(const std::vector<std::uint16_t>& object,
                       const std::vector<std::uint16_t>& beside) {
  if (object.size() < kFewest || beside.size() < kFewest) return;
  const float rate = learned_ ? kLearningRate : 1.0F;
  for (const std::uint16_t bin : seen_) {
    object_[bin] *= 1.0F - rate;
    beside_[bin] *= 1.0F - rate;
  }
  const auto take_in = [&](const std::vector<std::uint16_t>& bins, std::vector<float>& frequency) {
    const float share = rate / static_cast<float>(bins.size());
    for (const std::uint16_t bin : bins) {
      if (object_[bin] == 0.0F && beside_[bin] == 0.0F) seen_.push_back(bin);
      frequency[bin] += share;
    }
  };
  take_in(object, object_);
  take_in(beside, beside_);
  learned_ = true;
  std::erase_if(seen_, [&](std::uint16_t bin) {
    const bool forgotten = object_[bin] + beside_[bin] < kForgotten;
    if (forgotten) object_[bin] = beside_[bin] = 0.0F;
    const float odds = std::log((object_[bin] + kUnseen) / (beside_[bin] + kUnseen));
    const float limit = kLimit;
    log_odds_[bin] =
        static_cast<std::int8_t>(std::lround(std::clamp(odds * kScale, -limit, limit)));
    return forgotten;
  });
}

}  // namespace anneal6d
