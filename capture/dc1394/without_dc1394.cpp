// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// The module's functions in a build without libdc1394.
#include "anneal6d/capture/dc1394.h"
#include "anneal6d/framework/error.h"

namespace anneal6d {

std::string why_dc1394_is_unavailable() {
  return "this build was made without libdc1394 (Linux: install libdc1394-dev, configure and "
         "build again; it has no working driver on other systems)";
}

std::vector<Dc1394CameraReport> list_dc1394_cameras() {
  throw BackendUnavailable(why_dc1394_is_unavailable());
}

std::unique_ptr<FrameSource> open_dc1394_camera(const std::string&, const Dc1394Options&,
                                                std::optional<CameraModel>) {
  throw BackendUnavailable(why_dc1394_is_unavailable());
}

std::unique_ptr<FrameSetSource> open_dc1394_group(const std::vector<std::string>&,
                                                  const Dc1394Options&) {
  throw BackendUnavailable(why_dc1394_is_unavailable());
}

}  // namespace anneal6d
