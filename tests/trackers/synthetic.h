// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "anneal6d/framework/srgb.h"
#include "rasterizer.h"
#include "shapes.h"
#include "view_painter.h"
#include "workers.h"

namespace anneal6d::test {

inline constexpr double kDegree = std::numbers::pi / 180.0;

/// The calling thread alone.
inline Workers& workers() {
  static Workers alone(1);
  return alone;
}

inline CameraModel small_camera() {
  return {.width_px = 320,
          .height_px = 240,
          .fx_px = 310,
          .fy_px = 300,
          .cx_px = 161.3,
          .cy_px = 118.6};
}

/// An object before the small camera, three of its sides in sight.
inline Pose corner_view() {
  return {rotation_from_axis_angle(Eigen::Vector3d::UnitX(), 0.6) *
              rotation_from_axis_angle(Eigen::Vector3d::UnitY(), 0.7),
          {5, -3, 320}};
}

/// Cylinder around the object's z axis, with caps, closed.
inline SharedMesh make_cylinder(double length_mm, double radius_mm, std::uint32_t facets) {
  const auto radius = static_cast<float>(radius_mm), half = static_cast<float>(length_mm / 2);
  // Half of a section, from one end of the axis to the other.
  const std::array<Eigen::Vector2f, 4> profile = {
      {{0, -half}, {radius, -half}, {radius, half}, {0, half}}};
  return make_grid(facets, 2 * std::numbers::pi, 3, 0, 3, [&](double u, double v) {
    const Eigen::Vector2f& p = profile[static_cast<std::size_t>(std::lround(v))];
    return vertex_at(p.x() * static_cast<float>(std::cos(u)),
                     p.x() * static_cast<float>(std::sin(u)), p.y());
  });
}

/// Box of these sides around the object's origin whose edges are quarters of cylinders and whose
/// corners are eighths of spheres: all points at `radius_mm` from a smaller box. Closed, without
/// creases: neighbouring faces differ by at most 15 degrees.
inline SharedMesh make_rounded_box(const Eigen::Vector3d& sides_mm, double radius_mm) {
  const Eigen::Vector3d inner_mm = sides_mm / 2 - Eigen::Vector3d::Constant(radius_mm);
  // Along each side of a face: which end of the inner box is nearest, and the surface's slope.
  std::vector<std::pair<double, double>> steps;
  for (const double slope_deg : {-45, -30, -15, 0}) {
    steps.emplace_back(-1.0, std::tan(slope_deg * kDegree));
  }
  for (const double slope_deg : {0, 15, 30, 45}) {
    steps.emplace_back(1.0, std::tan(slope_deg * kDegree));
  }
  const auto count = static_cast<std::uint32_t>(steps.size());
  std::vector<MeshVertex> vertices;
  std::vector<Triangle> triangles;
  for (int face = 0; face < 6; ++face) {
    const int w = face / 2, u = (w + 1) % 3, v = (w + 2) % 3;
    const double outward = face % 2 ? 1 : -1;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      for (std::uint32_t k = 0; k < count; ++k) {
        Eigen::Vector3d nearest_mm, normal;
        nearest_mm[u] = steps[i].first * inner_mm[u];
        nearest_mm[v] = steps[k].first * inner_mm[v];
        nearest_mm[w] = outward * inner_mm[w];
        normal[u] = steps[i].second;
        normal[v] = steps[k].second;
        normal[w] = outward;
        normal.normalize();
        MeshVertex vertex;
        vertex.position_mm = (nearest_mm + radius_mm * normal).cast<float>();
        vertex.normal = normal.cast<float>();
        vertices.push_back(vertex);
        if (i + 1 == count || k + 1 == count) continue;
        const std::uint32_t here = first + i * count + k, next = here + count;
        const std::uint32_t left = outward > 0 ? here + 1 : next;
        const std::uint32_t right = outward > 0 ? next : here + 1;
        triangles.push_back({here, right, next + 1});
        triangles.push_back({here, next + 1, left});
      }
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

/// The object as drawn, as large as the image.
struct Drawing {
  Region region;
  cv::Mat grey;      ///< CV_8UC1
  cv::Mat depth_mm;  ///< CV_32FC1, 0 where there is no object
};

inline Drawing draw(const RasterModel& model, const CameraModel& camera, const Pose& pose,
                    int margin_px = 2, const Shading& shading = {}) {
  Drawing drawing;
  drawing.grey = cv::Mat::zeros(camera.height_px, camera.width_px, CV_8UC1);
  drawing.depth_mm = cv::Mat::zeros(camera.height_px, camera.width_px, CV_32FC1);
  Rasterizer rasterizer(model, camera, shading);
  cv::Mat grey, depth_mm;
  const Region region = rasterizer.draw_images(pose, margin_px, grey, &depth_mm);
  drawing.region = region;
  if (region.empty()) return drawing;
  const cv::Rect window(region.x, region.y, region.width, region.height);
  grey.copyTo(drawing.grey(window));
  depth_mm.copyTo(drawing.depth_mm(window));
  return drawing;
}

/// What a camera would see before a plain background: drawn four times as densely, light mixed
/// within each pixel, and encoded; for levels of 11 and more. `noise`: standard deviation in grey
/// levels; `frame` varies it.
inline cv::Mat photograph(const RasterModel& model, const CameraModel& camera, const Pose& pose,
                          int background = 60, double noise = 0, int frame = 0,
                          const Shading& shading = {}) {
  Drawing dense = draw(model, camera.scaled(4), pose, 2, shading);
  dense.grey.setTo(background, dense.depth_mm == 0);
  const auto levels = srgb_light_table();
  cv::Mat light, mixed, encoded;
  cv::LUT(dense.grey, cv::Mat(1, 256, CV_32FC1, const_cast<float*>(levels.data())), light);
  cv::resize(light, mixed, {camera.width_px, camera.height_px}, 0, 0, cv::INTER_AREA);
  // encoded_srgb() of a whole image, but for its straight part near black.
  cv::pow(mixed, 1 / 2.4, encoded);
  encoded.convertTo(encoded, CV_32F, 255 * 1.055, 255 * -0.055);
  if (noise > 0) {
    cv::Mat deviations(encoded.size(), CV_32FC1);
    cv::RNG random(static_cast<std::uint64_t>(frame) + 1);
    random.fill(deviations, cv::RNG::NORMAL, 0, noise);
    encoded += deviations;
  }
  cv::Mat image;
  encoded.convertTo(image, CV_8U);
  return image;
}

/// Views of an object for poses near one: what is seen from there stands for all sides.
inline ViewModel views_near(const RasterModel& model, const Pose& pose) {
  const Eigen::Vector3d center_mm = model.mesh->center_mm().cast<double>();
  const Eigen::Vector3d direction = (pose.inverse().translation_mm - center_mm).normalized();
  ViewPainter painter(model, {.threshold = 40}, Shading{}, view_camera());
  return {center_mm, std::vector<ModelView>(ViewModel::kViews, painter.paint(direction, 1))};
}

/// A pose beside another: turned by a vector in degrees about the object's centre and shifted,
/// camera frame.
inline Pose beside(const TriangleMesh& mesh, const Pose& pose, const Eigen::Vector3d& turn_deg,
                   const Eigen::Vector3d& shift_mm) {
  const Eigen::Vector3d center = pose * mesh.center_mm().cast<double>();
  const auto rotation = (rotation_from_vector(turn_deg * kDegree) * pose.rotation).normalized();
  return pose_with_center(mesh, rotation, center + shift_mm);
}

inline double angle_deg(const Pose& a, const Pose& b) {
  return angle_between(a.rotation, b.rotation) / kDegree;
}

/// Distance of the places of the object's centre.
inline double center_distance_mm(const TriangleMesh& mesh, const Pose& a, const Pose& b) {
  const Eigen::Vector3d center = mesh.center_mm().cast<double>();
  return (a * center - b * center).norm();
}

}  // namespace anneal6d::test
