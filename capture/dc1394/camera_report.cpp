// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "camera_report.h"

#include <utility>

#include "anneal6d/framework/error.h"
#include "camera.h"
#include "camera_features.h"
#include "device_nodes.h"
#include "iso_channel.h"
#include "library.h"
#include "trigger.h"
#include "video_format.h"

namespace anneal6d::dc1394 {
namespace {

std::string why_in_use(const Camera& camera) {
  dc1394switch_t on = DC1394_OFF;
  std::uint32_t channel = 64;
  check(dc1394_video_get_transmission(camera.get(), &on), camera.name(), "ask whether it sends");
  if (on == DC1394_OFF) return {};
  dc1394_video_get_iso_channel(camera.get(), &channel);
  if (is_channel_free(camera.guid(), static_cast<int>(channel))) return {};
  return "another program receives from it on channel " + std::to_string(channel);
}

Dc1394CameraReport report(std::uint64_t guid) {
  Dc1394CameraReport result;
  result.guid = guid_text(guid);
  try {
    const Camera camera(guid);
    if (camera.get()->vendor != nullptr) result.vendor = camera.get()->vendor;
    if (camera.get()->model != nullptr) result.model = camera.get()->model;
    result.why_unusable = why_in_use(camera);
    result.modes = report_modes(camera);
    result.features = report_features(camera);
    for (auto& row : report_trigger(camera)) result.features.push_back(std::move(row));
    if (const int channels = camera.get()->max_mem_channel; channels > 0) {
      result.features.push_back({"memory-load", "0.." + std::to_string(channels), "-"});
    }
  } catch (const Error& error) {
    result.why_unusable = error.what();
  }
  return result;
}

}  // namespace

std::vector<Dc1394CameraReport> report_cameras() {
  std::vector<Dc1394CameraReport> reports;
  const Library library;
  for (const std::uint64_t guid : find_cameras(library)) reports.push_back(report(guid));
  if (const std::string closed = explain_closed_nodes(list_device_nodes()); !closed.empty()) {
    Dc1394CameraReport unseen;
    unseen.why_unusable = closed;
    reports.push_back(unseen);
  }
  return reports;
}

}  // namespace anneal6d::dc1394
