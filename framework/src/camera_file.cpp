// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"
#include "text_tokens.h"
#include "yaml_values.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

// Calibration patterns seen by OpenCV's own calibration program make files of some 100 kB.
constexpr std::size_t kMaxCameraFileSize = std::size_t{16} << 20;

/// Fills in fx, fy, cx, cy. Empty, or what is wrong with the matrix.
std::string set_matrix(CameraModel& camera, std::span<const double> k) {
  if (k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1) {
    return "the camera matrix should have the form fx 0 cx, 0 fy cy, 0 0 1, row by row";
  }
  if (k[1] != 0) return "the camera matrix has a skew; only cameras without are supported";
  camera.fx_px = k[0];
  camera.fy_px = k[4];
  camera.cx_px = k[2];
  camera.cy_px = k[5];
  return {};
}

/// Fills in the distortion. Empty, or what is wrong with the coefficients.
std::string set_distortion(CameraModel& camera, std::span<const double> coefficients) {
  constexpr std::array<std::size_t, 5> kCounts = {4, 5, 8, 12, 14};
  if (std::find(kCounts.begin(), kCounts.end(), coefficients.size()) == kCounts.end()) {
    return "there are " + std::to_string(coefficients.size()) +
           " distortion coefficients; k1 k2 p1 p2 [k3] are expected (zeros if there is none)";
  }
  const std::size_t used = std::min(coefficients.size(), camera.distortion.size());
  std::copy_n(coefficients.begin(), used, camera.distortion.begin());
  const auto rest = coefficients.subspan(used);
  if (std::any_of(rest.begin(), rest.end(), [](double k) { return k != 0; })) {
    return "distortion coefficients beyond k1 k2 p1 p2 k3 are not supported; calibrate with "
           "OpenCV's "
           "five-parameter model (ROS: plumb_bob)";
  }
  return {};
}

std::vector<double> matrix_data(const YamlValues& yaml, const std::string& key) {
  const int rows = yaml.integer(key + ".rows");
  const int columns = yaml.integer(key + ".cols");
  const std::vector<double> data = yaml.numbers(key + ".data");
  if (rows < 0 || columns < 0 ||
      static_cast<long long>(rows) * columns != static_cast<long long>(data.size())) {
    yaml.fail(key + ".data", std::to_string(data.size()) + " numbers do not make a matrix of " +
                                 std::to_string(rows) + " rows and " + std::to_string(columns) +
                                 " columns");
  }
  return data;
}

/// Refuses lens models other than the pinhole with radial and tangential distortion.
void check_lens_model(const YamlValues& yaml) {
  constexpr std::array<std::string_view, 4> kModels = {"pinhole", "plumb_bob", "radtan",
                                                       "rational_polynomial"};
  for (const char* key : {"camera_model", "distortion_model"}) {
    const auto model = yaml.text(key);
    if (model && !model->empty() &&
        std::find(kModels.begin(), kModels.end(), *model) == kModels.end()) {
      yaml.fail(key, "the lens model " + excerpt(*model) +
                         " is not supported; calibrate with the pinhole model and plumb_bob");
    }
  }
  if (yaml.has("fisheye_model") && yaml.number("fisheye_model") != 0) {
    yaml.fail("fisheye_model",
              "fisheye lenses are not supported; calibrate with the pinhole model");
  }
}

CameraModel parse_yaml(const fs::path& path, std::string_view content) {
  const YamlValues yaml(path, content);
  check_lens_model(yaml);
  CameraModel camera;
  camera.width_px = yaml.integer("image_width");
  camera.height_px = yaml.integer("image_height");

  const std::vector<double> matrix = matrix_data(yaml, "camera_matrix");
  if (matrix.size() != 9 || yaml.integer("camera_matrix.rows") != 3) {
    yaml.fail("camera_matrix", "the camera matrix should have 3 rows and 3 columns");
  }
  if (const auto fault = set_matrix(camera, matrix); !fault.empty()) {
    yaml.fail("camera_matrix.data", fault);
  }
  const std::vector<double> distortion = matrix_data(yaml, "distortion_coefficients");
  if (const auto fault = set_distortion(camera, distortion); !fault.empty()) {
    yaml.fail("distortion_coefficients.data", fault);
  }
  return camera;
}

