// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anneal6d/capture/dc1394_options.h"
#include "anneal6d/capture/frame_set_source.h"
#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/frame_source.h"

// FireWire cameras that follow the IIDC specification (Point Grey Dragonfly2 and others), through
// libdc1394. The functions are there in every build; without the library they say so.
namespace anneal6d {

/// Empty if this build has libdc1394; otherwise what is missing.
std::string why_dc1394_is_unavailable();

/// A feature of a camera with what it allows. Texts are for people.
struct Dc1394FeatureReport {
  std::string name;     ///< of the setting: "gain"
  std::string allowed;  ///< "off, auto, one-push, 192..820, abs:0..24 dB"
  std::string current;  ///< "auto 256, 6 dB"
};

/// A camera that was found.
struct Dc1394CameraReport {
  std::string guid;  ///< 16 hexadecimal digits, as in "dc1394:GUID"; empty if it can't be read
  std::string vendor, model;
  std::string why_unusable;        ///< empty if it can be opened
  std::vector<std::string> modes;  ///< "640x480-mono8 at 7.5, 15, 30 fps"
  std::vector<Dc1394FeatureReport> features;
};

/// The cameras on the FireWire buses and, if some can't be seen at all, a report without a GUID
/// that says why and what to do. Reads registers only. Throws BackendUnavailable without the
/// library.
std::vector<Dc1394CameraReport> list_dc1394_cameras();

/// Opens the camera with this GUID (16 hexadecimal digits) or, if `guid` is empty, the first one.
/// All settings are checked and applied before anything is streamed. Frames come as CV_8UC1 or BGR
/// CV_8UC3; `lost_before` counts frames that never arrived, `index` counts all that the camera
/// took, also those that were passed over. After a bus reset or a replug the source goes on by
/// itself with the settings restored and logs it. When destroyed, also by an exception, it leaves
/// the camera silent and the bus's bandwidth free.
/// Throws BackendUnavailable (no such camera, no permission, in use, no bandwidth), ConfigError (a
/// setting that the camera does not allow: names it, the value, and what is allowed).
/// `next` throws CaptureError naming the camera: nothing for the stall timeout, or unplugged and
/// not back within the recovery timeout. A further call tries again.
std::unique_ptr<FrameSource> open_dc1394_camera(const std::string& guid,
                                                const Dc1394Options& options,
                                                std::optional<CameraModel> camera = std::nullopt);

/// Opens several cameras of one bus, which expose within 125 us of each other, and hands out the
/// frames that belong together. Throws as `open_dc1394_camera`, and ConfigError for fewer than two
/// cameras or one given twice.
std::unique_ptr<FrameSetSource> open_dc1394_group(const std::vector<std::string>& guids,
                                                  const Dc1394Options& options);

}  // namespace anneal6d
