// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "bench_trials.h"

#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>
#include <utility>

#include "anneal6d/capture/simulation_source.h"
#include "anneal6d/framework/edge_detector.h"
#include "anneal6d/trackers/universal_tracker.h"
#include "anneal6d/visualizer/mesh_renderer.h"
#include "plugins.h"
#include "progress.h"

namespace anneal6d {

namespace {

constexpr std::uint32_t kDetails[] = {1, 2, 4, 8, 16};  // 124 to 23,104 triangles
constexpr std::size_t kPosesOfSteps = 100;              // that step_trials and draw_trials pass

int triangles_of(const TriangleMesh& mesh) { return static_cast<int>(mesh.triangles().size()); }

Settings tracker_settings(const BenchOptions& options, const BenchSubject& subject) {
  Settings settings;
  settings.set("mode", subject.mode);
  settings.set("scorer", subject.scorer);
  settings.set("edges", subject.edges);
  settings.set("seed", std::to_string(options.seed));
  settings.set("threads", std::to_string(subject.threads));
  if (subject.particles > 0) settings.set("particles", std::to_string(subject.particles));
  if (subject.layers > 0) settings.set("layers", std::to_string(subject.layers));
  if (!options.view_cache.empty()) settings.set("view-cache", options.view_cache);
  return settings;
}

/// A third of the pixels, by chance: what a scorer has to do does not depend on which they are.
EdgeImage some_edges(const CameraModel& camera, std::uint64_t seed) {
  cv::Mat grey(camera.height_px, camera.width_px, CV_8UC1);
  cv::RNG(seed).fill(grey, cv::RNG::UNIFORM, 0, 256);
  return {grey > 170};
}

BenchTrial scorer_trial(const BenchOptions& options, const BenchSubject& subject,
                        const std::shared_ptr<const TriangleMesh>& mesh) {
  const CameraModel camera = default_simulation_camera();
  const auto tracker = UniversalTrackerOptions::from(tracker_settings(options, subject));
  ScorerSetup setup;
  setup.mesh = mesh;
  setup.camera = camera;
  setup.edges = tracker.model_edges;
  setup.threads = tracker.threads;
  setup.view_cache = tracker.view_cache;
  setup.progress = preparation_progress();
  const std::shared_ptr<PoseScorer> scorer =
      make_plugin(all_scorers(), "scorer", subject.scorer, setup);
  scorer->set_edges(some_edges(camera, options.seed));

  BenchTrial trial{.subject = subject, .steps = {kScoreStep}};
  const auto poses =
      make_bench_poses(*mesh, camera, options.seed, static_cast<std::size_t>(subject.particles));
  trial.run = [scorer, poses, matches = std::vector<EdgeMatch>(poses.size())](
                  std::size_t, std::span<double> step_ms) mutable {
    step_ms[0] = milliseconds_of([&] { scorer->score(poses, matches); });
  };
  return trial;
}

BenchTrial frame_trial(const BenchOptions& options, const BenchSubject& subject,
                       const BenchFrames& scene, const std::shared_ptr<const TriangleMesh>& mesh) {
  TrackerSetup setup{
      mesh,          default_simulation_camera(), {}, tracker_settings(options, subject),
      all_scorers(), preparation_progress()};
  const std::shared_ptr<RigidObjectTracker> tracker =
      make_plugin(all_trackers({}), "tracker", "universal", setup);

  BenchTrial trial{.subject = subject, .steps = {kEdgesStep, kSearchStep, kJudgeStep, kTotalStep}};
  trial.run = [tracker, &scene](std::size_t repetition, std::span<double> step_ms) {
    const std::size_t before = repetition % (scene.frames.size() - 1);
    tracker->reset(scene.camera_from_object[before], scene.frames[before]);
    const StageTimings timings = tracker->track(scene.frames[before + 1]).timings;
    step_ms[0] = timings.preprocess_ms;
    step_ms[1] = timings.estimate_ms;
    step_ms[2] = timings.judge_ms;
    step_ms[3] = timings.total_ms;
  };
  return trial;
}

/// What scores one pose, step by step; thesis Fig. 4.5 to 4.7 and Alg. 4.
struct StepBench {
  MeshRenderer renderer;
  EdgeOptions options;
  cv::Mat frame_edges;
  std::vector<Pose> poses;
  EdgeDetector detector = {};
  cv::Mat color = {}, grey = {}, matched = {};
  EdgeImage rendered = {};

