// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// The module's functions in a build with libdc1394; without_dc1394.cpp has the others.
#include "anneal6d/capture/dc1394.h"

#include "camera_group.h"
#include "camera_report.h"
#include "dc1394_source.h"

namespace anneal6d {

std::string why_dc1394_is_unavailable() { return {}; }

std::vector<Dc1394CameraReport> list_dc1394_cameras() { return dc1394::report_cameras(); }

std::unique_ptr<FrameSource> open_dc1394_camera(const std::string& guid,
                                                const Dc1394Options& options,
                                                std::optional<CameraModel> camera) {
  return std::make_unique<dc1394::Dc1394Source>(guid, options, std::move(camera));
}

std::unique_ptr<FrameSetSource> open_dc1394_group(const std::vector<std::string>& guids,
                                                  const Dc1394Options& options) {
  return std::make_unique<dc1394::CameraGroup>(guids, options);
}

}  // namespace anneal6d
