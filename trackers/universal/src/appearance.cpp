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

}  // namespace

Appearance::Appearance(int channels)
    : channels_(channels),
      object_(channels == 1 ? kGreyLevels : kLevels * kLevels * kLevels),
      beside_(object_.size()),
      log_odds_(object_.size()) {}

void Appearance::learn(const std::vector<std::uint16_t>& object,
                       const std::vector<std::uint16_t>& beside) {
  if (object.size() < kFewest || beside.size() < kFewest) return;
  const float rate = learned_ ? kLearningRate : 1.0F;
  const auto take_in = [rate](const std::vector<std::uint16_t>& bins,
                              std::vector<float>& frequency) {
    for (float& value : frequency) value *= 1.0F - rate;
    const float share = rate / static_cast<float>(bins.size());
    for (const std::uint16_t bin : bins) frequency[bin] += share;
  };
  take_in(object, object_);
  take_in(beside, beside_);
  learned_ = true;
  for (std::size_t i = 0; i < log_odds_.size(); ++i) {
    if (object_[i] == 0.0F && beside_[i] == 0.0F) {
      log_odds_[i] = 0;
      continue;
    }
    const float odds = std::log((object_[i] + kUnseen) / (beside_[i] + kUnseen));
    const float limit = kLimit;
    log_odds_[i] = static_cast<std::int8_t>(std::lround(std::clamp(odds * kScale, -limit, limit)));
  }
}

}  // namespace anneal6d
