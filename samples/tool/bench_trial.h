// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "progress.h"

namespace anneal6d {

/// What a trial is about: the columns that tell the rows of `bench --out` apart. What does not
/// apply is empty or 0.
struct BenchSubject {
  std::string table = {};  ///< "scorer", "frame", "steps", "draw"
  std::string scorer = {}, mode = {}, edges = {};
  int particles = 0;  ///< a layer; of the table "scorer": poses a sample
  int layers = 0;
  int threads = 0;  ///< CPU threads, 0: all
  int triangles = 0;

  bool operator==(const BenchSubject&) const = default;
};

/// Something to time, again and again.
struct BenchTrial {
  BenchSubject subject = {};
  std::vector<std::string> steps = {};  ///< names of what is timed on its own
  /// Runs once and fills in the milliseconds of each step; `repetition` counts from 0.
  std::function<void(std::size_t repetition, std::span<double> step_ms)> run = {};
  std::vector<std::vector<double>> samples_ms = {};  ///< of each step; filled by `measure`

  /// The median and the 95 % quantile of a step's samples.
  double median_ms(std::string_view step) const;
  double p95_ms(std::string_view step) const;

 private:
  const std::vector<double>& samples_of(std::string_view step) const;
};

/// Milliseconds that `work` takes.
double milliseconds_of(const std::function<void()>& work);

/// Runs every trial once, so that what happens only once is done, and then `turns` times in turn,
/// so that what disturbs the machine disturbs all of them alike. What is quick repeats until its
/// turn has lasted `turn_ms`. Throws Error on Ctrl-C, and what the trials throw.
void measure(std::span<BenchTrial> trials, int turns, double turn_ms, Progress& progress);

/// The samples as CSV, one a line, below a line of names.
std::string to_csv(std::span<const BenchTrial> trials);

}  // namespace anneal6d
