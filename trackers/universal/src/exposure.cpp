// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "exposure.h"

#include <algorithm>
#include <cmath>

namespace anneal6d {
namespace {

constexpr double kBinFading = 0.05;  // of what was seen, with each frame
constexpr double kBin_px = 1.5;
constexpr double kLeastEdges = 5;  // in a bin that says something
constexpr double kSpread = 0.1;    // standard deviation of the sharpness of edges, px^-2
constexpr double kSureness = 4.0;  // standard deviations: edges differ, too

}  // namespace

void Exposure::observe(std::span<const MovedEdge> edges) {
  if (edges.empty()) return;
  for (Bin& bin : bins_) {
    bin.count *= 1 - kBinFading;
    bin.sharpness *= 1 - kBinFading;
    bin.moved2 *= 1 - kBinFading;
  }
  for (const MovedEdge& edge : edges) {
    const auto place = static_cast<int>(edge.moved_px / kBin_px);
    if (edge.sharpness <= 0 || place >= kBins) continue;
    Bin& bin = bins_[static_cast<std::size_t>(place)];
    bin.count += 1;
    bin.sharpness += edge.sharpness;
    bin.moved2 += static_cast<double>(edge.moved_px) * edge.moved_px;
  }
  share_ = fitted_share();
}

double Exposure::fitted_share() const {
  // A line through variances over squared motions, weighted by how well each is known: 1 / (2 m)
  // for a mean sharpness m, whose error it has times 1 / (2 m^2).
  double weights = 0, mean_x = 0, mean_y = 0;
  const auto each = [&](const auto& use) {
    for (const Bin& bin : bins_) {
      if (bin.count < kLeastEdges) continue;
      const double sharpness = bin.sharpness / bin.count;
      const double error = kSpread / (2 * sharpness * sharpness);
      use(bin.moved2 / bin.count, 1 / (2 * sharpness), bin.count / (error * error));
    }
  };
  each([&](double x, double y, double weight) {
    weights += weight;
    mean_x += weight * x;
    mean_y += weight * y;
  });
  if (weights <= 0) return 0;
  mean_x /= weights;
  mean_y /= weights;
  double xx = 0, xy = 0;
  each([&](double x, double y, double weight) {
    xx += weight * (x - mean_x) * (x - mean_x);
    xy += weight * (x - mean_x) * (y - mean_y);
  });
  if (xx <= 0) return 0;
  const double slope = xy / xx;
  if (slope < kSureness / std::sqrt(xx)) return 0;
  return std::min(1.0, std::sqrt(12 * slope));
}

}  // namespace anneal6d
