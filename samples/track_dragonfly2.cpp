// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Follows an object live through a Dragonfly2 or any other IIDC camera on FireWire: draws its edges
// over the picture in a window, or prints the poses where there is no display.
//
//   track_dragonfly2 MODEL CAMERA.yml "tx ty tz qw qx qy qz" [GUID] [SETTING=VALUE ...]
//
// The pose is that of the object in the first picture, camera_from_object in millimetres. Settings
// are those of `anneal6d track dc1394:`, such as gain=auto or shutter=abs:10. Esc or Ctrl-C ends.

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <opencv2/highgui.hpp>
#include <string>

#include "anneal6d/capture/dc1394.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "anneal6d/framework/mesh_file.h"
#include "anneal6d/framework/pose_file.h"
#include "anneal6d/trackers/plugins.h"
#include "anneal6d/visualizer/mesh_renderer.h"
#include "anneal6d/visualizer/overlay.h"

namespace {

std::atomic<bool> ended = false;

struct Arguments {
  std::string model, camera, init, guid;
  anneal6d::Settings settings;
};

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool is_setting(const std::string& name) {
  const auto all = anneal6d::dc1394_settings();
  return std::any_of(all.begin(), all.end(), [&](const auto& row) { return row.name == name; });
}

Arguments parse(int argc, char** argv) {
  Arguments arguments{argv[1], argv[2], argv[3], {}, {}};
  for (int i = 4; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t at = word.find('=');
    if (at == std::string::npos) {
      arguments.guid = word;
    } else if (is_setting(word.substr(0, at))) {
      arguments.settings.set(word.substr(0, at), word.substr(at + 1));
    } else {
      throw anneal6d::ConfigError("'" + word.substr(0, at) +
                                  "' is no setting of a camera; see "
                                  "'anneal6d track --help'");
    }
  }
  return arguments;
}

void print(const anneal6d::Frame& frame, const anneal6d::TrackResult& result) {
  const Eigen::Vector3d& t = result.camera_from_object.translation_mm;
  std::printf("frame %6lld  lost %lld  %8.2f %8.2f %8.2f mm  quality %.2f  %s\n",
              static_cast<long long>(frame.index), static_cast<long long>(frame.lost_before), t.x(),
              t.y(), t.z(), result.quality, anneal6d::to_string(result.status).data());
}

void track(const Arguments& arguments) {
  const anneal6d::CameraModel camera = anneal6d::load_camera(arguments.camera);
  const auto mesh =
      std::make_shared<const anneal6d::TriangleMesh>(anneal6d::load_mesh(arguments.model));
  anneal6d::TrackerSetup setup;
  setup.mesh = mesh;
  setup.camera = camera;
  setup.scorers = anneal6d::cpu_scorer_plugins();
  const auto tracker =
      anneal6d::make_plugin(anneal6d::tracker_plugins(), "tracker", "universal", setup);
  const anneal6d::Pose start = anneal6d::parse_pose(arguments.init);

  const bool has_display = is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
  std::unique_ptr<anneal6d::OverlayPainter> painter;
  if (has_display) {
    painter = std::make_unique<anneal6d::OverlayPainter>(
        std::make_unique<anneal6d::MeshRenderer>(mesh, camera, true), mesh, camera);
  }

  // The camera last: it sends only while somebody takes its frames.
  const auto source = anneal6d::open_dc1394_camera(
      arguments.guid, anneal6d::Dc1394Options::from(arguments.settings), camera);
  std::fprintf(stderr, "%s\n", source->description().c_str());
  const auto first = source->next();
  if (!first) return;
  tracker->reset(start, *first);  // it learns there what object and background look like
  while (!ended) {
    const auto frame = source->next();
    if (!frame) return;
    const anneal6d::TrackResult result = tracker->track(*frame);
    if (!painter) {
      print(*frame, result);
      continue;
    }
    cv::imshow("Anneal6D", painter->paint(*frame, result));
    if (cv::waitKey(1) == 27) return;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr,
                 "usage: track_dragonfly2 MODEL CAMERA.yml \"tx ty tz qw qx qy qz\" [GUID] "
                 "[SETTING=VALUE ...]\n");
    return 2;
  }
  std::signal(SIGINT, [](int) { ended = true; });
  anneal6d::set_log_sink([](anneal6d::LogLevel level, std::string_view message) {
    if (level == anneal6d::LogLevel::debug) return;
    std::fprintf(stderr, "%.*s\n", static_cast<int>(message.size()), message.data());
  });
  try {
    track(parse(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
