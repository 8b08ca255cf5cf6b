// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "mode_names.h"

#include <algorithm>
#include <cstdio>

#include "anneal6d/framework/error.h"
#include "video_format.h"

namespace anneal6d::dc1394 {
namespace {

constexpr std::uint32_t kLargestSide_px = 16384;

struct CodingName {
  dc1394color_coding_t coding;
  const char* name;
};
constexpr CodingName kCodings[] = {
    {DC1394_COLOR_CODING_MONO8, "mono8"},   {DC1394_COLOR_CODING_YUV411, "yuv411"},
    {DC1394_COLOR_CODING_YUV422, "yuv422"}, {DC1394_COLOR_CODING_YUV444, "yuv444"},
    {DC1394_COLOR_CODING_RGB8, "rgb8"},     {DC1394_COLOR_CODING_MONO16, "mono16"},
    {DC1394_COLOR_CODING_RGB16, "rgb16"},   {DC1394_COLOR_CODING_MONO16S, "mono16s"},
    {DC1394_COLOR_CODING_RGB16S, "rgb16s"}, {DC1394_COLOR_CODING_RAW8, "raw8"},
    {DC1394_COLOR_CODING_RAW16, "raw16"},
};

[[noreturn]] void refuse_garbage(const Camera& camera, const std::string& what) {
  throw CaptureError(camera.name() + " answers nonsense: " + what +
                     "; switch it off and on again, and check the cable");
}

std::string rate_text(float rate) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", static_cast<double>(rate));
  return text;
}

std::string pair_text(int x, int y) { return std::to_string(x) + "x" + std::to_string(y); }

}  // namespace

std::string coding_name(dc1394color_coding_t coding) {
  for (const CodingName& row : kCodings) {
    if (row.coding == coding) return row.name;
  }
  return "coding " + std::to_string(static_cast<int>(coding));
}

std::optional<dc1394color_coding_t> coding_of(const std::string& name) {
  for (const CodingName& row : kCodings) {
    if (row.name == name) return row.coding;
  }
  return std::nullopt;
}

bool is_format7(dc1394video_mode_t mode) {
  return mode >= DC1394_VIDEO_MODE_FORMAT7_MIN && mode <= DC1394_VIDEO_MODE_FORMAT7_MAX;
}

std::string size_text(const cv::Size& size) { return pair_text(size.width, size.height); }

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::vector<Mode> list_modes(const Camera& camera) {
  dc1394video_modes_t list{};
  check(dc1394_video_get_supported_modes(camera.get(), &list), camera.name(), "read its modes");
  std::vector<Mode> modes;
  for (std::uint32_t i = 0; i < list.num; ++i) {
    Mode mode;
    mode.id = list.modes[i];
    if (mode.id == DC1394_VIDEO_MODE_EXIF) continue;
    std::uint32_t width = 0, height = 0;
    // Of Format_7 the library's general question answers with the current size.
    check(is_format7(mode.id)
              ? dc1394_format7_get_max_image_size(camera.get(), mode.id, &width, &height)
              : dc1394_get_image_size_from_video_mode(camera.get(), mode.id, &width, &height),
          camera.name(), "read the size of a mode");
    if (width == 0 || height == 0 || width > kLargestSide_px || height > kLargestSide_px) {
      refuse_garbage(
          camera, "a mode of " + std::to_string(width) + "x" + std::to_string(height) + " pixels");
    }
    mode.size = {static_cast<int>(width), static_cast<int>(height)};
    if (is_format7(mode.id)) {
      mode.name = "format7-" + std::to_string(mode.id - DC1394_VIDEO_MODE_FORMAT7_MIN);
    } else {
      check(dc1394_get_color_coding_from_video_mode(camera.get(), mode.id, &mode.coding),
            camera.name(), "read the coding of a mode");
      mode.name = size_text(mode.size) + "-" + coding_name(mode.coding);
    }
    modes.push_back(mode);
  }
  if (modes.empty()) refuse_garbage(camera, "it has no video mode");
  return modes;
}

std::vector<float> list_rates(const Camera& camera, dc1394video_mode_t mode) {
  dc1394framerates_t list{};
  check(dc1394_video_get_supported_framerates(camera.get(), mode, &list), camera.name(),
        "read its frame rates");
  std::vector<float> rates;
  for (std::uint32_t i = 0; i < list.num; ++i) {
    float rate = 0;
    if (dc1394_framerate_as_float(list.framerates[i], &rate) == DC1394_SUCCESS) {
      rates.push_back(rate);
    }
  }
  std::sort(rates.begin(), rates.end());
  return rates;
}

ScalableLimits scalable_limits(const Camera& camera, dc1394video_mode_t mode) {
  std::uint32_t width = 0, height = 0, unit_width = 0, unit_height = 0, left = 0, top = 0;
  const auto read = [&](dc1394error_t result) {
    check(result, camera.name(), "read the limits of a Format_7 mode");
  };
  read(dc1394_format7_get_max_image_size(camera.get(), mode, &width, &height));
  read(dc1394_format7_get_unit_size(camera.get(), mode, &unit_width, &unit_height));
  read(dc1394_format7_get_unit_position(camera.get(), mode, &left, &top));
  dc1394color_codings_t codings{};
  read(dc1394_format7_get_color_codings(camera.get(), mode, &codings));
  if (width == 0 || height == 0 || width > kLargestSide_px || height > kLargestSide_px ||
      unit_width == 0 || unit_height == 0 || left == 0 || top == 0 || unit_width > width ||
      unit_height > height || codings.num == 0 || codings.num > DC1394_COLOR_CODING_NUM) {
    refuse_garbage(camera, "a Format_7 mode of " + std::to_string(width) + "x" +
                               std::to_string(height) + " in steps of " +
                               std::to_string(unit_width) + "x" + std::to_string(unit_height));
  }
  ScalableLimits limits;
  limits.largest = {static_cast<int>(width), static_cast<int>(height)};
  limits.unit_size = {static_cast<int>(unit_width), static_cast<int>(unit_height)};
  limits.unit_position = {static_cast<int>(left), static_cast<int>(top)};
  limits.codings.assign(codings.codings, codings.codings + codings.num);
  return limits;
}

std::vector<std::string> mode_names(const Camera& camera) {
  std::vector<std::string> names;
  for (const Mode& mode : list_modes(camera)) names.push_back(mode.name);
  return names;
}

std::vector<std::string> report_modes(const Camera& camera) {
  std::vector<std::string> reports;
  for (const Mode& mode : list_modes(camera)) {
    std::vector<std::string> words;
    if (!is_format7(mode.id)) {
      for (const float rate : list_rates(camera, mode.id)) words.push_back(rate_text(rate));
      reports.push_back(mode.name + " at " + joined(words) + " fps");
      continue;
    }
    const ScalableLimits limits = scalable_limits(camera, mode.id);
    for (const auto coding : limits.codings) words.push_back(coding_name(coding));
    reports.push_back(mode.name + " up to " + size_text(limits.largest) + " in steps of " +
                      size_text(limits.unit_size) + ", position in steps of " +
                      pair_text(limits.unit_position.x, limits.unit_position.y) + ": " +
                      joined(words));
  }
  return reports;
}

}  // namespace anneal6d::dc1394
