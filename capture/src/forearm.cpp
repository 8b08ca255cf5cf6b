// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "forearm.h"

#include <algorithm>
#include <cmath>

#include "simulation_random.h"

namespace anneal6d {
namespace {

const cv::Vec3d kSkin_bgr(115, 145, 200);
const cv::Vec3d kSleeve_bgr(120, 70, 50);
constexpr double kTip = 0.2;    // height of the fist's top, share of the image from above
constexpr double kCuff = 0.75;  // where the sleeve begins
constexpr double kLean = 0.25;  // sideways per upward pixel

// Where the arm's axis crosses the image's middle row: a triangle wave over the image's width and a
// margin, so that the arm leaves the picture on either side.
double axis_x_px(const Forearm& forearm, std::int64_t index, const cv::Size& size) {
  const double margin = forearm.radius_px + kLean * 0.5 * size.height;
  const double span = size.width + 2 * margin;
  const double start =
      random_uniform(simulation_key(forearm.seed, SimulationStream::occluder), 0) * 2 * span;
  const double phase = std::fmod(start + forearm.speed_px * static_cast<double>(index), 2 * span);
  return (phase < span ? phase : 2 * span - phase) - margin;
}

// Blotches of skin and weave of cloth: smooth noise that moves with the arm, about -1..1.
double blotch(double along_px, double across_px, double radius_px) {
  const double a = along_px / radius_px;
  const double b = across_px / radius_px;
  return 0.5 * std::sin(5.1 * a + 1.7 * std::sin(3.3 * b)) +
         0.5 * std::sin(7.3 * b + 2.1 * std::sin(2.9 * a));
}

}  // namespace

void draw_forearm(const Forearm& forearm, std::int64_t index, cv::Mat& image) {
  const double radius = forearm.radius_px;
  const cv::Vec2d direction = cv::normalize(cv::Vec2d(-kLean, 1));  // from the fist downwards
  const cv::Vec2d middle(axis_x_px(forearm, index, image.size()), 0.5 * image.rows);
  const cv::Vec2d fist =
      middle + direction * ((kTip * image.rows + radius - middle[1]) / direction[1]);
  const double cuff_px = (kCuff - kTip) * image.rows;
  for (int y = std::max(0, static_cast<int>(fist[1] - radius) - 1); y < image.rows; ++y) {
    auto* row = image.ptr<cv::Vec3b>(y);
    // The axis moves sideways with the row; a leaning arm is a little wider along a row.
    const double row_axis = middle[0] + (y - middle[1]) * direction[0] / direction[1];
    const double reach = radius / direction[1] + 2;
    const int first = std::max(0, static_cast<int>(std::floor(row_axis - reach)));
    const int last = std::min(image.cols - 1, static_cast<int>(std::ceil(row_axis + reach)));
    for (int x = first; x <= last; ++x) {
      const cv::Vec2d from_fist = cv::Vec2d(x, y) - fist;
      const double along = from_fist.dot(direction);
      const double across = from_fist[0] * direction[1] - from_fist[1] * direction[0];
      const double distance = along > 0 ? std::abs(across) : cv::norm(from_fist);
      const double coverage = std::clamp(radius - distance + 0.5, 0.0, 1.0);
      if (coverage <= 0) continue;
      const double roundness =
          std::sqrt(std::max(0.0, 1 - distance * distance / (radius * radius)));
      const double shade = (0.45 + 0.55 * roundness) * (1 + 0.07 * blotch(along, across, radius));
      const cv::Vec3d color = (along > cuff_px ? kSleeve_bgr : kSkin_bgr) * shade;
      for (int c = 0; c < 3; ++c) {
        row[x][c] =
            cv::saturate_cast<unsigned char>((1 - coverage) * row[x][c] + coverage * color[c]);
      }
    }
  }
}

}  // namespace anneal6d
