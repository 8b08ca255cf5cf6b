// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <cstdio>
#include <exception>
#include <memory>

#include "anneal6d/capture/frame_sources.h"
#include "anneal6d/framework/plugin.h"
#include "anneal6d/framework/rigid_object_tracker.h"
#include "anneal6d/trackers/plugins.h"
#include "anneal6d/visualizer/reference_scorer.h"

namespace {

anneal6d::TrackerSetup triangle_before_a_camera() {
  anneal6d::TrackerSetup setup;
  std::vector<anneal6d::MeshVertex> corners(3);
  corners[1].position_mm = {50, 0, 0};
  corners[2].position_mm = {0, 50, 0};
  setup.mesh = std::make_shared<anneal6d::TriangleMesh>(std::move(corners),
                                                        std::vector<anneal6d::Triangle>{{0, 1, 2}});
  setup.camera = {
      .width_px = 64, .height_px = 48, .fx_px = 60, .fy_px = 60, .cx_px = 31.5, .cy_px = 23.5};
  return setup;
}

template <class Table>
void print_names(const char* kind, const Table& table) {
  std::printf("%s:", kind);
  for (const auto& plugin : table) std::printf(" %s", plugin.name.c_str());
  std::printf("\n");
}

}  // namespace

/// Lists what the libraries bring, then tracks one grey frame with the tracker `still` of the
/// plugin named on the command line.
int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  print_names("trackers", anneal6d::tracker_plugins());
  print_names("CPU scorers", anneal6d::cpu_scorer_plugins());
  print_names("OpenGL scorers", anneal6d::visualizer::scorer_plugins());
  print_names("frame sources", anneal6d::frame_source_plugins());

  const anneal6d::TrackerTable trackers = anneal6d::load_tracker_plugins(argv[1]);
  const auto tracker =
      anneal6d::make_plugin(trackers, "tracker", "still", triangle_before_a_camera());

  anneal6d::Pose start;
  start.translation_mm = {0, 0, 400};
  tracker->reset(start);
  const anneal6d::TrackResult result = tracker->track({cv::Mat::zeros(48, 64, CV_8UC1)});

  std::printf("%s at z = %g mm\n", std::string(anneal6d::to_string(result.status)).c_str(),
              result.camera_from_object.translation_mm.z());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
