// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "bench_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "anneal6d/capture/simulation_source.h"
#include "anneal6d/framework/random.h"
#include "plugins.h"

namespace anneal6d {

namespace {

constexpr float kHeight_mm = 140, kBottomRadius_mm = 48, kTopRadius_mm = 60, kWall_mm = 4;
constexpr double kTurn_rad = 2 * std::numbers::pi;

/// A mesh that grows by rows of vertices, each joined to the row before.
class SurfaceBuilder {
 public:
  /// Starts a new surface: the next row is joined to none.
  void lift() { previous_size_ = 0; }

  /// Of two rows one may be a single point; else they are equally long.
  void add_row(const std::vector<Eigen::Vector3f>& row) {
    const auto begin = static_cast<std::uint32_t>(vertices_.size());
    for (const Eigen::Vector3f& position_mm : row) {
      vertices_.emplace_back();
      vertices_.back().position_mm = position_mm;
    }
    const auto size = static_cast<std::uint32_t>(row.size());
    const std::uint32_t longer = std::max(size, previous_size_);
    for (std::uint32_t i = 0; previous_size_ > 0 && i + 1 < longer; ++i) {
      const auto above = [&](std::uint32_t k) { return previous_begin_ + k % previous_size_; };
      const auto here = [&](std::uint32_t k) { return begin + k % size; };
      if (size > 1) triangles_.push_back({above(i), here(i), here(i + 1)});
      if (previous_size_ > 1) triangles_.push_back({above(i), here(i + 1), above(i + 1)});
    }
    previous_begin_ = begin;
    previous_size_ = size;
  }

  std::shared_ptr<const TriangleMesh> finish() {
    return std::make_shared<const TriangleMesh>(std::move(vertices_), std::move(triangles_));
  }

 private:
  std::vector<MeshVertex> vertices_;
  std::vector<Triangle> triangles_;
  std::uint32_t previous_begin_ = 0, previous_size_ = 0;
};

/// `steps` + 1 points around the y axis: the last is the first again, and is welded to it.
std::vector<Eigen::Vector3f> ring(float radius_mm, float y_mm, std::uint32_t steps) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint32_t i = 0; i <= steps; ++i) {
    const double angle = kTurn_rad * (i % steps) / steps;
    points.emplace_back(radius_mm * static_cast<float>(std::cos(angle)), y_mm,
                        radius_mm * static_cast<float>(std::sin(angle)));
  }
  return points;
}

void add_wall(SurfaceBuilder& surface, float inset_mm, float from_y_mm, float to_y_mm,
              std::uint32_t around, std::uint32_t steps) {
  for (std::uint32_t i = 0; i <= steps; ++i) {
    const float y_mm =
        from_y_mm + (to_y_mm - from_y_mm) * static_cast<float>(i) / static_cast<float>(steps);
    const float widening = (kTopRadius_mm - kBottomRadius_mm) * y_mm / kHeight_mm;
    surface.add_row(ring(kBottomRadius_mm + widening - inset_mm, y_mm, around));
  }
}

void add_cup(SurfaceBuilder& surface, std::uint32_t around, std::uint32_t steps) {
  surface.lift();
  surface.add_row({{0, 0, 0}});
  add_wall(surface, 0, 0, kHeight_mm, around, steps);
  add_wall(surface, kWall_mm, kHeight_mm, kWall_mm, around, steps);
  surface.add_row({{0, kWall_mm, 0}});
}

/// Half a ring beside the wall, open where it enters the wall.
void add_handle(SurfaceBuilder& surface, std::uint32_t along, std::uint32_t around) {
  constexpr float kBow_mm = 38, kThickness_mm = 6;
  const Eigen::Vector3f middle(52, 72, 0);
  surface.lift();
  for (std::uint32_t i = 0; i <= along; ++i) {
    const auto bow = static_cast<float>(std::numbers::pi * (static_cast<double>(i) / along - 0.5));
    const Eigen::Vector3f outward(std::cos(bow), std::sin(bow), 0);
    std::vector<Eigen::Vector3f> row = ring(kThickness_mm, 0, around);
    for (Eigen::Vector3f& point : row) {
      point = (middle + outward * (kBow_mm + point.x()) + Eigen::Vector3f(0, 0, point.z())).eval();
    }
    surface.add_row(row);
  }
}

}  // namespace

std::shared_ptr<const TriangleMesh> make_bench_cup(std::uint32_t detail) {
  SurfaceBuilder surface;
  add_cup(surface, 9 * detail, 2 * detail);
  add_handle(surface, 4 * detail, 2 * detail);
  return surface.finish();
}

Pose bench_start_pose(const TriangleMesh& mesh, const CameraModel& camera) {
  constexpr double kCloser = 0.6;
  Pose pose = default_start_pose(mesh, camera);
  const Eigen::Vector3d center_mm = pose * mesh.center_mm().cast<double>();
  pose.translation_mm -= (1 - kCloser) * center_mm;
  return pose;
}

std::vector<Pose> make_bench_poses(const TriangleMesh& mesh, const CameraModel& camera,
                                   std::uint64_t seed, std::size_t count) {
  const SimulationOptions motion;
  const double sigma_rad = motion.sigma_deg * std::numbers::pi / 180;
  const Pose middle = bench_start_pose(mesh, camera);
  std::vector<Pose> poses(count);
  for (std::uint32_t i = 0; i < poses.size(); ++i) {
    const RandomKey key{seed, 0, 0, i};
    const auto a = random_normals(key, 0), b = random_normals(key, 1), c = random_normals(key, 2);
    poses[i].rotation =
        rotation_from_vector(sigma_rad * Eigen::Vector3d(a[0], a[1], b[0])) * middle.rotation;
    poses[i].translation_mm =
        middle.translation_mm + motion.sigma_mm * Eigen::Vector3d(b[1], c[0], c[1]);
  }
  return poses;
}

BenchFrames make_bench_frames(std::shared_ptr<const TriangleMesh> mesh, const CameraModel& camera,
                              std::uint64_t seed, int count) {
  SimulationOptions options;
  options.frames = count;
  options.seed = seed;
  options.start = bench_start_pose(*mesh, camera);
  options.background = "clutter";
  options.noise = 2;
  options.supersampling = 2;
  SimulationSource source(std::move(mesh), camera, options, textured_renderers());
  BenchFrames made;
  while (std::optional<Frame> frame = source.next()) {
    made.frames.push_back(std::move(*frame));
    made.camera_from_object.push_back(*source.ground_truth());
  }
  return made;
}

}  // namespace anneal6d
