// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/rating.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void extend(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Where all values are equal, none is better: 0.
  double normalized(double value) const { return high > low ? (value - low) / (high - low) : 0.0; }
};

/// Alg. 5 with the terms of 4.2.3.
void rate_normalized(const RatingOptions& options, std::span<const EdgeMatch> matches,
                     std::span<double> log_likelihoods) {
  Range rendered, matched;
  for (const EdgeMatch& match : matches) {
    rendered.extend(match.rendered);
    matched.extend(match.matched);
  }
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double pi1 = match_ratio(matches[i]);
    const double pi2 = std::pow(matched.normalized(matches[i].matched), 2);
    const double pi3 = std::pow(rendered.normalized(matches[i].rendered), 2);
    log_likelihoods[i] =
        -options.c * (1.0 - (options.c1 * pi1 + options.c2 * pi2 + options.c3 * pi3));
  }
}

double median_rendered(std::span<const EdgeMatch> matches) {
  std::vector<std::int32_t> counts;
  counts.reserve(matches.size());
  for (const EdgeMatch& match : matches) counts.push_back(match.rendered);
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  return *middle;
}

void rate_balanced(const RatingOptions& options, std::span<const EdgeMatch> matches,
                   std::span<double> log_likelihoods) {
  const double typical = median_rendered(matches);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double expected = 0.5 * (matches[i].rendered + typical);
    log_likelihoods[i] = -options.c * (1.0 - matches[i].matched / std::max(1.0, expected));
  }
}

}  // namespace

void RatingOptions::validate() const {
  const auto check = [](const char* name, double value, bool good) {
    if (!good || !std::isfinite(value)) {
      throw ConfigError(std::string("rating constant ") + name + " = " + std::to_string(value) +
                        " is out of range");
    }
  };
  check("c", c, c > 0);
  check("c1", c1, c1 >= 0);
  check("c2", c2, c2 >= 0);
  check("c3", c3, c3 >= 0);
}

double match_ratio(const EdgeMatch& match) {
  return match.rendered > 0 ? static_cast<double>(match.matched) / match.rendered : 0.0;
}

void rate(const RatingOptions& options, std::span<const EdgeMatch> matches,
          std::span<double> log_likelihoods) {
  assert(matches.size() == log_likelihoods.size());
  if (matches.empty()) return;
  switch (options.rule) {
    case RatingRule::ratio:
      for (std::size_t i = 0; i < matches.size(); ++i) {
        log_likelihoods[i] = -options.c * (1.0 - match_ratio(matches[i]));
      }
      break;
    case RatingRule::normalized:
      rate_normalized(options, matches, log_likelihoods);
      break;
    case RatingRule::balanced:
      rate_balanced(options, matches, log_likelihoods);
      break;
  }
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].rendered <= 0) log_likelihoods[i] = kImpossible;
  }
}

}  // namespace anneal6d
