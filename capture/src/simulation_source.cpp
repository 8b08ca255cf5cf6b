// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/simulation_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/srgb.h"
#include "background.h"
#include "forearm.h"
#include "simulation_random.h"
#include "size_text.h"
#include "trajectory.h"

namespace anneal6d {
namespace {

constexpr double kSimulatedFramesPerSecond = 30;
constexpr int kExposures = 9;         // views averaged for motion blur
constexpr double kStartHeight = 0.4;  // of the image, covered by the object's diameter
constexpr double kMovingLightPeriod = 120;
constexpr double kChangingLightPeriod = 60;
constexpr double kChangingLightSwing = 1.0 / 3;

Shading shading_of(SimulatedLight light, std::int64_t index) {
  Shading shading;
  if (light != SimulatedLight::moving) return shading;
  const double angle = 2 * std::numbers::pi * static_cast<double>(index) / kMovingLightPeriod;
  const Eigen::AngleAxisf turn(static_cast<float>(angle), Eigen::Vector3f::UnitZ());
  shading.to_light = turn * shading.to_light;
  return shading;
}

double brightness_of(SimulatedLight light, std::int64_t index) {
  if (light != SimulatedLight::changing) return 1;
  return 1 + kChangingLightSwing *
                 std::sin(2 * std::numbers::pi * static_cast<double>(index) / kChangingLightPeriod);
}

// For each pixel of the distorted picture, where it lies in the undistorted one.
void make_distortion_maps(const CameraModel& camera, cv::Mat& map_x, cv::Mat& map_y) {
  std::vector<cv::Point2d> distorted, undistorted;
  distorted.reserve(static_cast<std::size_t>(camera.width_px) *
                    static_cast<std::size_t>(camera.height_px));
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) distorted.emplace_back(x, y);
  }
  const cv::TermCriteria precise(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 60, 1e-8);
  cv::undistortPoints(distorted, undistorted, camera.matrix(), camera.distortion, cv::noArray(),
                      camera.matrix(), precise);
  map_x.create(camera.height_px, camera.width_px, CV_32FC1);
  map_y.create(map_x.size(), CV_32FC1);
  for (std::size_t i = 0; i < undistorted.size(); ++i) {
    map_x.ptr<float>()[i] = static_cast<float>(undistorted[i].x);
    map_y.ptr<float>()[i] = static_cast<float>(undistorted[i].y);
  }
}

// Adds Gaussian noise to every value of a CV_8UC3 image, the same on any number of threads.
void add_noise(cv::Mat& image, double sigma, std::uint64_t seed, std::int64_t index) {
  const int values = 3 * image.cols;
  cv::parallel_for_({0, image.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      const RandomKey key =
          simulation_key(seed, SimulationStream::noise, static_cast<std::uint32_t>(index),
                         static_cast<std::uint32_t>(y));
      unsigned char* row = image.ptr(y);
      for (int i = 0; i < values; i += 2) {
        const auto normals = random_normals(key, static_cast<std::uint32_t>(i / 2));
        row[i] = cv::saturate_cast<unsigned char>(row[i] + sigma * normals[0]);
        if (i + 1 == values) break;
        row[i + 1] = cv::saturate_cast<unsigned char>(row[i + 1] + sigma * normals[1]);
      }
    }
  });
}

/// Of 8-bit grey levels, for cv::LUT.
const cv::Mat& light_table() {
  static const std::array<float, 256> values = srgb_light_table();
  static const cv::Mat table(1, 256, CV_32FC1, const_cast<float*>(values.data()));
  return table;
}

constexpr int kEncodeSteps = 65536;

/// Lays premultiplied `color` over `background`, both linear light, 0..1; `image` is encoded.
void compose(const cv::Mat& color, const cv::Mat& coverage, const cv::Mat& background,
             double brightness, cv::Mat& image) {
  image.create(background.size(), CV_8UC3);
  static const std::vector<unsigned char> encode = [] {
    std::vector<unsigned char> levels(kEncodeSteps + 1);
    for (int i = 0; i <= kEncodeSteps; ++i) {
      levels[static_cast<std::size_t>(i)] = cv::saturate_cast<unsigned char>(
          255.0 * encoded_srgb(static_cast<double>(i) / kEncodeSteps));
    }
    return levels;
  }();
  for (int y = 0; y < image.rows; ++y) {
    const auto* object = color.ptr<cv::Vec3f>(y);
    const auto* share = coverage.ptr<float>(y);
    const auto* behind = background.ptr<cv::Vec3f>(y);
    auto* out = image.ptr<cv::Vec3b>(y);
    for (int x = 0; x < image.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double light = brightness * (object[x][c] + (1 - share[x]) * behind[x][c]);
        out[x][c] = encode[static_cast<std::size_t>(
            std::lround(kEncodeSteps * std::clamp(light, 0.0, 1.0)))];
      }
    }
  }
}

CameraModel dense_camera(const CameraModel& camera, int supersampling) {
  CameraModel dense = camera.scaled(supersampling);
  dense.distortion = {};
  try {
    dense.validate();
  } catch (const ConfigError& error) {
    throw ConfigError("simulation: a supersampling of " + std::to_string(supersampling) +
                      " is too much for this camera: " + error.what());
  }
  return dense;
}

}  // namespace

CameraModel default_simulation_camera() {
  CameraModel camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 650;
  camera.cx_px = 319.5;
  camera.cy_px = 239.5;
  return camera;
}

