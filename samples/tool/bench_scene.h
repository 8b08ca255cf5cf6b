// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/frame.h"
#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// How finely `make_bench_cup` divides the cup of all measurements: 1,552 triangles, about as many
/// as the thesis's measuring cup has (1,493, Table 6.3).
inline constexpr std::uint32_t kBenchCupDetail = 4;

/// A cup with wall, bottom and handle, 140 mm tall, of 88 d^2 + 36 d triangles for the detail d
/// (1 or more). It looks the same for all but the coarsest.
std::shared_ptr<const TriangleMesh> make_bench_cup(std::uint32_t detail);

/// Where all measurements have the cup, or start: seen obliquely from above, about 200 px wide and
/// high.
Pose bench_start_pose(const TriangleMesh& mesh, const CameraModel& camera);

/// `count` poses as a layer of the filter has them, within some millimetres and degrees of the
/// start.
std::vector<Pose> make_bench_poses(const TriangleMesh& mesh, const CameraModel& camera,
                                   std::uint64_t seed, std::size_t count);

/// The cup on its way, 5 mm and 2 degrees a frame, before clutter and with a camera's noise.
struct BenchFrames {
  std::vector<Frame> frames;
  std::vector<Pose> camera_from_object;  ///< the true pose in each
};

/// Simulates `count` frames. Throws BackendUnavailable: it is drawn with OpenGL.
BenchFrames make_bench_frames(std::shared_ptr<const TriangleMesh> mesh, const CameraModel& camera,
                              std::uint64_t seed, int count);

}  // namespace anneal6d
