// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "shading_share.h"

#include <algorithm>

namespace anneal6d {
namespace {

constexpr double kEvidenceFading = 0.05;  // of what was seen, with each frame

}  // namespace

void ShadingShare::observe(const ShadingEvidence& evidence) {
  if (!(evidence.information_px2 > 0)) return;
  const double explained_px2 = evidence.left_px2 + share_ * evidence.information_px2;
  information_px2_ += evidence.information_px2 - kEvidenceFading * information_px2_;
  explained_px2_ += explained_px2 - kEvidenceFading * explained_px2_;
  share_ = std::clamp(explained_px2_ / (kReliability * information_px2_), 0.0, 1.0);
}

}  // namespace anneal6d
