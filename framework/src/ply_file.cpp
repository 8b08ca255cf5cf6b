// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "ply_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "ply_values.h"
#include "polygon.h"
#include "texture_file.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

class PlyReader {
 public:
  PlyReader(const fs::path& path, std::string_view content) : path_(path), values_(path, content) {}

  MeshData read();

 private:
  void read_vertices(const PlyElement& element);
  void read_faces(const PlyElement& element);
  void skip(const PlyElement& element);
  void add_face(const std::vector<double>& corners, const std::vector<double>& uvs);
  void take_list(const PlyProperty& property, std::vector<double>& items);

  const fs::path& path_;
  PlyValues values_;
  MeshData mesh_;
  std::size_t vertex_count_ = 0;  // that the file gives; faces may add some
  bool has_uv_ = false;
};

/// What a property of a vertex is for.
enum Channel {
  at_x,
  at_y,
  at_z,
  at_nx,
  at_ny,
  at_nz,
  at_u,
  at_v,
  at_red,
  at_green,
  at_blue,
  channel_count
};

std::optional<Channel> channel_of(const PlyProperty& property) {
  constexpr std::array<std::pair<std::string_view, Channel>, 18> kNames = {
      {{"x", at_x},
       {"y", at_y},
       {"z", at_z},
       {"nx", at_nx},
       {"ny", at_ny},
       {"nz", at_nz},
       {"s", at_u},
       {"u", at_u},
       {"texture_u", at_u},
       {"t", at_v},
       {"v", at_v},
       {"texture_v", at_v},
       {"red", at_red},
       {"diffuse_red", at_red},
       {"green", at_green},
       {"diffuse_green", at_green},
       {"blue", at_blue},
       {"diffuse_blue", at_blue}}};
  const auto found = std::find_if(kNames.begin(), kNames.end(),
                                  [&](const auto& row) { return row.first == property.name; });
  if (found == kNames.end() || property.length_type) return std::nullopt;
  return found->second;
}

MeshData PlyReader::read() {
  for (const PlyElement& element : values_.elements()) {
    if (element.name == "vertex" && mesh_.vertices.empty()) {
      read_vertices(element);
    } else if (element.name == "face" && !mesh_.vertices.empty()) {
      read_faces(element);
    } else {
      skip(element);
    }
  }
  values_.expect_end();
  if (!values_.texture().empty()) {
    if (!has_uv_) {
      throw FileError(path_, "header", "names a texture but no texture coordinates");
    }
    mesh_.texture_bgr = load_texture(path_.parent_path() / values_.texture());
  }
  return std::move(mesh_);
}

void PlyReader::read_vertices(const PlyElement& element) {
  std::array<double, channel_count> values{};
  std::array<bool, channel_count> is_given{};
  // Without a colour of its own a textured model shows its texture's.
  const float plain = values_.texture().empty() ? MeshVertex{}.albedo_bgr.x() : 1.0F;
  for (const Channel channel : {at_red, at_green, at_blue}) values[channel] = plain;
  for (const PlyProperty& property : element.properties) {
    if (const auto channel = channel_of(property)) is_given[*channel] = true;
  }
  if (!is_given[at_x] || !is_given[at_y] || !is_given[at_z]) {
    throw FileError(path_, "header", "a vertex should have x, y and z");
  }
  has_uv_ = is_given[at_u] && is_given[at_v];

  std::vector<double> unused;
  for (std::size_t i = 0; i < element.count; ++i) {
    if (i >= 3 * kMaxTriangles) values_.fail("the model has too many vertices; simplify it");
    for (const PlyProperty& property : element.properties) {
      const auto channel = channel_of(property);
      if (property.length_type) {
        take_list(property, unused);
      } else if (const double value = values_.take(property.type); channel) {
        const bool is_part_of_white = *channel >= at_red && is_whole(property.type);
        values[*channel] = is_part_of_white ? value / largest_of(property.type) : value;
      }
    }
    const auto vector = [&](Channel a, Channel b, Channel c) {
      return Eigen::Vector3d(values[a], values[b], values[c]).cast<float>().eval();
    };
    MeshVertex& vertex = mesh_.vertices.emplace_back();
    vertex.position_mm = vector(at_x, at_y, at_z);
    vertex.normal = usable_normal(vector(at_nx, at_ny, at_nz));
    vertex.uv = Eigen::Vector2d(values[at_u], 1 - values[at_v]).cast<float>();
    vertex.albedo_bgr = vector(at_blue, at_green, at_red);
  }
  vertex_count_ = mesh_.vertices.size();
}

void PlyReader::read_faces(const PlyElement& element) {
  const auto is_corners = [](const PlyProperty& property) {
    return property.length_type && is_whole(property.type) &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  };
  const auto count =
      std::count_if(element.properties.begin(), element.properties.end(), is_corners);
  if (count != 1) throw FileError(path_, "header", "a face should have one list vertex_indices");
  std::vector<double> corners, uvs, unused;
  for (std::size_t i = 0; i < element.count; ++i) {
    uvs.clear();
    for (const PlyProperty& property : element.properties) {
      if (is_corners(property)) {
        take_list(property, corners);
      } else if (property.length_type) {
        take_list(property, property.name == "texcoord" ? uvs : unused);
      } else if (values_.take(property.type) != 0 && property.name == "texnumber") {
        values_.fail("the model has several textures; bake them into one");
      }
    }
    add_face(corners, uvs);
  }
}

void PlyReader::skip(const PlyElement& element) {
  if (element.properties.empty()) return;  // else the count alone could keep us busy
  std::vector<double> unused;
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      if (property.length_type) {
        take_list(property, unused);
      } else {
        values_.take(property.type);
      }
    }
  }
}

void PlyReader::take_list(const PlyProperty& property, std::vector<double>& items) {
  const double length = values_.take(*property.length_type);
  if (length < 0) values_.fail("a list has a negative length");
  items.clear();
  while (static_cast<double>(items.size()) < length) items.push_back(values_.take(property.type));
}

void PlyReader::add_face(const std::vector<double>& corners, const std::vector<double>& uvs) {
  if (corners.size() < 3 || corners.size() > kMaxCorners) {
    values_.fail("a face has " + std::to_string(corners.size()) +
                 " corners; 3 to 512 are accepted");
  }
  if (!uvs.empty() && uvs.size() != 2 * corners.size()) {
    values_.fail("a face should have two texture coordinates for each corner");
  }
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!(corners[i] >= 0 && corners[i] < static_cast<double>(vertex_count_))) {
      values_.fail("a face names a vertex that does not exist");
    }
    indices.push_back(static_cast<std::uint32_t>(corners[i]));
    if (uvs.empty()) continue;
    // Coordinates of this corner alone make it a vertex of its own.
    MeshVertex vertex = mesh_.vertices[indices.back()];
    vertex.uv = {static_cast<float>(uvs[2 * i]), static_cast<float>(1 - uvs[2 * i + 1])};
    indices.back() = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(vertex);
    has_uv_ = true;
  }
  if (mesh_.triangles.size() + indices.size() > kMaxTriangles) {
    values_.fail("the model has too many triangles; simplify it");
  }
  for (const Triangle& t : triangulate_face(indices, mesh_.vertices)) mesh_.triangles.push_back(t);
}

}  // namespace

MeshData load_ply(const fs::path& path) {
  const std::string content = read_file(path);
  return PlyReader(path, content).read();
}

}  // namespace anneal6d
