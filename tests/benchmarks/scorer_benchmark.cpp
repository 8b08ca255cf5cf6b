// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "anneal6d/trackers/plugins.h"
#include "anneal6d/visualizer/reference_scorer.h"
#include "shapes.h"

namespace anneal6d {
namespace {

constexpr std::uint32_t kPoses = 100;

ScorerTable all_scorers() {
  ScorerTable table = cpu_scorer_plugins();
  for (const ScorerPlugin& row : visualizer::scorer_plugins()) table.push_back(row);
  return table;
}

CameraModel vga_camera() {
  CameraModel camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 600;
  camera.cx_px = 319.5;
  camera.cy_px = 239.5;
  return camera;
}

/// Poses of a ring of 130 mm at 400 mm, as a layer of the filter has them: within some millimetres
/// and degrees of each other. Its picture is about 200 px wide and high.
std::vector<Pose> layer_of_poses(const TriangleMesh& mesh) {
  std::vector<Pose> poses;
  for (std::uint32_t i = 0; i < kPoses; ++i) {
    const RandomKey key{1, 0, 0, i};
    const auto a = random_normals(key, 0), b = random_normals(key, 1), c = random_normals(key, 2);
    const Eigen::Vector3d turn_rad(0.6 + 0.03 * a[0], 0.3 + 0.03 * a[1], 0.03 * b[0]);
    const Eigen::Vector3d center_mm(5 * b[1], 5 * c[0], 400 + 5 * c[1]);
    poses.push_back(test::pose_with_center(mesh, rotation_from_vector(turn_rad), center_mm));
  }
  return poses;
}

/// Poses a second, `items_per_second`, of a smooth ring of 1,600 triangles in 640x480 pixels.
void score(benchmark::State& state, const std::string& name, const EdgeOptions& edges) {
  ScorerSetup setup;
  setup.mesh = test::make_torus(50, 15);
  setup.camera = vga_camera();
  setup.edges = edges;
  setup.threads = 1;
  std::unique_ptr<PoseScorer> scorer;
  try {
    scorer = make_plugin(all_scorers(), "scorer", name, setup);
  } catch (const Error& error) {
    state.SkipWithError(error.what());
    return;
  }
  cv::Mat frame_edges(480, 640, CV_8UC1);
  cv::randu(frame_edges, 0, 256);
  frame_edges = frame_edges > 170;  // a third of the pixels
  scorer->set_edges({frame_edges});

  const std::vector<Pose> poses = layer_of_poses(*setup.mesh);
  std::vector<EdgeMatch> matches(poses.size());
  scorer->score(poses, matches);  // what is allocated once
  for ([[maybe_unused]] auto _ : state) {
    scorer->score(poses, matches);
    benchmark::DoNotOptimize(matches.data());
  }
  state.SetItemsProcessed(state.iterations() * kPoses);
}

const EdgeOptions kSobel{.threshold = 40};
const EdgeOptions kCanny{.op = EdgeOperator::canny, .threshold = 100, .dilation_px = 1};

// The wall's time: the reference scorer's driver has threads of its own.
BENCHMARK_CAPTURE(score, cpu_sobel, "cpu", kSobel)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(score, sparse_sobel, "sparse", kSobel)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(score, reference_sobel, "reference", kSobel)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(score, cpu_canny, "cpu", kCanny)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(score, sparse_canny, "sparse", kCanny)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(score, reference_canny, "reference", kCanny)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace anneal6d
