// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "dat_file.h"

#include <string>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/float_matrix_file.h"
#include "texture_file.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

constexpr Eigen::Index kFloatsPerCorner = 6;
constexpr Eigen::Index kFloatsPerTriangle = 3 * kFloatsPerCorner;

void add_texture(MeshData& mesh, const fs::path& coordinates_path, const fs::path& picture_path) {
  const FloatMatrix coordinates = load_float_matrix(coordinates_path);
  if (coordinates.cols() != 6 ||
      coordinates.rows() != static_cast<Eigen::Index>(mesh.triangles.size())) {
    throw FileError(coordinates_path, "header",
                    "has " + std::to_string(coordinates.rows()) + " rows of " +
                        std::to_string(coordinates.cols()) + " columns; the model's " +
                        std::to_string(mesh.triangles.size()) +
                        " triangles need as many rows of 6 columns (u v, three times)");
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const float* const uv = coordinates.data() + 2 * i;
    mesh.vertices[i].uv = {uv[0], uv[1]};
    mesh.vertices[i].albedo_bgr.setOnes();  // the texture is the colour
  }
  mesh.texture_bgr = load_texture(picture_path);
}

}  // namespace

MeshData load_dat(const fs::path& path) {
  const FloatMatrix matrix = load_float_matrix(path);
  const bool is_row_a_triangle = matrix.cols() == kFloatsPerTriangle;
  const bool is_row_a_corner = matrix.cols() == kFloatsPerCorner && matrix.rows() % 3 == 0;
  if (!is_row_a_triangle && !is_row_a_corner) {
    throw FileError(path, "header",
                    "has " + std::to_string(matrix.rows()) + " rows of " +
                        std::to_string(matrix.cols()) +
                        " columns; a model has 18 columns (normal and point, three times), or 6 "
                        "columns and three rows a triangle");
  }
  const Eigen::Index count = matrix.size() / kFloatsPerTriangle;
  if (count > static_cast<Eigen::Index>(kMaxTriangles)) {
    throw FileError(path, "header", std::to_string(count) + " triangles are too many; simplify it");
  }

  MeshData mesh;
  mesh.vertices.reserve(static_cast<std::size_t>(3 * count));
  mesh.triangles.reserve(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < 3 * count; ++i) {
    const float* const values = matrix.data() + kFloatsPerCorner * i;
    MeshVertex& vertex = mesh.vertices.emplace_back();
    vertex.normal = {values[0], values[1], values[2]};
    vertex.position_mm = {values[3], values[4], values[5]};
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }

  const fs::path stem = path.parent_path() / path.stem();
  fs::path coordinates_path = stem, picture_path = stem;
  coordinates_path += "Tex.dat";
  picture_path += ".bmp";
  std::error_code ignored;
  if (fs::exists(coordinates_path, ignored) || fs::exists(picture_path, ignored)) {
    add_texture(mesh, coordinates_path, picture_path);
  }
  return mesh;
}

}  // namespace anneal6d
