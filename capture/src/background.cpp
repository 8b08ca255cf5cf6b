// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "image_file.h"
#include "simulation_random.h"

namespace anneal6d {
namespace {

const cv::Scalar kPlain(0, 0, 0);
constexpr int kShapes = 90;
constexpr int kSubpixelBits = 4;

// Draws numbers one after the other for one shape.
class Draws {
 public:
  Draws(std::uint64_t seed, int shape)
      : key_(simulation_key(seed, SimulationStream::clutter, 0,
                            static_cast<std::uint32_t>(shape))) {}

  double between(double low, double high) {
    return low + (high - low) * random_uniform(key_, draw_++);
  }
  cv::Point2d point(const cv::Size& size) {
    const double x = between(-0.1, 1.1) * size.width;
    return {x, between(-0.1, 1.1) * size.height};
  }
  // Mostly dull, as things in a room are: grey with some tint.
  cv::Scalar color() {
    const double grey = between(15, 230);
    const double tint = between(0, 60);
    const double blue = grey + tint * between(-1, 1);
    const double green = grey + tint * between(-1, 1);
    return {blue, green, grey + tint * between(-1, 1)};
  }

 private:
  RandomKey key_;
  std::uint32_t draw_ = 0;
};

cv::Point fixed_point(const cv::Point2d& point) {
  constexpr double scale = 1 << kSubpixelBits;
  return {static_cast<int>(std::lround(point.x * scale)),
          static_cast<int>(std::lround(point.y * scale))};
}

// A linear gradient from one colour to another over the whole picture.
void fill_gradient(cv::Mat& image, Draws& draws) {
  const cv::Scalar from = draws.color();
  const cv::Scalar to = draws.color();
  const double angle = draws.between(0, 2 * std::numbers::pi);
  const double dx = std::cos(angle) / image.cols;
  const double dy = std::sin(angle) / image.rows;
  for (int y = 0; y < image.rows; ++y) {
    auto* row = image.ptr<cv::Vec3b>(y);
    for (int x = 0; x < image.cols; ++x) {
      const double share =
          std::clamp(0.5 + (x - 0.5 * image.cols) * dx + (y - 0.5 * image.rows) * dy, 0.0, 1.0);
      for (int c = 0; c < 3; ++c) {
        row[x][c] = cv::saturate_cast<unsigned char>((1 - share) * from[c] + share * to[c]);
      }
    }
  }
}

// Corners of a box turned by a random angle.
std::array<cv::Point, 4> box(const cv::Point2d& center, double width, double height, double angle) {
  const cv::Point2d along(0.5 * width * std::cos(angle), 0.5 * width * std::sin(angle));
  const cv::Point2d across(-0.5 * height * std::sin(angle), 0.5 * height * std::cos(angle));
  return {fixed_point(center - along - across), fixed_point(center + along - across),
          fixed_point(center + along + across), fixed_point(center - along + across)};
}

void draw_box(cv::Mat& image, Draws& draws) {
  const double unit = image.rows;
  const cv::Point2d center = draws.point(image.size());
  const double width = draws.between(0.04, 0.3) * unit;
  const double height = draws.between(0.04, 0.3) * unit;
  const double angle = draws.between(0, std::numbers::pi);
  const cv::Scalar face = draws.color();
  cv::fillConvexPoly(image, box(center, width, height, angle), face, cv::LINE_AA, kSubpixelBits);
  if (draws.between(0, 1) < 0.4) {  // striped, as a book's back or a label
    const cv::Scalar ink = draws.color();
    const int stripes = static_cast<int>(draws.between(2, 7));
    for (int i = 0; i < stripes; ++i) {
      const double offset = ((i + 0.5) / stripes - 0.5) * width;
      const cv::Point2d at(center.x + offset * std::cos(angle),
                           center.y + offset * std::sin(angle));
      cv::fillConvexPoly(image, box(at, 0.4 * width / stripes, 0.8 * height, angle), ink,
                         cv::LINE_AA, kSubpixelBits);
    }
  }
}

void draw_disc(cv::Mat& image, Draws& draws) {
  const cv::Point center = fixed_point(draws.point(image.size()));
  const cv::Size axes =
      fixed_point({draws.between(0.02, 0.12) * image.rows, draws.between(0.02, 0.12) * image.rows});
  const double angle = draws.between(0, 180);
  cv::ellipse(image, center, axes, angle, 0, 360, draws.color(), cv::FILLED, cv::LINE_AA,
              kSubpixelBits);
}

void draw_line(cv::Mat& image, Draws& draws) {
  const cv::Point2d from = draws.point(image.size());
  const cv::Point2d to = draws.point(image.size());
  const int thickness = 1 + static_cast<int>(draws.between(0, 0.008) * image.rows);
  cv::line(image, fixed_point(from), fixed_point(to), draws.color(), thickness, cv::LINE_AA,
           kSubpixelBits);
}

cv::Mat draw_clutter(const cv::Size& size, std::uint64_t seed) {
  cv::Mat image(size, CV_8UC3);
  Draws first(seed, 0);
  fill_gradient(image, first);
  for (int shape = 1; shape <= kShapes; ++shape) {
    Draws draws(seed, shape);
    const double kind = draws.between(0, 1);
    if (kind < 0.55) {
      draw_box(image, draws);
    } else if (kind < 0.8) {
      draw_disc(image, draws);
    } else {
      draw_line(image, draws);
    }
  }
  // No lens is sharper than this.
  cv::GaussianBlur(image, image, {}, 0.7);
  return image;
}

// Scales `image` to cover `size` and cuts off what stands over, equally on both sides.
cv::Mat fill_frame(const cv::Mat& image, const cv::Size& size) {
  const double scale = std::max(static_cast<double>(size.width) / image.cols,
                                static_cast<double>(size.height) / image.rows);
  const cv::Size scaled_size(
      std::max(size.width, static_cast<int>(std::lround(image.cols * scale))),
      std::max(size.height, static_cast<int>(std::lround(image.rows * scale))));
  cv::Mat scaled;
  cv::resize(image, scaled, scaled_size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  const cv::Rect middle((scaled.cols - size.width) / 2, (scaled.rows - size.height) / 2, size.width,
                        size.height);
  return scaled(middle).clone();
}

}  // namespace

cv::Mat make_background(const std::string& background, const cv::Size& size, std::uint64_t seed) {
  if (background == "none") return cv::Mat(size, CV_8UC3, kPlain);
  if (background == "clutter") return draw_clutter(size, seed);
  cv::Mat image = read_image(background);
  if (image.channels() == 1) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  return fill_frame(image, size);
}

}  // namespace anneal6d