/// IVT's text: `N`, then for each camera w h, the matrix, d1..d4, R (9) and t (3); a stereo file
/// may end with 16 numbers (corners of the rectified images) and 18 (two homographies).
CameraModel parse_ivt(const fs::path& path, std::string_view content) {
  constexpr std::size_t kNumbersPerCamera = 27, kStereoTail = 16 + 18, kMaxCameras = 64;
  TextTokens tokens(path, content);
  const std::size_t cameras = tokens.count("the number of cameras");
  if (cameras < 1 || cameras > kMaxCameras) {
    tokens.fail_at_taken("the number of cameras, " + std::to_string(cameras) +
                         ", should be 1 to 64");
  }

  CameraModel first;
  for (std::size_t i = 0; i < cameras; ++i) {
    std::array<double, kNumbersPerCamera> values;
    for (std::size_t j = 0; j < values.size(); ++j) {
      values[j] = tokens.number("number " + std::to_string(j + 1) + " of 27 of camera " +
                                std::to_string(i + 1));
    }
    if (i > 0) continue;  // only checked
    const std::string place = "camera 1";
    for (const double size_px : {values[0], values[1]}) {
      if (size_px != std::floor(size_px) || std::abs(size_px) > 1e6) {
        throw FileError(path, place, "the image size should be whole numbers of pixels");
      }
    }
    first.width_px = static_cast<int>(values[0]);
    first.height_px = static_cast<int>(values[1]);
    const std::span<const double> all(values);
    for (const auto& fault :
         {set_matrix(first, all.subspan(2, 9)), set_distortion(first, all.subspan(11, 4))}) {
      if (!fault.empty()) throw FileError(path, place, fault);
    }
  }
  if (cameras == 2 && !tokens.at_end()) {
    for (std::size_t i = 0; i < kStereoTail; ++i) {
      tokens.number("number " + std::to_string(i + 1) + " of 34 of the stereo rectification");
    }
  }
  if (!tokens.at_end())
    tokens.fail_at_next(excerpt(tokens.peek()) + " after the end of the calibration");
  return first;
}

std::string formatted(double value) {  // the shortest text that reads back as the same number
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  std::string text(buffer.data(), result.ptr);
  // OpenCV tells real numbers from whole ones by the point.
  return text.find_first_of(".en") == std::string::npos ? text + "." : text;
}

std::string matrix_text(const std::string& key, int rows, std::span<const double> values) {
  std::string text = key + ": !!opencv-matrix\n   rows: " + std::to_string(rows) + "\n   cols: " +
                     std::to_string(values.size() / static_cast<std::size_t>(rows)) +
                     "\n   dt: d\n   data: [ ";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += (i > 0 ? ", " : "") + formatted(values[i]);
  }
  return text + " ]\n";
}

}  // namespace

CameraModel load_camera(const fs::path& path) {
  const std::string content = read_file(path, kMaxCameraFileSize);
  const TextTokens tokens(path, content);
  if (tokens.at_end()) throw FileError(path, "", "is empty; a camera calibration is expected");
  const bool is_yaml = content.starts_with("%YAML") ||
                       content.find("image_width") != std::string::npos ||
                       content.find("camera_matrix") != std::string::npos;
  if (!is_yaml && !parse_number(tokens.peek())) {
    throw FileError(path, "",
                    "is in none of the known formats of calibrations: OpenCV YAML, ROS "
                    "camera_info YAML, IVT text");
  }
  const CameraModel camera = is_yaml ? parse_yaml(path, content) : parse_ivt(path, content);
  try {
    camera.validate();
  } catch (const ConfigError& error) {
    throw FileError(path, "", error.what());
  }
  return camera;
}

void save_camera(const CameraModel& camera, const fs::path& path) {
  const std::array<double, 9> matrix = {
      camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1};
  write_file_atomically(path, "%YAML:1.0\n---\nimage_width: " + std::to_string(camera.width_px) +
                                  "\nimage_height: " + std::to_string(camera.height_px) + "\n" +
                                  matrix_text("camera_matrix", 3, matrix) +
                                  matrix_text("distortion_coefficients", 1, camera.distortion));
}

}  // namespace anneal6d
