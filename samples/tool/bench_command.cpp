// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <thread>

#include "anneal6d/capture/simulation_source.h"
#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/edge_detector.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/visualizer/headless_context.h"
#include "bench_tables.h"
#include "bench_trials.h"
#include "command.h"
#include "interrupt.h"
#include "options.h"
#include "plugins.h"

namespace anneal6d {

namespace {

constexpr double kTurn_ms = 20;  // quick things repeat so long in each of their turns
constexpr int kFrames = 21;      // simulated; then they are tracked again from the start

struct BenchCommandOptions {
  BenchOptions bench;
  int frames = 3;
  std::string out;
};

/// Throws ConfigError for names that do not exist or stand twice.
void check_names(const BenchOptions& options) {
  for (const std::string& edges : options.edges) parse_edge_operator(edges);
  const ScorerTable table = all_scorers();
  for (auto name = options.scorers.begin(); name != options.scorers.end(); ++name) {
    const bool exists = std::any_of(table.begin(), table.end(),
                                    [&](const auto& plugin) { return plugin.name == *name; });
    if (!exists) throw ConfigError("--scorer: there is no '" + *name + "'; see anneal6d list");
    if (std::find(options.scorers.begin(), name, *name) != name) {
      throw ConfigError("--scorer: '" + *name + "' is given twice");
    }
  }
}

/// Those of `wanted` that can be used here; prints why the others can't.
std::vector<std::string> usable_scorers(const std::vector<std::string>& wanted) {
  std::vector<std::string> usable;
  for (const ScorerPlugin& row : all_scorers()) {
    if (std::find(wanted.begin(), wanted.end(), row.name) == wanted.end()) continue;
    if (const std::string reason = row.obstacle(); reason.empty()) {
      usable.push_back(row.name);
    } else {
      fmt::print("{}: not available: {}\n", row.name, reason);
    }
  }
  return usable;
}

std::string opengl_description() {
  const std::string& reason = headless_opengl_unavailable_reason();
  return reason.empty() ? HeadlessContext().description() : "none: " + reason;
}

/// An unwritable place is found out before the work.
void check_out(const std::filesystem::path& path) {
  if (path.empty()) return;
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    throw FileError(path, "", "cannot be written: there is no folder " + folder.string());
  }
  if (std::filesystem::is_directory(path)) {
    throw FileError(path, "", "is a folder; a file is needed");
  }
}

/// Measures what `make` makes, prints `tables` of it and keeps the samples.
template <class Make, class... Table>
void run_part(std::string name, int turns, std::vector<BenchTrial>& done, const Make& make,
              Table... tables) {
  std::vector<BenchTrial> trials = make();
  {
    Progress progress("measuring " + std::move(name),
                      static_cast<std::int64_t>(trials.size()) * (turns + 1));
    measure(trials, turns, kTurn_ms, progress);
  }
  (std::fputs(tables(trials).c_str(), stdout), ...);
  std::fflush(stdout);
  std::move(trials.begin(), trials.end(), std::back_inserter(done));
}

int bench(BenchCommandOptions options) {
  check_names(options.bench);
  check_out(options.out);
  catch_interrupt();
  const auto cup = make_bench_cup(kBenchCupDetail);
  const CameraModel camera = default_simulation_camera();
  fmt::print("A cup of {} triangles before {}x{} pixels; {} threads; OpenGL: {}\n",
             cup->triangles().size(), camera.width_px, camera.height_px,
             std::thread::hardware_concurrency(), opengl_description());
  options.bench.scorers = usable_scorers(options.bench.scorers);
  if (options.bench.scorers.empty()) {
    throw BackendUnavailable("none of the scorers can be used here; choose others with --scorer");
  }
  std::fputc('\n', stdout);

  std::vector<BenchTrial> done;
  const int turns = options.frames;
  run_part(
      "scorers", turns, done, [&] { return scorer_trials(options.bench); }, scorer_table);
  if (const std::string& reason = headless_opengl_unavailable_reason(); reason.empty()) {
    const BenchFrames scene = make_bench_frames(cup, camera, options.bench.seed, kFrames);
    run_part(
        "frames", turns, done, [&] { return frame_trials(options.bench, scene); }, frame_table,
        stage_table);
    run_part(
        "steps", turns, done, [&] { return step_trials(options.bench); }, step_table);
    run_part(
        "drawing", turns, done, [&] { return draw_trials(options.bench); }, draw_table);
  } else {
    fmt::print("Frames, steps and drawing are not measured, since OpenGL draws them: {}\n", reason);
  }
  if (!options.out.empty()) write_file_atomically(options.out, to_csv(done));
  return 0;
}

}  // namespace

Command add_bench_command(CLI::App& tool) {
  CLI::App* app =
      tool.add_subcommand("bench", "Measures the thesis's runtime tables on this machine");
  auto options = std::make_shared<BenchCommandOptions>();
  BenchOptions& bench_options = options->bench;
  for (const ScorerPlugin& scorer : all_scorers()) bench_options.scorers.push_back(scorer.name);
  app->add_option("--scorer", bench_options.scorers, "Scorers, default all; see anneal6d list")
      ->type_name("NAME,...")
      ->delimiter(',');
  app->add_option("--particles", bench_options.particles, "Particles a layer, default 100,600")
      ->type_name("N,...")
      ->delimiter(',')
      ->check(CLI::Range(1, 100000));
  app->add_option("--layers", bench_options.layers, "Annealing layers, default 1,5")
      ->type_name("N,...")
      ->delimiter(',')
      ->check(CLI::Range(1, 100));
  app->add_option("--edges", bench_options.edges, "Edge operators, default sobel,canny")
      ->type_name("sobel|prewitt|canny,...")
      ->delimiter(',');
  app->add_option("--frames", options->frames,
                  "How often each setting is measured at least, default 3; what is quick is "
                  "repeated for 20 ms each time")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  app->add_option("--threads", bench_options.threads, "CPU threads; default: all")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  app->add_option("--seed", bench_options.seed, "Seed of all random numbers, default 1")
      ->type_name("N")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  app->add_option("--view-cache", bench_options.view_cache,
                  "Where models' views are kept from run to run")
      ->type_name("FOLDER|off");
  app->add_option("--out", options->out, "Where every single time goes; default: nowhere")
      ->type_name("FILE.csv");
  app->footer(
      "Give it the machine alone: other programs slow down what takes long more than what is "
      "quick.\nAll settings of a table are measured in turn, again and again, so that the times of "
      "one run can be compared;\ncompare those of two runs with care. Each frame starts at the "
      "true "
      "pose of the one before.");
  return {app, [options] { return bench(*options); }};
}

}  // namespace anneal6d