Pose default_start_pose(const TriangleMesh& mesh, const CameraModel& camera) {
  constexpr double degree = std::numbers::pi / 180;
  const Eigen::AngleAxisd upright(180 * degree, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd from_above(30 * degree, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd sideways(35 * degree, Eigen::Vector3d::UnitY());
  Pose pose;
  pose.rotation = Eigen::Quaterniond(from_above * upright * sideways).normalized();
  const double distance_mm = camera.fy_px * mesh.diameter_mm() / (kStartHeight * camera.height_px);
  pose.translation_mm =
      Eigen::Vector3d(0, 0, distance_mm) - pose.rotation * mesh.center_mm().cast<double>();
  return pose;
}

SimulationSource::SimulationSource(std::shared_ptr<const TriangleMesh> mesh,
                                   const CameraModel& camera, SimulationOptions options,
                                   const ObjectRendererFactory& make_renderer)
    : mesh_(std::move(mesh)), camera_(camera), options_(std::move(options)) {
  options_.validate();
  camera_.validate();
  if (!mesh_) throw ConfigError("simulation: there is no model to draw");
  if (!make_renderer) {
    throw ConfigError("simulation: this program has nothing that can draw the model");
  }
  const Pose start = options_.start.value_or(default_start_pose(*mesh_, camera_));
  const double distance_mm = (start * mesh_->center_mm().cast<double>()).z();
  if (distance_mm <= kNearPlane_mm) {
    throw ConfigError("simulation: the start pose (init) puts the object's centre at z = " +
                      std::to_string(distance_mm) +
                      " mm, behind or inside the camera; z must be positive");
  }
  trajectory_ = simulate_trajectory(options_, start, VisibleVolume(*mesh_, camera_, start));
  cv::LUT(
      make_background(options_.background, {camera_.width_px, camera_.height_px}, options_.seed),
      light_table(), background_);
  if (camera_.has_distortion()) make_distortion_maps(camera_, distort_x_, distort_y_);
  const double diameter_px = 2 * mesh_->radius_mm() * camera_.fx_px / distance_mm;
  occluder_radius_px_ = 0.5 * options_.occluder_size * diameter_px;
  renderer_ = make_renderer(mesh_, dense_camera(camera_, options_.supersampling));
}

std::optional<Frame> SimulationSource::next() {
  if (position_ >= options_.frames) return std::nullopt;
  Frame frame;
  frame.index = position_++;
  frame.timestamp_s = static_cast<double>(frame.index) / kSimulatedFramesPerSecond;

  draw_object(frame.index);
  const double brightness = brightness_of(options_.light, frame.index);
  compose(color_, coverage_, background_, brightness, frame.image);
  if (options_.occluder) {
    draw_forearm({occluder_radius_px_, options_.occluder_speed_px, options_.seed}, frame.index,
                 frame.image);
  }
  if (options_.noise > 0) add_noise(frame.image, options_.noise, options_.seed, frame.index);
  return frame;
}

void SimulationSource::draw_object(std::int64_t index) {
  color_.create(background_.size(), CV_32FC3);
  coverage_.create(background_.size(), CV_32FC1);
  color_.setTo(0);
  coverage_.setTo(0);
  const Shading shading = shading_of(options_.light, index);
  const int views = options_.blur > 0 ? kExposures : 1;
  for (int view = 0; view < views; ++view) {
    const double offset = options_.blur * ((view + 0.5) / views - 0.5);
    add_view(pose_at(trajectory_, static_cast<double>(index) + offset), shading, 1.0 / views);
  }
  if (distort_x_.empty()) return;
  cv::remap(color_, scratch_color_, distort_x_, distort_y_, cv::INTER_LINEAR);
  cv::remap(coverage_, scratch_coverage_, distort_x_, distort_y_, cv::INTER_LINEAR);
  std::swap(color_, scratch_color_);
  std::swap(coverage_, scratch_coverage_);
}

void SimulationSource::add_view(const Pose& camera_from_object, const Shading& shading,
                                double weight) {
  renderer_->render(camera_from_object, shading, dense_color_, dense_depth_);
  dense_coverage_ = dense_depth_ > 0;
  // A pixel mixes light, not encoded values. Averaging what is black outside the object yields
  // light premultiplied by coverage.
  cv::LUT(dense_color_, light_table(), dense_light_);
  cv::resize(dense_light_, view_light_, color_.size(), 0, 0, cv::INTER_AREA);
  cv::resize(dense_coverage_, view_coverage_, color_.size(), 0, 0, cv::INTER_AREA);
  cv::scaleAdd(view_light_, weight, color_, color_);
  view_coverage_.convertTo(scratch_coverage_, CV_32F);
  cv::scaleAdd(scratch_coverage_, weight / 255, coverage_, coverage_);
}

std::int64_t SimulationSource::skip(std::int64_t count) {
  const std::int64_t skipped = std::clamp<std::int64_t>(count, 0, options_.frames - position_);
  position_ += skipped;
  return skipped;
}

std::string SimulationSource::description() const {
  return "simulation, " + std::to_string(options_.frames) + " frames of " +
         size_text({camera_.width_px, camera_.height_px}) + ", " +
         std::string(to_string(options_.motion)) + ", seed " + std::to_string(options_.seed);
}

std::optional<Pose> SimulationSource::ground_truth() const {
  if (position_ == 0) return std::nullopt;
  return trajectory_[static_cast<std::size_t>(position_ - 1)];
}

}  // namespace anneal6d
