// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "surface_bends.h"

#include <algorithm>
#include <cmath>

namespace anneal6d {
namespace {

constexpr int kReach_px = 2;        // to both sides, where normals are compared
constexpr int kBeside_px = 4;       // where a bend must be over
constexpr float kLeastTurn = 0.5F;  // rad
constexpr float kBesideShare = 0.6F;
constexpr float kFlat = 0.25F;  // rad, less is not told apart
static_assert(kFlat < kBesideShare * kLeastTurn);

}  // namespace

void SurfaceBends::find_normals(const cv::Mat& depth_mm, const cv::Point& origin,
                                const CameraModel& camera, double jump_mm) {
  normals_.create(depth_mm.size(), CV_32FC3);
  normals_.setTo(0);
  const auto fx = static_cast<float>(camera.fx_px), fy = static_cast<float>(camera.fy_px);
  const auto jump = static_cast<float>(jump_mm);
  for (int y = 1; y < depth_mm.rows - 1; ++y) {
    const auto* const above = depth_mm.ptr<float>(y - 1);
    const auto* const here = depth_mm.ptr<float>(y);
    const auto* const below = depth_mm.ptr<float>(y + 1);
    auto* const normals = normals_.ptr<cv::Vec3f>(y);
    const float ray_y = (static_cast<float>(y + origin.y) - static_cast<float>(camera.cy_px)) / fy;
    for (int x = 1; x < depth_mm.cols - 1; ++x) {
      const float z = here[x];
      if (z == 0.0F) continue;
      const float zx = 0.5F * (here[x + 1] - here[x - 1]), zy = 0.5F * (below[x] - above[x]);
      const auto steady = [&](float other) { return std::abs(other - z) < jump; };
      if (!steady(here[x - 1]) || !steady(here[x + 1]) || !steady(above[x]) || !steady(below[x])) {
        continue;
      }
      // The cross product of the surface's derivatives along x and y.
      const float ray_x =
          (static_cast<float>(x + origin.x) - static_cast<float>(camera.cx_px)) / fx;
      const float nx = -zx * fx, ny = -zy * fy;
      const float nz = z + zx * ray_x * fx + zy * ray_y * fy;
      const float scale = 1.0F / std::sqrt(nx * nx + ny * ny + nz * nz);
      normals[x] = {nx * scale, ny * scale, nz * scale};
    }
  }
}

SurfaceBends::Turn SurfaceBends::turn_at(int x, int y) const {
  Turn turn;
  const auto* const row = normals_.ptr<cv::Vec3f>(y);
  const cv::Vec3f& left = row[x - kReach_px];
  const cv::Vec3f& right = row[x + kReach_px];
  const cv::Vec3f& above = normals_.ptr<cv::Vec3f>(y - kReach_px)[x];
  const cv::Vec3f& below = normals_.ptr<cv::Vec3f>(y + kReach_px)[x];
  if (left[2] == 0 || right[2] == 0 || above[2] == 0 || below[2] == 0) return turn;
  const cv::Vec3f along_x = right - left, along_y = below - above;
  turn.xx = along_x.dot(along_x);
  turn.yy = along_y.dot(along_y);
  if (turn.xx + turn.yy < kFlat * kFlat) {  // most of a surface
    turn.amount = kFlat;
    return turn;
  }
  turn.xy = along_x.dot(along_y);
  const float half = 0.5F * (turn.xx - turn.yy);
  turn.amount = std::sqrt(0.5F * (turn.xx + turn.yy) + std::hypot(half, turn.xy));
  return turn;
}

const std::vector<SurfaceBends::Bend>& SurfaceBends::find(const cv::Mat& depth_mm,
                                                          const cv::Point& origin,
                                                          const CameraModel& camera,
                                                          double jump_mm) {
  bends_.clear();
  find_normals(depth_mm, origin, camera, jump_mm);
  amounts_.create(depth_mm.size(), CV_32FC1);
  amounts_.setTo(0);
  for (int y = kReach_px; y < depth_mm.rows - kReach_px; ++y) {
    auto* const amounts = amounts_.ptr<float>(y);
    for (int x = kReach_px; x < depth_mm.cols - kReach_px; ++x) amounts[x] = turn_at(x, y).amount;
  }
  for (int y = kBeside_px; y < depth_mm.rows - kBeside_px; ++y) {
    const auto* const amounts = amounts_.ptr<float>(y);
    for (int x = kBeside_px; x < depth_mm.cols - kBeside_px; ++x) {
      const float here = amounts[x];
      if (here < kLeastTurn) continue;
      const Turn turn = turn_at(x, y);
      const double angle = 0.5 * std::atan2(2.0 * turn.xy, turn.xx - turn.yy);
      const Eigen::Vector2d across(std::cos(angle), std::sin(angle));
      // A ridge along the stronger axis, which falls off on both sides, and its place between
      // pixels.
      const int sx = std::abs(across.x()) >= std::abs(across.y()) ? 1 : 0, sy = 1 - sx;
      const float before = amounts_.at<float>(y - sy, x - sx);
      const float after = amounts_.at<float>(y + sy, x + sx);
      if (here < before || here <= after) continue;
      const auto beside = [&](double distance) {
        return amounts_.at<float>(y + static_cast<int>(std::lround(distance * across.y())),
                                  x + static_cast<int>(std::lround(distance * across.x())));
      };
      const float left = beside(-kBeside_px), right = beside(kBeside_px);
      if (left == 0 || right == 0 || std::max(left, right) > kBesideShare * here) continue;
      const double offset = 0.5 * (before - after) / (before - 2 * here + after);
      bends_.push_back({{x + sx * offset, y + sy * offset}, across});
    }
  }
  return bends_;
}

}  // namespace anneal6d
