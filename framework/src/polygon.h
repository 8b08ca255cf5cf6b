// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "anneal6d/framework/triangle_mesh.h"

namespace anneal6d {

/// The readers take no face of more corners: cutting takes quadratic time.
inline constexpr std::size_t kMaxCorners = 512;

/// Cuts a flat, possibly concave polygon into triangles of its corners' positions 0, 1, ... by
/// clipping ears. Corners that bend nowhere may be left out. Empty if there is no way: fewer than
/// three corners, no area, or an outline that crosses itself.
std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulate(
    std::span<const Eigen::Vector3d> polygon);

/// Cuts a model's face, given by the indices of its corners. One that is not flat, or whose outline
/// crosses itself, becomes a fan: scanned models have such faces.
std::vector<Triangle> triangulate_face(std::span<const std::uint32_t> corners,
                                       std::span<const MeshVertex> vertices);

}  // namespace anneal6d
