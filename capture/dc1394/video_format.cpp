// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "video_format.h"

#include <algorithm>
#include <cmath>

#include "anneal6d/framework/error.h"
#include "camera_features.h"
#include "mode_names.h"

namespace anneal6d::dc1394 {
namespace {

constexpr double kPackets_per_s = 8000;

std::string number_text(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// Of several modes of one size the cheapest for the bus: grey before colour.
int cost(dc1394color_coding_t coding) {
  switch (coding) {
    case DC1394_COLOR_CODING_MONO8:
      return 0;
    case DC1394_COLOR_CODING_YUV411:
      return 1;
    case DC1394_COLOR_CODING_YUV422:
      return 2;
    case DC1394_COLOR_CODING_MONO16:
      return 3;
    default:
      return 4;
  }
}

// Format_7 after all fixed modes of the size.
const Mode* mode_of_size(const std::vector<Mode>& modes, const cv::Size& size) {
  const Mode* best = nullptr;
  const auto rank = [](const Mode& mode) { return is_format7(mode.id) ? 9 : cost(mode.coding); };
  for (const Mode& mode : modes) {
    if (mode.size == size && (best == nullptr || rank(mode) < rank(*best))) best = &mode;
  }
  return best;
}

Mode choose_mode(const Camera& camera, const Dc1394Options& options,
                 const std::optional<CameraModel>& calibration) {
  const std::vector<Mode> modes = list_modes(camera);
  const auto named = [&](const std::string& name) {
    return std::find_if(modes.begin(), modes.end(),
                        [&](const Mode& mode) { return mode.name == name; });
  };
  if (!options.video_mode.empty()) {
    const auto mode = named(options.video_mode);
    if (mode == modes.end()) {
      refuse_setting(camera, "video-mode", options.video_mode,
                     "the camera has " + joined(mode_names(camera)));
    }
    return *mode;
  }
  if (options.roi || options.packet_bytes || !options.coding.empty()) {
    const auto scalable = std::find_if(modes.begin(), modes.end(),
                                       [](const Mode& mode) { return is_format7(mode.id); });
    if (scalable != modes.end()) return *scalable;
  }
  if (calibration) {
    const cv::Size size(calibration->width_px, calibration->height_px);
    if (const Mode* mode = mode_of_size(modes, size)) return *mode;
    throw ConfigError(camera.name() + " has no picture size of " + size_text(size) +
                      " as in the calibration; choose a mode with --video-mode and --roi that has "
                      "it (there are: " +
                      joined(mode_names(camera)) + "), or calibrate the camera at one of these");
  }
  const auto usual = named("640x480-mono8");
  return usual != modes.end() ? *usual : modes.front();
}

// Settings of Format_7 mean nothing to a fixed mode: better said than ignored.
void refuse_format7_settings(const Camera& camera, const Dc1394Options& options, const Mode& mode) {
  const char* setting = options.roi               ? "roi"
                        : options.packet_bytes    ? "packet-size"
                        : !options.coding.empty() ? "coding"
                                                  : nullptr;
  if (setting == nullptr) return;
  throw ConfigError(std::string("--") + setting + " belongs to Format_7, but " + mode.name +
                    " was chosen for " + camera.name() + "; use --video-mode format7-0");
}

VideoFormat apply_fixed(const Camera& camera, const Dc1394Options& options, const Mode& mode) {
  refuse_format7_settings(camera, options, mode);
  dc1394framerates_t list{};
  check(dc1394_video_get_supported_framerates(camera.get(), mode.id, &list), camera.name(),
        "read its frame rates");
  std::optional<dc1394framerate_t> chosen;
  float chosen_rate = 0;
  std::vector<std::string> all;
  for (std::uint32_t i = 0; i < list.num; ++i) {
    float rate = 0;
    if (dc1394_framerate_as_float(list.framerates[i], &rate) != DC1394_SUCCESS) continue;
    all.push_back(number_text(static_cast<double>(rate)));
    const bool wanted = !options.fps || std::abs(rate - *options.fps) < 0.01 * rate;
    if (wanted && rate > chosen_rate) {
      chosen = list.framerates[i];
      chosen_rate = rate;
    }
  }
  if (!chosen) {
    refuse_setting(camera, "fps", options.fps ? number_text(*options.fps) : "",
                   mode.name + " comes at " + joined(all));
  }
  check(dc1394_video_set_mode(camera.get(), mode.id), camera.name(), "set " + mode.name);
  check(dc1394_video_set_framerate(camera.get(), *chosen), camera.name(), "set the frame rate");
  VideoFormat format;
  format.name = mode.name;
  format.size = mode.size;
  format.coding = mode.coding;
  format.period_s = 1.0 / static_cast<double>(chosen_rate);
  return format;
}

dc1394color_coding_t choose_coding(const Camera& camera, const Dc1394Options& options,
                                   const Mode& mode, const ScalableLimits& limits) {
  std::vector<std::string> names;
  for (const auto coding : limits.codings) names.push_back(coding_name(coding));
  if (options.coding.empty()) {
    const auto cheapest = std::min_element(
        limits.codings.begin(), limits.codings.end(),
        [](dc1394color_coding_t a, dc1394color_coding_t b) { return cost(a) < cost(b); });
    return *cheapest;
  }
  const auto wanted = coding_of(options.coding);
  if (!wanted ||
      std::find(limits.codings.begin(), limits.codings.end(), *wanted) == limits.codings.end()) {
    refuse_setting(camera, "coding", options.coding, mode.name + " has " + joined(names));
  }
  return *wanted;
}

cv::Rect choose_region(const Camera& camera, const Dc1394Options& options, const Mode& mode,
                       const ScalableLimits& limits) {
  const cv::Rect all(cv::Point(0, 0), limits.largest);
  if (!options.roi) return all;
  const cv::Rect roi = *options.roi;
  const bool fits = roi.width > 0 && roi.height > 0 && (roi & all) == roi &&
                    roi.width % limits.unit_size.width == 0 &&
                    roi.height % limits.unit_size.height == 0 &&
                    roi.x % limits.unit_position.x == 0 && roi.y % limits.unit_position.y == 0;
  if (!fits) {
    refuse_setting(camera, "roi",
                   std::to_string(roi.x) + "," + std::to_string(roi.y) + "," +
                       std::to_string(roi.width) + "," + std::to_string(roi.height),
                   mode.name + " allows regions within " + size_text(limits.largest) +
                       ", width and height in steps of " + size_text(limits.unit_size) +
                       ", left and top in steps of " + std::to_string(limits.unit_position.x) +
                       " and " + std::to_string(limits.unit_position.y));
  }
  return roi;
}

// Bytes a packet: as given, as the wanted rate needs, or as the camera recommends.
int choose_packet(const Camera& camera, const Dc1394Options& options, dc1394video_mode_t mode,
                  double frame_bytes) {
  std::uint32_t unit = 0, most = 0, recommended = 0;
  check(dc1394_format7_get_packet_parameters(camera.get(), mode, &unit, &most), camera.name(),
        "read the packet sizes");
  // IEEE 1394: an isochronous packet at 100 Mbit/s carries at most 1024 bytes, and so on.
  most = std::min(most, static_cast<std::uint32_t>(options.iso_speed / 100 * 1024));
  if (unit == 0 || most < unit) {
    throw CaptureError(camera.name() + " answers nonsense: packets of " + std::to_string(unit) +
                       " to " + std::to_string(most) + " bytes; switch it off and on again");
  }
  most = most / unit * unit;
  const std::string allowed = "packets have " + std::to_string(unit) + " to " +
                              std::to_string(most) + " bytes in steps of " + std::to_string(unit);
  if (options.packet_bytes) {
    const auto bytes = static_cast<std::uint32_t>(*options.packet_bytes);
    if (bytes % unit != 0 || bytes > most) {
      refuse_setting(camera, "packet-size", std::to_string(*options.packet_bytes), allowed);
    }
    return static_cast<int>(bytes);
  }
  if (options.fps) {
    const double needed = std::ceil(frame_bytes * *options.fps / kPackets_per_s / unit) * unit;
    if (needed > most) {
      refuse_setting(camera, "fps", number_text(*options.fps),
                     "this picture would need packets of " + number_text(needed) + " bytes, and " +
                         allowed + ", enough for " +
                         number_text(most * kPackets_per_s / frame_bytes) +
                         " fps; choose a smaller --roi or a --coding of fewer bits");
    }
    return static_cast<int>(needed);
  }
  check(dc1394_format7_get_recommended_packet_size(camera.get(), mode, &recommended), camera.name(),
        "read the recommended packet size");
  return static_cast<int>(recommended == 0 || recommended > most ? most : recommended);
}

VideoFormat apply_format7(const Camera& camera, const Dc1394Options& options, const Mode& mode) {
  const ScalableLimits limits = scalable_limits(camera, mode.id);
  VideoFormat format;
  format.coding = choose_coding(camera, options, mode, limits);
  const cv::Rect roi = choose_region(camera, options, mode, limits);
  format.size = roi.size();
  format.name = mode.name + " " + coding_name(format.coding);

  // The order matters: the camera judges position, size and packets together (IIDC 1.31, 4.9).
  const auto set = [&](dc1394error_t result, const std::string& what) {
    check(result, camera.name(), "set " + what + " of " + mode.name);
  };
  const auto width = static_cast<std::uint32_t>(roi.width);
  const auto height = static_cast<std::uint32_t>(roi.height);
  set(dc1394_video_set_mode(camera.get(), mode.id), "the mode");
  set(dc1394_format7_set_color_coding(camera.get(), mode.id, format.coding), "the coding");
  set(dc1394_format7_set_image_position(camera.get(), mode.id, 0, 0), "the position");
  set(dc1394_format7_set_image_size(camera.get(), mode.id, width, height), "the size");
  set(dc1394_format7_set_image_position(camera.get(), mode.id, static_cast<std::uint32_t>(roi.x),
                                        static_cast<std::uint32_t>(roi.y)),
      "the position");
  std::uint32_t bits = 8;
  set(dc1394_get_color_coding_bit_size(format.coding, &bits), "the coding");
  format.packet_bytes =
      choose_packet(camera, options, mode.id, static_cast<double>(roi.area()) * bits / 8);
  set(dc1394_format7_set_packet_size(camera.get(), mode.id,
                                     static_cast<std::uint32_t>(format.packet_bytes)),
      "the packet size");
  dc1394_format7_get_color_filter(camera.get(), mode.id, &format.filter);
  if (options.fps) {
    Dc1394FeatureSetting rate;
    rate.mode = Dc1394FeatureSetting::Mode::absolute;
    rate.absolute = *options.fps;
    rate.text = number_text(*options.fps);
    apply_feature(camera, "frame-rate", rate);
  }
  std::uint32_t packets = 0;
  set(dc1394_format7_get_packets_per_frame(camera.get(), mode.id, &packets), "the packets");
  format.period_s = packets / kPackets_per_s;
  return format;
}

}  // namespace

VideoFormat apply_video_format(const Camera& camera, const Dc1394Options& options,
                               const std::optional<CameraModel>& calibration) {
  const Mode mode = choose_mode(camera, options, calibration);
  VideoFormat format = is_format7(mode.id) ? apply_format7(camera, options, mode)
                                           : apply_fixed(camera, options, mode);
  const cv::Size wanted =
      calibration ? cv::Size(calibration->width_px, calibration->height_px) : format.size;
  if (wanted != format.size) {
    throw ConfigError(camera.name() + " would send " + size_text(format.size) + " (" + format.name +
                      "), but the calibration is for " + size_text(wanted) +
                      "; choose --video-mode and --roi accordingly, or calibrate it so");
  }
  return format;
}

}  // namespace anneal6d::dc1394
