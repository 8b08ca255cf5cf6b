// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "scorer_cases.h"

#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/mesh_file.h"
#include "anneal6d/trackers/plugins.h"
#include "anneal6d/visualizer/reference_scorer.h"

namespace anneal6d::test {
namespace {

SharedMesh carried(const std::string& file) {
  return std::make_shared<const TriangleMesh>(
      load_mesh(std::string(ANNEAL6D_SAMPLE_MODELS) + "/" + file));
}

cv::Mat patches() {
  cv::Mat texture(128, 256, CV_8UC3);
  for (int row = 0; row < texture.rows; ++row) {
    for (int column = 0; column < texture.cols; ++column) {
      const bool light = (row / 32 + column / 32) % 2 == 0;
      texture.at<cv::Vec3b>(row, column) = light ? cv::Vec3b(200, 220, 240) : cv::Vec3b(60, 90, 20);
    }
  }
  return texture;
}

}  // namespace

ScorerTable all_scorers() {
  ScorerTable table = visualizer::scorer_plugins();
  for (ScorerPlugin& plugin : cpu_scorer_plugins()) table.push_back(std::move(plugin));
  return table;
}

CameraModel vga_camera() {
  return {.width_px = 640,
          .height_px = 480,
          .fx_px = 610,
          .fy_px = 600,
          .cx_px = 317.3,
          .cy_px = 244.9};
}

const std::vector<Model>& models() {
  static const std::vector<Model> all{{"MeasuringCup", carried("measuring_cup.obj")},
                                      {"TexturedOilCan", carried("oil_can.obj")},
                                      {"Cube", carried("cube84.obj")},
                                      {"Torus", make_torus(60, 22)},
                                      {"ColouredSphere", make_coloured_sphere(70)},
                                      {"OpenBowl", make_bowl(60)},
                                      {"TexturedOpenBowl", make_bowl(60, patches())}};
  return all;
}

const std::vector<EdgeCase>& edge_cases() {
  static const std::vector<EdgeCase> all{
      {"Sobel", {.threshold = 40}},
      {"SobelDilated", {.threshold = 40, .dilation_px = 2}},
      {"SobelBlurred", {.threshold = 40, .blur_sigma_px = 1.2}},
      {"Prewitt", {.op = EdgeOperator::prewitt, .threshold = 30}},
      {"Canny", {.op = EdgeOperator::canny, .threshold = 100}},
      {"CannyDilated", {.op = EdgeOperator::canny, .threshold = 100, .dilation_px = 1}}};
  return all;
}

std::vector<Pose> random_poses(const TriangleMesh& mesh, const CameraModel& camera,
                               Placement placement, std::uint32_t count) {
  std::vector<Pose> poses;
  const double radius_mm = mesh.radius_mm();
  for (std::uint32_t i = 0; i < count; ++i) {
    const RandomKey key{.seed = 17, .frame = static_cast<std::uint32_t>(placement), .particle = i};
    const auto between = [&](std::uint32_t draw, double low, double high) {
      return random_between(key, draw, low, high);
    };
    Eigen::Vector3d center_mm;
    if (placement == Placement::inside || placement == Placement::border) {
      const double radius_px = between(0, 40, 150);
      // Inside, the margin is wider than the radius: perspective enlarges what is near.
      const double margin_px = placement == Placement::inside ? 1.35 * radius_px : -radius_px;
      const double z_mm = radius_mm * camera.fx_px / radius_px;
      const double x_px = between(1, margin_px, camera.width_px - margin_px);
      const double y_px = between(2, margin_px, camera.height_px - margin_px);
      center_mm = {(x_px - camera.cx_px) / camera.fx_px * z_mm,
                   (y_px - camera.cy_px) / camera.fy_px * z_mm, z_mm};
    } else {
      const bool near = placement == Placement::near;
      const double z = near ? between(0, -0.5, 1.2) : between(0, -5.0, -1.2);
      center_mm = radius_mm * Eigen::Vector3d(between(1, -0.8, 0.8), between(2, -0.8, 0.8), z);
    }
    poses.push_back(pose_with_center(mesh, random_rotation(key), center_mm));
  }
  return poses;
}

EdgeImage cluttered_edges(const CameraModel& camera) {
  cv::Mat binary = cv::Mat::zeros(camera.height_px, camera.width_px, CV_8UC1);
  cv::RNG random(3);
  for (int i = 0; i < 150; ++i) {
    const cv::Point from(random.uniform(0, camera.width_px), random.uniform(0, camera.height_px));
    const cv::Point to(random.uniform(0, camera.width_px), random.uniform(0, camera.height_px));
    cv::line(binary, from, to, 255, 3);
  }
  return {binary};
}

EdgeImage uniform_edges(const CameraModel& camera, int value) {
  return {cv::Mat(camera.height_px, camera.width_px, CV_8UC1, cv::Scalar(value))};
}

std::vector<EdgeMatch> scores(PoseScorer& scorer, std::span<const Pose> poses) {
  std::vector<EdgeMatch> matches(poses.size(), EdgeMatch{-1, -1});
  scorer.score(poses, matches);
  return matches;
}

}  // namespace anneal6d::test
