// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Tracks the object of a sequence folder (images, camera.yml, model.obj, groundtruth.csv) and
// prints a line for each frame.
//
//   01_track_sequence FOLDER

#include <cstdio>
#include <exception>
#include <memory>

#include "anneal6d/capture/sequence_source.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/mesh_file.h"
#include "anneal6d/trackers/plugins.h"

namespace {

void track_sequence(const char* path) {
  anneal6d::SequenceSource source(path);
  const anneal6d::SequenceFolder& folder = source.folder();
  if (!folder.model_file || !source.camera()) {
    throw anneal6d::FileError(path, "", "the sequence needs model.obj and camera.yml");
  }

  anneal6d::TrackerSetup setup;
  setup.mesh =
      std::make_shared<const anneal6d::TriangleMesh>(anneal6d::load_mesh(*folder.model_file));
  setup.camera = *source.camera();
  setup.symmetry = folder.symmetry;
  setup.settings.set("seed", "1");
  setup.scorers = anneal6d::cpu_scorer_plugins();
  const auto tracker =
      anneal6d::make_plugin(anneal6d::tracker_plugins(), "tracker", "universal", setup);

  // The pose of the first frame must be known; here the sequence tells it.
  const auto first = source.next();
  if (!first || !source.ground_truth()) {
    throw anneal6d::FileError(path, "groundtruth.csv", "the first frame's pose is not known");
  }
  tracker->reset(*source.ground_truth(), *first);

  while (const auto frame = source.next()) {
    const anneal6d::TrackResult result = tracker->track(*frame);
    const Eigen::Vector3d& t = result.camera_from_object.translation_mm;
    std::printf("frame %3d  %8.2f %8.2f %8.2f mm  quality %.2f  %s\n",
                static_cast<int>(frame->index), t.x(), t.y(), t.z(), result.quality,
                anneal6d::to_string(result.status).data());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: 01_track_sequence FOLDER\n");
    return 2;
  }
  try {
    track_sequence(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
