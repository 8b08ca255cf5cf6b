// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <spdlog/fmt/fmt.h>

#include <cstdio>
#include <memory>
#include <string>

#include "anneal6d/capture/camera_source.h"
#include "anneal6d/capture/dc1394.h"
#include "command.h"
#include "plugins.h"

namespace anneal6d {

namespace {

template <class Table>
void print_table(const char* title, const Table& table) {
  fmt::print("{}\n", title);
  for (const auto& row : table) {
    fmt::print("  {:<14}  {}\n", row.name, row.summary);
    if (const std::string reason = row.obstacle(); !reason.empty()) {
      fmt::print("  {:<14}  not available: {}\n", "", reason);
    }
  }
}

void print_cameras() {
  fmt::print("cameras\n");
  const std::vector<CameraDevice> cameras = list_cameras();
  if (cameras.empty()) fmt::print("  none found\n");
  for (const CameraDevice& camera : cameras) {
    fmt::print("  {:<14}  {}{}{}\n", "camera:" + std::to_string(camera.number),
               camera.path.string(), camera.name.empty() ? "" : ", " + camera.name,
               camera.accessible ? "" : ", not available: this user may not open it");
  }
}

void print_dc1394_camera(const Dc1394CameraReport& camera) {
  if (camera.guid.empty()) {
    fmt::print("  not available: {}\n", camera.why_unusable);
    return;
  }
  fmt::print("  dc1394:{}  {} {}\n", camera.guid, camera.vendor, camera.model);
  if (!camera.why_unusable.empty()) fmt::print("    not available: {}\n", camera.why_unusable);
  for (const std::string& mode : camera.modes) fmt::print("    {}\n", mode);
  for (const Dc1394FeatureReport& feature : camera.features) {
    fmt::print("    --{:<14} {} (now {})\n", feature.name, feature.allowed, feature.current);
  }
}

void print_dc1394_cameras() {
  fmt::print("FireWire cameras\n");
  if (const std::string reason = why_dc1394_is_unavailable(); !reason.empty()) {
    fmt::print("  not available: {}\n", reason);
    return;
  }
  const std::vector<Dc1394CameraReport> cameras = list_dc1394_cameras();
  if (cameras.empty()) fmt::print("  none found\n");
  for (const Dc1394CameraReport& camera : cameras) print_dc1394_camera(camera);
}

}  // namespace

Command add_list_command(CLI::App& tool) {
  CLI::App* app = tool.add_subcommand(
      "list",
      "Shows trackers, scorers, frame sources and cameras, and why some can't be used here");
  auto plugin = std::make_shared<std::string>();
  app->add_option("--plugin", *plugin, "Shared library with further trackers")->type_name("FILE");
  return {app, [plugin] {
            print_table("trackers", all_trackers(*plugin));
            print_table("scorers", all_scorers());
            print_table("frame sources", all_frame_sources());
            print_cameras();
            print_dc1394_cameras();
            return 0;
          }};
}

}  // namespace anneal6d
