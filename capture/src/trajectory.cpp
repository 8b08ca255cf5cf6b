// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation_random.h"

namespace anneal6d {
namespace {

constexpr double kNearest = 0.7;  // shares of the start's distance
constexpr double kFarthest = 1.4;
constexpr int kShortestReach = 20;  // frames that a hand takes from one place to the next
constexpr int kLongestReach = 40;

struct Step {
  Eigen::Vector3d translation_mm;
  Eigen::Vector3d rotation_rad;
};

// A Gaussian step along and about each axis, `scale` times the options' deviations.
Step draw_step(const SimulationOptions& options, std::uint32_t frame, double scale) {
  const RandomKey key = simulation_key(options.seed, SimulationStream::motion, frame);
  const auto a = random_normals(key, 0);
  const auto b = random_normals(key, 1);
  const auto c = random_normals(key, 2);
  const double sigma_rad = options.sigma_deg * std::numbers::pi / 180;
  return {Eigen::Vector3d(a[0], a[1], b[0]) * (options.sigma_mm * scale),
          Eigen::Vector3d(b[1], c[0], c[1]) * (sigma_rad * scale)};
}

// Translation added, rotation turned about the camera's axes.
Pose moved(const Pose& pose, const Step& step) {
  Pose result;
  result.rotation = (rotation_from_vector(step.rotation_rad) * pose.rotation).normalized();
  result.translation_mm = pose.translation_mm + step.translation_mm;
  return result;
}

// Mirrors, axis by axis, a step that leads the centre out of the volume; `place_after` tells where
// a step leads it.
template <class PlaceAfter>
Step mirrored_into(const VisibleVolume& volume, Step step, const PlaceAfter& place_after) {
  for (const int axis : {2, 0, 1}) {  // depth first, it decides how wide the others are
    const double excess = volume.excess_mm(place_after(step))[axis];
    if (excess * step.translation_mm[axis] > 0) step.translation_mm[axis] *= -1;
  }
  return step;
}

std::vector<Pose> random_walk(const SimulationOptions& options, const Pose& start,
                              const VisibleVolume& volume) {
  std::vector<Pose> poses{start};
  while (static_cast<int>(poses.size()) < options.frames) {
    const Pose& last = poses.back();
    const Step step =
        mirrored_into(volume, draw_step(options, static_cast<std::uint32_t>(poses.size()), 1),
                      [&](const Step& tried) { return moved(last, tried) * volume.center_mm(); });
    poses.push_back(moved(last, step));
  }
  return poses;
}

// Minimum-jerk profile of a reaching hand (Flash and Hogan, "The Coordination of Arm Movements",
// J. Neuroscience 1985): from 0 to 1, at rest at both ends.
double minimum_jerk(double t) { return t * t * t * (10 + t * (-15 + 6 * t)); }

// A hand turns a thing about its middle, wherever the model's origin lies.
std::vector<Pose> manipulation(const SimulationOptions& options, const Pose& start,
                               const VisibleVolume& volume) {
  // The profile's mean square speed is 10/7 (distance / time)^2: this distance, in units of sigma,
  // gives steps of one sigma a frame.
  const double distance_per_frame = std::sqrt(0.7);
  const Pose object_from_center{Eigen::Quaterniond::Identity(), volume.center_mm()};
  const Pose center_from_object = object_from_center.inverse();
  std::vector<Pose> poses{start};
  for (std::uint32_t reach = 0; static_cast<int>(poses.size()) < options.frames; ++reach) {
    const Pose from = poses.back() * object_from_center;
    const RandomKey key = simulation_key(options.seed, SimulationStream::motion, reach, 1);
    const int duration = kShortestReach + static_cast<int>(random_uniform(key, 0) *
                                                           (kLongestReach - kShortestReach + 1));
    const auto place_after = [&](const Step& tried) -> Eigen::Vector3d {
      return from.translation_mm + tried.translation_mm;
    };
    Step step = mirrored_into(volume, draw_step(options, reach, distance_per_frame * duration),
                              place_after);
    // A reach is long: what mirroring leaves outside is cut off, the depth first.
    step.translation_mm.z() -= volume.excess_mm(place_after(step)).z();
    step.translation_mm -= volume.excess_mm(place_after(step));
    for (int i = 1; i <= duration && static_cast<int>(poses.size()) < options.frames; ++i) {
      const double share = minimum_jerk(static_cast<double>(i) / duration);
      poses.push_back(moved(from, {step.translation_mm * share, step.rotation_rad * share}) *
                      center_from_object);
    }
  }
  return poses;
}

}  // namespace

VisibleVolume::VisibleVolume(const TriangleMesh& mesh, const CameraModel& camera, const Pose& start)
    : camera_(camera),
      center_mm_(mesh.center_mm().cast<double>()),
      radius_mm_(mesh.radius_mm()),
      near_mm_(kNearest * (start * center_mm_).z()),
      far_mm_(kFarthest * (start * center_mm_).z()) {}

Eigen::Vector3d VisibleVolume::excess_mm(const Eigen::Vector3d& place_mm) const {
  const double z = std::clamp(place_mm.z(), near_mm_, far_mm_);
  // Pixels from `low` to `high` along one axis, with the sphere's radius to spare, or the middle
  // quarter where that leaves less.
  const auto excess = [&](double value, double f_px, double c_px, int size_px) {
    const double margin = std::min(radius_mm_ * f_px / z, 0.375 * size_px);
    const double low = (margin - c_px) * z / f_px;
    const double high = (size_px - 1 - margin - c_px) * z / f_px;
    return value - std::clamp(value, low, high);
  };
  return {excess(place_mm.x(), camera_.fx_px, camera_.cx_px, camera_.width_px),
          excess(place_mm.y(), camera_.fy_px, camera_.cy_px, camera_.height_px), place_mm.z() - z};
}

std::vector<Pose> simulate_trajectory(const SimulationOptions& options, const Pose& start,
                                      const VisibleVolume& volume) {
  switch (options.motion) {
    case SimulatedMotion::manipulation:
      return manipulation(options, start, volume);
    case SimulatedMotion::random_walk:
      break;
  }
  return random_walk(options, start, volume);
}

Pose pose_at(const std::vector<Pose>& trajectory, double time) {
  const double last = static_cast<double>(trajectory.size() - 1);
  const double clamped = std::clamp(time, 0.0, last);
  const auto before = static_cast<std::size_t>(clamped);
  const std::size_t after = std::min(before + 1, trajectory.size() - 1);
  const double share = clamped - static_cast<double>(before);
  const Pose& a = trajectory[before];
  const Pose& b = trajectory[after];
  Pose pose;
  pose.rotation = a.rotation.slerp(share, b.rotation);
  pose.translation_mm = (1 - share) * a.translation_mm + share * b.translation_mm;
  return pose;
}

}  // namespace anneal6d
