// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "plugins.h"

#include <algorithm>
#include <iterator>

#include "anneal6d/trackers/plugins.h"
#include "anneal6d/visualizer/mesh_renderer.h"
#include "anneal6d/visualizer/reference_scorer.h"

namespace anneal6d {

ScorerTable all_scorers() {
  ScorerTable table = cpu_scorer_plugins();
  std::ranges::move(visualizer::scorer_plugins(), std::back_inserter(table));
  return table;
}

TrackerTable all_trackers(const std::filesystem::path& plugin) {
  TrackerTable table = tracker_plugins();
  if (plugin.empty()) return table;
  for (TrackerPlugin& row : load_tracker_plugins(plugin)) {
    const bool taken = std::ranges::any_of(
        table, [&](const TrackerPlugin& present) { return present.name == row.name; });
    if (taken) {
      throw ConfigError(plugin.string() + ": its tracker '" + row.name +
                        "' has the name of one that is there already; rename it");
    }
    table.push_back(std::move(row));
  }
  return table;
}

ObjectRendererFactory textured_renderers() {
  return [](std::shared_ptr<const TriangleMesh> mesh, const CameraModel& camera) {
    return make_renderer(std::move(mesh), camera, true);
  };
}

FrameSourceTable all_frame_sources() { return frame_source_plugins(); }

std::unique_ptr<ObjectRenderer> make_renderer(std::shared_ptr<const TriangleMesh> mesh,
                                              const CameraModel& camera, bool textured) {
  return std::make_unique<MeshRenderer>(std::move(mesh), camera, textured);
}

}  // namespace anneal6d
