// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace anneal6d {

/// What an MTL file says about one material that matters here.
struct Material {
  std::optional<Eigen::Vector3f> diffuse_bgr;  ///< Kd
  std::filesystem::path texture;               ///< map_Kd, with the MTL file's folder; empty: none

  /// Colour of a surface whose vertices have no colour of their own.
  Eigen::Vector3f albedo_bgr() const;
};

/// Reads an MTL file: materials by name. Throws FileError with the line.
std::map<std::string, Material, std::less<>> load_mtl(const std::filesystem::path& path);

}  // namespace anneal6d
