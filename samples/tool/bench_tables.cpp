// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "bench_tables.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "bench_trials.h"

namespace anneal6d {

namespace {

/// The trial of another scorer with the same settings; null if it was not measured.
const BenchTrial* counterpart(std::span<const BenchTrial> trials, const BenchTrial& trial,
                              const std::string& scorer) {
  BenchSubject wanted = trial.subject;
  wanted.scorer = scorer;
  const auto found = std::find_if(trials.begin(), trials.end(),
                                  [&](const BenchTrial& other) { return other.subject == wanted; });
  return found == trials.end() ? nullptr : &*found;
}

/// "12.3x", or "-" if there is nothing to compare with.
std::string speed_up(std::span<const BenchTrial> trials, const BenchTrial& trial,
                     std::string_view step) {
  const BenchTrial* const reference = counterpart(trials, trial, "reference");
  if (!reference) return "-";
  return fmt::format("{:.1f}x", reference->median_ms(step) / trial.median_ms(step));
}

/// The scorers in the order of their first appearance.
std::vector<std::string> scorers_of(std::span<const BenchTrial> trials) {
  std::vector<std::string> scorers;
  for (const BenchTrial& trial : trials) {
    const std::string& scorer = trial.subject.scorer;
    if (std::find(scorers.begin(), scorers.end(), scorer) == scorers.end()) {
      scorers.push_back(scorer);
    }
  }
  return scorers;
}

std::string threads_text(int threads) { return threads == 0 ? "all" : std::to_string(threads); }

/// Particles times layers.
int effort_of(const BenchSubject& subject) { return subject.particles * subject.layers; }

}  // namespace

std::string scorer_table(std::span<const BenchTrial> trials) {
  std::string table = fmt::format(
      "Poses a second, {} poses at once\n"
      "{:<7}{:>7}  {:<12}{:>12}{:>12}{:>12}{:>14}\n",
      trials.front().subject.particles, "edges", "threads", "scorer", "poses/s", "us a pose",
      "95 %", "to reference");
  for (const BenchTrial& trial : trials) {
    const BenchSubject& s = trial.subject;
    const double us_a_pose = 1000.0 / s.particles;
    table += fmt::format("{:<7}{:>7}  {:<12}{:>12.0f}{:>12.2f}{:>12.2f}{:>14}\n", s.edges,
                         s.threads, s.scorer, 1000 * s.particles / trial.median_ms(kScoreStep),
                         us_a_pose * trial.median_ms(kScoreStep),
                         us_a_pose * trial.p95_ms(kScoreStep), speed_up(trials, trial, kScoreStep));
  }
  return table + "The threads of reference are the OpenGL driver's own, however many.\n\n";
}

std::string frame_table(std::span<const BenchTrial> trials) {
  const std::vector<std::string> scorers = scorers_of(trials);
  std::string table = fmt::format(
      "track() in the thesis's mode, threads: {}; ms a frame: median (95 %), and how many times as "
      "fast as reference\n"
      "{:<7}{:>10}{:>8}",
      threads_text(trials.front().subject.threads), "edges", "particles", "layers");
  for (const std::string& scorer : scorers) table += fmt::format("{:>31}", scorer);
  for (const BenchTrial& trial : trials) {
    const BenchSubject& s = trial.subject;
    if (s.mode != "thesis" || s.scorer != scorers.front()) continue;
    table += fmt::format("\n{:<7}{:>10}{:>8}", s.edges, s.particles, s.layers);
    for (const std::string& scorer : scorers) {
      const BenchTrial& cell = *counterpart(trials, trial, scorer);
      table += fmt::format(
          "{:>22}{:>9}",
          fmt::format("{:.2f} ({:.2f})", cell.median_ms(kTotalStep), cell.p95_ms(kTotalStep)),
          speed_up(trials, cell, kTotalStep));
    }
  }
  return table +
         "\nThe thesis (Table 6.2, its machine of 2010), 100 particles, 1 layer: Sobel 304 ms, "
         "Canny 408 ms.\n\n";
}

std::string stage_table(std::span<const BenchTrial> trials) {
  int most = 0;
  for (const BenchTrial& trial : trials) most = std::max(most, effort_of(trial.subject));
  std::string table = fmt::format(
      "Stages of such a frame, median ms\n"
      "{:<9}{:<7}{:<12}{:>10}{:>8}{:>9}{:>11}{:>9}{:>11}{:>11}{:>14}\n",
      "mode", "edges", "scorer", "particles", "layers", "edges", "search", "judge", "total", "95 %",
      "to reference");
  for (const BenchTrial& trial : trials) {
    const BenchSubject& s = trial.subject;
    const bool thesis = s.mode == "thesis";
    if (thesis && effort_of(s) < most) continue;
    table += fmt::format(
        "{:<9}{:<7}{:<12}{:>10}{:>8}{:>9.3f}{:>11.3f}{:>9.3f}{:>11.3f}{:>11.3f}{:>14}\n", s.mode,
        s.edges, s.scorer, thesis ? std::to_string(s.particles) : "default",
        thesis ? std::to_string(s.layers) : "", trial.median_ms(kEdgesStep),
        trial.median_ms(kSearchStep), trial.median_ms(kJudgeStep), trial.median_ms(kTotalStep),
        trial.p95_ms(kTotalStep), speed_up(trials, trial, kTotalStep));
  }
  return table + "\n";
}

std::string step_table(std::span<const BenchTrial> trials) {
  struct Row {
    const char* step;
    const char* name;
    const char* thesis;  // Table 6.4, "KPP": the processor's column
  };
  constexpr Row kRows[] = {{kDrawStep, "draw, read back", "2.02"}, {kGreyStep, "grey", "-"},
                           {kEdgesStep, "edges", "0.39"},          {kAndStep, "AND", "0.08"},
                           {kCountStep, "count pixels", "0.13"},   {kTotalStep, "total", "3.04"}};
  std::string table = fmt::format("Steps of one pose, as reference does them, ms\n{:<17}", "step");
  for (const BenchTrial& trial : trials) {
    table += fmt::format("{:>9}{:>9}", trial.subject.edges, "95 %");
  }
  table += fmt::format("{:>9}\n", "thesis");
  for (const Row& row : kRows) {
    table += fmt::format("{:<17}", row.name);
    for (const BenchTrial& trial : trials) {
      table += fmt::format("{:>9.3f}{:>9.3f}", trial.median_ms(row.step), trial.p95_ms(row.step));
    }
    table += fmt::format("{:>9}\n", row.thesis);
  }
  return table +
         "The thesis: Table 6.4, Sobel, without CUDA. Its 2.02 ms are for reading back; 0.42 ms of "
         "its total are other work.\n\n";
}

std::string draw_table(std::span<const BenchTrial> trials) {
  std::string table =
      fmt::format("Drawing one pose with OpenGL and reading it back, ms\n{:>9}{:>9}{:>9}\n",
                  "triangles", "median", "95 %");
  for (const BenchTrial& trial : trials) {
    table += fmt::format("{:>9}{:>9.3f}{:>9.3f}\n", trial.subject.triangles,
                         trial.median_ms(kDrawStep), trial.p95_ms(kDrawStep));
  }
  return table +
         "The thesis (Table 6.3): 12 triangles 2.05 ms, 664 2.16 ms, 1493 2.30 ms, 24532 7.56 "
         "ms.\n\n";
}

}  // namespace anneal6d
