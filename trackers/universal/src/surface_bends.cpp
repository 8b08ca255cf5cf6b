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

using Row = Eigen::Array<float, 1, Eigen::Dynamic>;

}  // namespace

// Row by row in Eigen's arrays, several pixels at a time.
void SurfaceBends::find_normals(const cv::Mat& depth_mm, const cv::Point& origin,
                                const CameraModel& camera, double jump_mm) {
  const int rows = depth_mm.rows, columns = depth_mm.cols, inner = columns - 2;
  for (Plane& plane : normals_) plane.setZero(rows, columns);
  if (rows < 3 || inner < 1) return;
  const auto fx = static_cast<float>(camera.fx_px), fy = static_cast<float>(camera.fy_px);
  const auto jump = static_cast<float>(jump_mm);
  const Row u = Row::LinSpaced(inner, 1.0F, static_cast<float>(inner)) +
                (static_cast<float>(origin.x) - static_cast<float>(camera.cx_px));
  for (int y = 1; y < rows - 1; ++y) {
    const auto depth = [&](int row, int shift) {
      return Eigen::Map<const Row>(depth_mm.ptr<float>(row) + 1 + shift, inner);
    };
    const auto z = depth(y, 0), left = depth(y, -1), right = depth(y, 1);
    const auto above = depth(y - 1, 0), below = depth(y + 1, 0);
    const float v = static_cast<float>(y + origin.y) - static_cast<float>(camera.cy_px);
    // The cross product of the surface's derivatives along x and y.
    const Row zx = 0.5F * (right - left), zy = 0.5F * (below - above);
    const Row nx = -fx * zx, ny = -fy * zy, nz = z + zx * u + zy * v;
    const Row step =
        (left - z).abs().max((right - z).abs()).max((above - z).abs()).max((below - z).abs());
    Row scale = (nx.square() + ny.square() + nz.square()).sqrt().inverse();
    for (int x = 0; x < inner; ++x) scale[x] = z[x] > 0.0F && step[x] < jump ? scale[x] : 0.0F;
    normals_[0].row(y).segment(1, inner) = nx * scale;
    normals_[1].row(y).segment(1, inner) = ny * scale;
    normals_[2].row(y).segment(1, inner) = nz * scale;
  }
}

void SurfaceBends::find_turns() {
  const Eigen::Index rows = normals_[0].rows(), columns = normals_[0].cols();
  const Eigen::Index inner = columns - 2 * kReach_px;
  turns_.setZero(rows, columns);
  if (inner < 1) return;
  Row xx(inner), yy(inner), xy(inner), bent(inner), least(inner);
  for (Eigen::Index y = kReach_px; y < rows - kReach_px; ++y) {
    const auto part = [&](const Plane& plane, Eigen::Index row, Eigen::Index shift) {
      return plane.row(row).segment(kReach_px + shift, inner);
    };
    xx.setZero();
    yy.setZero();
    xy.setZero();
    for (const Plane& normal : normals_) {
      const auto along_x = part(normal, y, kReach_px) - part(normal, y, -kReach_px);
      const auto along_y = part(normal, y + kReach_px, 0) - part(normal, y - kReach_px, 0);
      xx += along_x.square();
      yy += along_y.square();
      xy += along_x * along_y;
    }
    bent = (0.5F * (xx + yy) + ((0.5F * (xx - yy)).square() + xy.square()).sqrt()).sqrt();
    // Normals have a z; where there is none there is no surface.
    const Plane& z = normals_[2];
    least = part(z, y, -kReach_px)
                .abs()
                .min(part(z, y, kReach_px).abs())
                .min(part(z, y - kReach_px, 0).abs())
                .min(part(z, y + kReach_px, 0).abs());
    float* const turns = &turns_(y, kReach_px);
    for (Eigen::Index x = 0; x < inner; ++x) {
      turns[x] = least[x] > 0.0F ? std::max(bent[x], kFlat) : 0.0F;
    }
  }
}

Eigen::Vector3f SurfaceBends::normal_at(int x, int y) const {
  return {normals_[0](y, x), normals_[1](y, x), normals_[2](y, x)};
}

const std::vector<SurfaceBends::Bend>& SurfaceBends::find(const cv::Mat& depth_mm,
                                                          const cv::Point& origin,
                                                          const CameraModel& camera,
                                                          double jump_mm) {
  bends_.clear();
  find_normals(depth_mm, origin, camera, jump_mm);
  find_turns();
  for (int y = kBeside_px; y < depth_mm.rows - kBeside_px; ++y) {
    for (int x = kBeside_px; x < depth_mm.cols - kBeside_px; ++x) {
      const float here = turns_(y, x);
      if (here < kLeastTurn) continue;
      const Eigen::Vector3f along_x = normal_at(x + kReach_px, y) - normal_at(x - kReach_px, y);
      const Eigen::Vector3f along_y = normal_at(x, y + kReach_px) - normal_at(x, y - kReach_px);
      const float xx_less_yy = along_x.squaredNorm() - along_y.squaredNorm();
      // A ridge along the stronger axis, which falls off on both sides, and its place between
      // pixels.
      const int sx = xx_less_yy >= 0 ? 1 : 0, sy = 1 - sx;
      const float before = turns_(y - sy, x - sx), after = turns_(y + sy, x + sx);
      if (here < before || here <= after) continue;
      const double angle = 0.5 * std::atan2(2.0F * along_x.dot(along_y), xx_less_yy);
      const Eigen::Vector2d across(std::cos(angle), std::sin(angle));
      const auto beside = [&](double distance) {
        return turns_(y + cvRound(distance * across.y()), x + cvRound(distance * across.x()));
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
