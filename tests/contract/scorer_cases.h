// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "anneal6d/framework/pose_scorer.h"
#include "shapes.h"

namespace anneal6d::test {

/// Every scorer of the project.
ScorerTable all_scorers();

CameraModel vga_camera();

struct Model {
  std::string name;
  SharedMesh mesh;
};

/// Carried models and built ones: closed and open, smooth and flat, textured, with coloured
/// vertices.
const std::vector<Model>& models();

struct EdgeCase {
  std::string name;
  EdgeOptions edges;

  friend std::ostream& operator<<(std::ostream& stream, const EdgeCase& edge_case) {
    return stream << edge_case.name;
  }
};

const std::vector<EdgeCase>& edge_cases();

/// Where the object is seen from.
enum class Placement {
  inside,  ///< wholly in the image, 80 to 300 pixels large
  border,  ///< anywhere in or partly outside the image
  near,    ///< around the camera: some triangles cross the near plane, some are behind it
  behind,  ///< wholly behind the camera
};

/// `count` poses, always the same.
std::vector<Pose> random_poses(const TriangleMesh& mesh, const CameraModel& camera,
                               Placement placement, std::uint32_t count);

/// Edges of a cluttered image, about a third of the pixels.
EdgeImage cluttered_edges(const CameraModel& camera);

/// An edge image of one value.
EdgeImage uniform_edges(const CameraModel& camera, int value);

std::vector<EdgeMatch> scores(PoseScorer& scorer, std::span<const Pose> poses);

}  // namespace anneal6d::test
