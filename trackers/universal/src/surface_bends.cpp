// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "surface_bends.h"

#include <algorithm>
#include <cmath>

#include "bend_kernels.h"
#include "ridge.h"

namespace anneal6d {
namespace {

constexpr int kBeside_px = 4;       // where a bend must be over
constexpr float kLeastTurn = 0.5F;  // rad
constexpr float kBesideShare = 0.6F;
static_assert(BendJob::kFlat < kBesideShare * kLeastTurn);

/// The unit vector at half the angle of `v` to the x axis, which is -90 to 90 degrees.
Eigen::Vector2d half_the_angle(const Eigen::Vector2d& v) {
  const double length = v.norm();
  if (length == 0) return Eigen::Vector2d::UnitX();
  const double cosine = v.x() / length;
  return {std::sqrt(0.5 * (1 + cosine)), std::copysign(std::sqrt(0.5 * (1 - cosine)), v.y())};
}

}  // namespace

Eigen::Vector3f SurfaceBends::normal_at(int x, int y) const {
  const auto place = static_cast<std::size_t>(y * columns_ + x);
  return {normals_[0][place], normals_[1][place], normals_[2][place]};
}

const std::vector<SurfaceBends::Bend>& SurfaceBends::find(const cv::Mat& depth_mm,
                                                          const cv::Point& origin,
                                                          const CameraModel& camera,
                                                          double jump_mm) {
  bends_.clear();
  columns_ = depth_mm.cols;
  if (std::min(depth_mm.rows, columns_) < BendJob::kNarrowest_px) return bends_;
  for (auto& normal : normals_) normal.resize(depth_mm.total());
  turns_.resize(depth_mm.total());
  const BendJob job{.depth_mm = depth_mm.ptr<float>(),
                    .depth_stride = static_cast<std::ptrdiff_t>(depth_mm.step1()),
                    .columns = columns_,
                    .rows = depth_mm.rows,
                    .fx = static_cast<float>(camera.fx_px),
                    .fy = static_cast<float>(camera.fy_px),
                    .cx = static_cast<float>(camera.cx_px - origin.x),
                    .cy = static_cast<float>(camera.cy_px - origin.y),
                    .jump_mm = static_cast<float>(jump_mm),
                    .normals = {normals_[0].data(), normals_[1].data(), normals_[2].data()},
                    .turns = turns_.data()};
  find_normals(job);
  find_turns(job);
  const auto turn_at = [&](int x, int y) {
    return turns_[static_cast<std::size_t>(y * columns_ + x)];
  };
  for (int y = kBeside_px; y < depth_mm.rows - kBeside_px; ++y) {
    for (int x = kBeside_px; x < depth_mm.cols - kBeside_px; ++x) {
      const float here = turn_at(x, y);
      if (here < kLeastTurn || depth_mm.at<float>(y, x) == 0) continue;
      // A ridge falls off on both sides along the axis in which the surface turns faster. Most
      // places are none along either.
      const auto falls_off = [&](int dx, int dy) {
        const float before = turn_at(x - dx, y - dy), after = turn_at(x + dx, y + dy);
        return (here >= before) & (here > after);
      };
      const bool ridge_along_x = falls_off(1, 0), ridge_along_y = falls_off(0, 1);
      if (!(ridge_along_x | ridge_along_y)) continue;
      constexpr int reach_px = BendJob::kReach_px;
      const Eigen::Vector3f along_x = normal_at(x + reach_px, y) - normal_at(x - reach_px, y);
      const Eigen::Vector3f along_y = normal_at(x, y + reach_px) - normal_at(x, y - reach_px);
      const float xx_less_yy = along_x.squaredNorm() - along_y.squaredNorm();
      if (!(xx_less_yy >= 0 ? ridge_along_x : ridge_along_y)) continue;
      const Eigen::Vector2d across = half_the_angle({xx_less_yy, 2.0F * along_x.dot(along_y)});
      const auto beside = [&](double distance) {
        return turn_at(x + cvRound(distance * across.x()), y + cvRound(distance * across.y()));
      };
      const float left = beside(-kBeside_px), right = beside(kBeside_px);
      if (left == 0 || right == 0 || std::max(left, right) > kBesideShare * here) continue;
      // Its place between pixels.
      const int sx = xx_less_yy >= 0 ? 1 : 0, sy = 1 - sx;
      const double offset = ridge_offset(turn_at(x - sx, y - sy), here, turn_at(x + sx, y + sy));
      bends_.push_back({{x + sx * offset, y + sy * offset}, across});
    }
  }
  return bends_;
}

}  // namespace anneal6d
