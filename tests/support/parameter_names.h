// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// How GoogleTest names and prints the parameters of tests.
#pragma once

#include <ostream>
#include <string>

#include "anneal6d/framework/rating.h"
#include "anneal6d/framework/resampling.h"

namespace anneal6d {

inline std::string parameter_name(Resampling resampling) {
  return resampling == Resampling::multinomial ? "Multinomial" : "Systematic";
}

inline std::string parameter_name(RatingRule rule) {
  switch (rule) {
    case RatingRule::ratio:
      return "Ratio";
    case RatingRule::normalized:
      return "Normalized";
    case RatingRule::balanced:
      return "Balanced";
  }
  return "Unknown";
}

// GoogleTest finds these by the namespace of their arguments.
// NOLINTBEGIN(readability-identifier-naming)
inline void PrintTo(Resampling resampling, std::ostream* stream) {
  *stream << parameter_name(resampling);
}
inline void PrintTo(RatingRule rule, std::ostream* stream) { *stream << parameter_name(rule); }
// NOLINTEND(readability-identifier-naming)

}  // namespace anneal6d
