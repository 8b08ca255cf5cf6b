// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

const cv::Scalar kRed(0, 0, 255);
const cv::Scalar kGreen(0, 255, 0);
const cv::Scalar kBlue(255, 64, 0);

// Fine lines, so that the photograph stays visible beside them.
EdgeOptions overlay_edges() {
  EdgeOptions options;
  options.op = EdgeOperator::canny;
  options.threshold = 100;
  return options;
}

std::string size_text(const cv::Mat& image) {
  return std::to_string(image.cols) + "x" + std::to_string(image.rows);
}

void check_same_size(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size()) {
    throw ConfigError("an edge image of " + size_text(b) + " does not fit a picture of " +
                      size_text(a));
  }
}

/// Where the point appears, or empty if it is too near or too far outside to be drawn.
std::optional<cv::Point> pixel_of(const CameraModel& camera, const Eigen::Vector3d& point_mm) {
  if (!(point_mm.z() >= kNearPlane_mm)) return std::nullopt;
  const Eigen::Vector2d pixel = camera.project(point_mm);
  constexpr double kFar_px = 30000;
  if (!(pixel.cwiseAbs().maxCoeff() < kFar_px)) return std::nullopt;
  return cv::Point(static_cast<int>(std::lround(pixel.x())),
                   static_cast<int>(std::lround(pixel.y())));
}

/// Frame and its distortion are the camera's; grey frames become BGR. Writes to `picture_bgr`.
void copy_as_bgr(const cv::Mat& image, cv::Mat& picture_bgr) {
  if (image.type() == CV_8UC1) {
    cv::cvtColor(image, picture_bgr, cv::COLOR_GRAY2BGR);
  } else {
    image.copyTo(picture_bgr);
  }
}

}  // namespace

EdgeImage rendered_edges(ObjectRenderer& renderer, const Pose& camera_from_object,
                         const Shading& shading, const EdgeOptions& options) {
  cv::Mat color;
  cv::Mat depth_mm;
  renderer.render(camera_from_object, shading, color, depth_mm);
  cv::cvtColor(color, color, cv::COLOR_BGR2GRAY);
  return detect_edges(color, options);
}

EdgeImage particle_edges(ObjectRenderer& renderer, std::span<const Pose> camera_from_object,
                         const Shading& shading, const EdgeOptions& options) {
  EdgeImage all;
  for (const Pose& pose : camera_from_object) {
    const EdgeImage one = rendered_edges(renderer, pose, shading, options);
    if (all.binary.empty()) {
      all = one;
    } else {
      cv::bitwise_or(all.binary, one.binary, all.binary);
    }
  }
  return all;
}

EdgeImage matched_edges(const EdgeImage& frame, const EdgeImage& rendered) {
  check_same_size(frame.binary, rendered.binary);
  EdgeImage matched;
  cv::bitwise_and(frame.binary, rendered.binary, matched.binary);
  return matched;
}

cv::Mat edge_picture(const EdgeImage& edges) {
  cv::Mat picture;
  cv::cvtColor(edges.binary, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

void draw_edges(cv::Mat& picture_bgr, const EdgeImage& edges, const cv::Vec3b& color_bgr) {
  check_same_size(picture_bgr, edges.binary);
  picture_bgr.setTo(cv::Scalar(color_bgr), edges.binary);
}

void draw_tripod(cv::Mat& picture_bgr, const CameraModel& camera, const Pose& camera_from_object,
                 double length_mm) {
  const std::array<cv::Scalar, 3> colors = {kRed, kGreen, kBlue};
  const auto origin = pixel_of(camera, camera_from_object.translation_mm);
  if (!origin) return;
  for (int axis = 0; axis < 3; ++axis) {
    const auto tip =
        pixel_of(camera, camera_from_object * (length_mm * Eigen::Vector3d::Unit(axis)));
    if (tip) {
      cv::arrowedLine(picture_bgr, *origin, *tip, colors[static_cast<std::size_t>(axis)], 2,
                      cv::LINE_AA, 0, 0.12);
    }
  }
}

void draw_status(cv::Mat& picture_bgr, std::int64_t frame, double quality, TrackStatus status) {
  std::array<char, 40> quality_text{};
  std::snprintf(quality_text.data(), quality_text.size(), "%.2f", quality);
  const std::string text = "frame " + std::to_string(frame) + "  quality " + quality_text.data() +
                           "  " + std::string(to_string(status));
  const cv::Scalar color =
      status == TrackStatus::lost ? cv::Scalar(70, 70, 255) : cv::Scalar::all(255);
  // A dark rim keeps the text legible on any picture.
  const double scale = 0.6 * std::max(1.0, picture_bgr.cols / 1280.0);
  const cv::Point place(cvRound(16 * scale), cvRound(40 * scale));
  cv::putText(picture_bgr, text, place, cv::FONT_HERSHEY_SIMPLEX, scale, cv::Scalar::all(0), 5,
              cv::LINE_AA);
  cv::putText(picture_bgr, text, place, cv::FONT_HERSHEY_SIMPLEX, scale, color, 2, cv::LINE_AA);
}

OverlayPainter::OverlayPainter(std::unique_ptr<ObjectRenderer> renderer,
                               std::shared_ptr<const TriangleMesh> mesh, const CameraModel& camera)
    : renderer_(std::move(renderer)), camera_(camera), undistort_(camera) {
  if (!renderer_ || !mesh) throw ConfigError("an overlay needs a renderer and a mesh");
  camera.validate();
  axis_length_mm_ = 0.5 * mesh->diameter_mm();
}

const cv::Mat& OverlayPainter::paint(const Frame& frame, const TrackResult& result) {
  if (frame.image.cols != camera_.width_px || frame.image.rows != camera_.height_px ||
      (frame.image.type() != CV_8UC1 && frame.image.type() != CV_8UC3)) {
    throw ConfigError("frame " + std::to_string(frame.index) + " has " + size_text(frame.image) +
                      " pixels and OpenCV type " + std::to_string(frame.image.type()) +
                      "; an overlay needs 8-bit grey or BGR of the calibration's " +
                      std::to_string(camera_.width_px) + "x" + std::to_string(camera_.height_px));
  }
  copy_as_bgr(undistort_(frame.image), picture_);

  renderer_->render(result.camera_from_object, Shading{}, color_, depth_mm_);
  // The outline, and inside it the edges that shading and texture make. Taking the outline from the
  // depth shows also a dark object whose grey hardly differs from the black background.
  cv::compare(depth_mm_, 0, mask_, cv::CMP_GT);
  cv::erode(mask_, outline_, cv::Mat());
  cv::Mat inside;
  cv::erode(outline_, inside, cv::Mat(), {-1, -1}, 2);
  cv::subtract(mask_, outline_, outline_);
  cv::cvtColor(color_, mask_, cv::COLOR_BGR2GRAY);
  EdgeImage edges = detect_edges(mask_, overlay_edges());
  cv::bitwise_and(edges.binary, inside, edges.binary);
  cv::bitwise_or(edges.binary, outline_, edges.binary);

  const bool lost = result.status == TrackStatus::lost;
  draw_edges(picture_, edges, lost ? cv::Vec3b(0, 0, 255) : cv::Vec3b(0, 255, 0));
  draw_tripod(picture_, camera_, result.camera_from_object, axis_length_mm_);
  draw_status(picture_, frame.index, result.quality, result.status);
  return picture_;
}

}  // namespace anneal6d