  void run(std::size_t repetition, std::span<double> step_ms) {
    const Pose& pose = poses[repetition % poses.size()];
    step_ms[0] = milliseconds_of([&] { renderer.render_color(pose, Shading{}, color); });
    step_ms[1] = milliseconds_of([&] { cv::cvtColor(color, grey, cv::COLOR_BGR2GRAY); });
    step_ms[2] = milliseconds_of([&] { detector.detect(grey, options, rendered); });
    step_ms[3] = milliseconds_of([&] { cv::bitwise_and(rendered.binary, frame_edges, matched); });
    step_ms[4] = milliseconds_of(
        [&] { counted += cv::countNonZero(rendered.binary) + cv::countNonZero(matched); });
    step_ms[5] = step_ms[0] + step_ms[1] + step_ms[2] + step_ms[3] + step_ms[4];
  }

  int counted = 0;  ///< keeps the compiler from leaving the counting out
};

}  // namespace

std::vector<BenchTrial> scorer_trials(const BenchOptions& options) {
  const auto mesh = make_bench_cup(kBenchCupDetail);
  const int all = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<int> threads = {1};
  if (const int chosen = options.threads > 0 ? options.threads : all; chosen > 1) {
    threads.push_back(chosen);
  }
  std::vector<BenchTrial> trials;
  for (const std::string& edges : options.edges) {
    for (const int count : threads) {
      for (const std::string& scorer : options.scorers) {
        const BenchSubject subject{
            .table = "scorer",
            .scorer = scorer,
            .mode = "thesis",
            .edges = edges,
            .particles = *std::max_element(options.particles.begin(), options.particles.end()),
            .threads = count,
            .triangles = triangles_of(*mesh)};
        trials.push_back(scorer_trial(options, subject, mesh));
      }
    }
  }
  return trials;
}

std::vector<BenchTrial> frame_trials(const BenchOptions& options, const BenchFrames& scene) {
  const auto mesh = make_bench_cup(kBenchCupDetail);
  std::vector<BenchTrial> trials;
  BenchSubject subject{
      .table = "frame", .threads = options.threads, .triangles = triangles_of(*mesh)};
  const auto add = [&] { trials.push_back(frame_trial(options, subject, scene, mesh)); };
  subject.mode = "thesis";
  for (const std::string& edges : options.edges) {
    for (const int particles : options.particles) {
      for (const int layers : options.layers) {
        for (const std::string& scorer : options.scorers) {
          subject.edges = edges;
          subject.particles = particles;
          subject.layers = layers;
          subject.scorer = scorer;
          add();
        }
      }
    }
  }
  // As `anneal6d track` runs it. Another scorer would hardly matter: most frames need none.
  const std::string usual = UniversalTrackerOptions().scorer;
  if (std::find(options.scorers.begin(), options.scorers.end(), usual) != options.scorers.end()) {
    subject.mode = "default";
    subject.scorer = usual;
    subject.edges = options.edges.front();
    subject.particles = subject.layers = 0;
    add();
  }
  return trials;
}

std::vector<BenchTrial> step_trials(const BenchOptions& options) {
  const auto mesh = make_bench_cup(kBenchCupDetail);
  const CameraModel camera = default_simulation_camera();
  std::vector<BenchTrial> trials;
  for (const std::string& edges : options.edges) {
    BenchTrial trial{.subject = {.table = "steps",
                                 .scorer = "reference",
                                 .mode = "thesis",
                                 .edges = edges,
                                 .triangles = triangles_of(*mesh)},
                     .steps = {kDrawStep, kGreyStep, kEdgesStep, kAndStep, kCountStep, kTotalStep}};
    const auto tracker = UniversalTrackerOptions::from(tracker_settings(options, trial.subject));
    const std::shared_ptr<StepBench> steps(
        new StepBench{.renderer = MeshRenderer(mesh, camera),
                      .options = tracker.model_edges,
                      .frame_edges = some_edges(camera, options.seed).binary,
                      .poses = make_bench_poses(*mesh, camera, options.seed, kPosesOfSteps)});
    trial.run = [steps](std::size_t repetition, std::span<double> step_ms) {
      steps->run(repetition, step_ms);
    };
    trials.push_back(std::move(trial));
  }
  return trials;
}

std::vector<BenchTrial> draw_trials(const BenchOptions& options) {
  const CameraModel camera = default_simulation_camera();
  std::vector<BenchTrial> trials;
  for (const std::uint32_t detail : kDetails) {
    const auto mesh = make_bench_cup(detail);
    const auto renderer = std::make_shared<MeshRenderer>(mesh, camera);
    const auto poses = make_bench_poses(*mesh, camera, options.seed, kPosesOfSteps);
    BenchTrial trial{.subject = {.table = "draw", .triangles = triangles_of(*mesh)},
                     .steps = {kDrawStep}};
    trial.run = [renderer, poses, color = cv::Mat()](std::size_t repetition,
                                                     std::span<double> step_ms) mutable {
      step_ms[0] = milliseconds_of(
          [&] { renderer->render_color(poses[repetition % poses.size()], Shading{}, color); });
    };
    trials.push_back(std::move(trial));
  }
  return trials;
}

}  // namespace anneal6d
