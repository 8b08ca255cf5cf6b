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

std::string why_unusable(const Camera& camera) {
  dc1394switch_t on = DC1394_OFF;
  std::uint32_t channel = 64;
  check(dc1394_video_get_transmission(camera.get(), &on), camera.name(), "ask whether it sends");
  dc1394_video_get_iso_channel(camera.get(), &channel);
  if (on == DC1394_ON && !is_channel_free(camera.guid(), static_cast<int>(channel))) {
    return "another program receives from it on channel " + std::to_string(channel);
  }
  std::uint32_t units = 0;
  dc1394_video_get_bandwidth_usage(camera.get(), &units);
  if (is_bandwidth_free(camera.guid(), units)) return {};
  return "its bus has not the bandwidth left for the mode that it is in, " + std::to_string(units) +
         " of 4915 units; stop other cameras or use a mode of fewer bits";
}

Dc1394CameraReport report(std::uint64_t guid) {
  Dc1394CameraReport result;
  result.guid = guid_text(guid);
  try {
    const Camera camera(guid);
    if (camera.get()->vendor != nullptr) result.vendor = camera.get()->vendor;
    if (camera.get()->model != nullptr) result.model = camera.get()->model;
    result.why_unusable = why_unusable(camera);
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
