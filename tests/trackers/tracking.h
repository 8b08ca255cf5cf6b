// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "anneal6d/trackers/plugins.h"
#include "anneal6d/trackers/universal_tracker.h"
#include "synthetic.h"

namespace anneal6d::test {

using Values = std::initializer_list<std::pair<std::string, std::string>>;

/// For the small camera, with the scorers of the trackers' module.
inline TrackerSetup setup_for(const SharedMesh& mesh, const Values& values) {
  TrackerSetup setup;
  setup.mesh = mesh;
  setup.camera = small_camera();
  setup.scorers = cpu_scorer_plugins();
  for (const auto& [name, value] : values) setup.settings.set(name, value);
  return setup;
}

inline Frame frame_of(const cv::Mat& image, std::int64_t index) {
  Frame frame;
  frame.image = image;
  frame.index = index;
  return frame;
}

/// Frames of an object that somebody moves smoothly, and where it truly was.
struct Sequence {
  std::vector<Frame> frames;
  std::vector<Pose> truth;
};

inline Sequence moving_sequence(const SharedMesh& mesh, int frames, int background = 40,
                                const Shading& shading = {}) {
  Sequence sequence;
  const RasterModel model(mesh, false);
  Pose start = corner_view();
  start.translation_mm = {-20, -3, 340};
  for (int i = 0; i < frames; ++i) {
    const double t = 0.25 * i;
    const Pose pose = beside(*mesh, start, {5 * std::sin(t), 8 * (1 - std::cos(t)), 4 * t},
                             {12 * t, 10 * std::sin(t), 15 * (1 - std::cos(t))});
    sequence.truth.push_back(pose);
    sequence.frames.push_back(
        frame_of(photograph(model, small_camera(), pose, background, 1.5, i, shading), i));
  }
  return sequence;
}

inline std::vector<TrackResult> track(RigidObjectTracker& tracker, const Sequence& sequence) {
  tracker.reset(sequence.truth.front());
  std::vector<TrackResult> results;
  for (const Frame& frame : sequence.frames) results.push_back(tracker.track(frame));
  return results;
}

}  // namespace anneal6d::test
