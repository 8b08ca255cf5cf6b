// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "bench_trial.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cassert>
#include <chrono>

#include "anneal6d/framework/error.h"
#include "evaluation.h"
#include "interrupt.h"

namespace anneal6d {

namespace {

void run_once(BenchTrial& trial) {
  std::vector<double> step_ms(trial.steps.size());
  const std::size_t repetition = trial.samples_ms.front().size();
  trial.run(repetition, step_ms);
  for (std::size_t i = 0; i < step_ms.size(); ++i) trial.samples_ms[i].push_back(step_ms[i]);
}

}  // namespace

const std::vector<double>& BenchTrial::samples_of(std::string_view step) const {
  const auto found = std::find(steps.begin(), steps.end(), step);
  assert(found != steps.end());
  return samples_ms[static_cast<std::size_t>(found - steps.begin())];
}

double BenchTrial::median_ms(std::string_view step) const {
  return spread_of(samples_of(step)).median;
}

double BenchTrial::p95_ms(std::string_view step) const { return quantile(samples_of(step), 0.95); }

double milliseconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

void measure(std::span<BenchTrial> trials, int turns, double turn_ms, Progress& progress) {
  for (int turn = -1; turn < turns; ++turn) {
    for (BenchTrial& trial : trials) {
      if (interrupted()) throw Error("interrupted; nothing was written");
      if (turn <= 0) trial.samples_ms.assign(trial.steps.size(), {});  // forgets the first run
      double spent_ms = 0;
      do {
        spent_ms += milliseconds_of([&] { run_once(trial); });
      } while (turn >= 0 && spent_ms < turn_ms);
      progress.advance(1, trial.subject.scorer);
    }
  }
}

std::string to_csv(std::span<const BenchTrial> trials) {
  std::string csv =
      "table,scorer,mode,edges,particles,layers,threads,triangles,step,repetition,milliseconds\n";
  for (const BenchTrial& trial : trials) {
    const BenchSubject& s = trial.subject;
    for (std::size_t i = 0; i < trial.steps.size(); ++i) {
      for (std::size_t k = 0; k < trial.samples_ms[i].size(); ++k) {
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{:.6f}\n", s.table, s.scorer, s.mode,
                           s.edges, s.particles, s.layers, s.threads, s.triangles, trial.steps[i],
                           k, trial.samples_ms[i][k]);
      }
    }
  }
  return csv;
}

}  // namespace anneal6d
