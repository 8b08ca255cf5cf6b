// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "obj_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"
#include "mtl_file.h"
#include "polygon.h"
#include "statements.h"
#include "text_tokens.h"
#include "texture_file.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

// Statements that say nothing about the surface.
constexpr std::array<std::string_view, 16> kIgnored = {
    "o",     "g",        "s",        "l",          "p",         "vp",     "mg",     "lod",
    "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "maplib", "usemap", "end"};

class ObjReader {
 public:
  explicit ObjReader(const fs::path& path) : path_(path) {}

  MeshData read(std::string_view content);

 private:
  struct Point {
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    std::optional<Eigen::Vector3f> color_bgr;
  };
  // Indices of point, texture coordinate (or -1) and normal (or -1).
  using Corner = std::array<std::int64_t, 3>;

  void read_point(const Statements& line);
  void read_texture_coordinate(const Statements& line);
  void read_normal(const Statements& line);
  void read_face(const Statements& line);
  void use_material(const Statements& line);
  Corner parse_corner(const Statements& line, std::string_view text) const;
  std::uint32_t vertex_of(const Corner& corner);

  const fs::path& path_;
  std::vector<Point> points_;
  std::vector<Eigen::Vector2f> texture_coordinates_;
  std::vector<Eigen::Vector3f> normals_;
  std::map<std::string, Material, std::less<>> known_materials_;
  bool has_library_ = false;
  const Material no_material_;
  const Material* material_ = &no_material_;  // of the faces that follow
  SoleTexture texture_;
  std::map<std::pair<Corner, const Material*>, std::uint32_t> vertices_;
  MeshData mesh_;
};

MeshData ObjReader::read(std::string_view content) {
  for (Statements line(path_, content); line.next();) {
    const std::string_view keyword = line.keyword();
    if (keyword == "v") {
      read_point(line);
    } else if (keyword == "vt") {
      read_texture_coordinate(line);
    } else if (keyword == "vn") {
      read_normal(line);
    } else if (keyword == "f") {
      read_face(line);
    } else if (keyword == "usemtl") {
      use_material(line);
    } else if (keyword == "mtllib") {
      const std::string name(line.text_from(0));
      if (name.empty()) line.fail("mtllib names no file");
      known_materials_.merge(load_mtl(path_.parent_path() / name));
      has_library_ = true;
    } else if (std::find(kIgnored.begin(), kIgnored.end(), keyword) == kIgnored.end()) {
      line.fail(excerpt(keyword) + " is no statement of a polygon model in OBJ");
    }
  }
  if (!texture_.path().empty()) mesh_.texture_bgr = load_texture(texture_.path());
  return std::move(mesh_);
}

void ObjReader::read_point(const Statements& line) {
  const std::size_t count = line.argument_count();
  if (count != 3 && count != 4 && count != 6) line.fail("a point should have 3 or 6 numbers");
  if (points_.size() >= 3 * kMaxTriangles) line.fail("the model has too many points; simplify it");
  Point& point = points_.emplace_back();
  point.position = Eigen::Vector3d(line.number(0), line.number(1), line.number(2)).cast<float>();
  if (count == 4 && line.number(3) != 1) line.fail("a weight other than 1 is not supported");
  if (count == 6) {
    point.color_bgr = Eigen::Vector3d(line.number(5), line.number(4), line.number(3)).cast<float>();
  }
}

void ObjReader::read_texture_coordinate(const Statements& line) {
  const double v = line.argument_count() > 1 ? line.number(1) : 0;
  texture_coordinates_.push_back(Eigen::Vector2d(line.number(0), 1 - v).cast<float>());
}

void ObjReader::read_normal(const Statements& line) {
  normals_.push_back(
      usable_normal(Eigen::Vector3d(line.number(0), line.number(1), line.number(2)).cast<float>()));
}

void ObjReader::use_material(const Statements& line) {
  const std::string_view name = line.text_from(0);
  const auto found = known_materials_.find(name);
  if (found != known_materials_.end()) {
    material_ = &found->second;
  } else if (has_library_) {
    line.fail("the material " + excerpt(name) + " is in no file named by mtllib");
  }  // else names without a library: they say nothing
}

/// "7", "7/3", "7//5" or "7/3/5", counted from 1, or backwards from the end by negative numbers.
ObjReader::Corner ObjReader::parse_corner(const Statements& line, std::string_view text) const {
  const std::array<std::size_t, 3> sizes = {points_.size(), texture_coordinates_.size(),
                                            normals_.size()};
  Corner corner = {-1, -1, -1};
  std::string_view rest = text;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string_view part = rest.substr(0, slash);
    const auto size = static_cast<std::int64_t>(sizes[i]);
    if (!part.empty() || i == 0) {
      const auto number = parse_integer(part);
      if (!number || *number == 0 || *number > size || *number < -size) {
        line.fail("the corner " + excerpt(text) + " names nothing that is given above it");
      }
      corner[i] = *number > 0 ? *number - 1 : size + *number;
    }
    if (slash == rest.size()) return corner;
    rest.remove_prefix(slash + 1);
  }
  line.fail(excerpt(text) + " should be a corner: point/texture coordinate/normal");
}

void ObjReader::read_face(const Statements& line) {
  const std::size_t count = line.argument_count();
  if (count < 3 || count > kMaxCorners) {
    line.fail("a face has " + std::to_string(count) + " corners; 3 to 512 are accepted");
  }
  if (mesh_.triangles.size() + count > kMaxTriangles) {
    line.fail("the model has too many triangles; simplify it");
  }
  const fs::path& texture = material_->texture;
  texture_.add(texture, path_, line.place());
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < count; ++i) {
    const Corner corner = parse_corner(line, line.argument(i));
    if (!texture.empty() && corner[1] < 0) line.fail("a textured face has no texture coordinates");
    corners.push_back(vertex_of(corner));
  }
  for (const Triangle& t : triangulate_face(corners, mesh_.vertices)) mesh_.triangles.push_back(t);
}

std::uint32_t ObjReader::vertex_of(const Corner& corner) {
  const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
  const auto [entry, is_new] = vertices_.try_emplace({corner, material_}, next);
  if (!is_new) return entry->second;
  const auto at = [](const auto& list, std::int64_t i) {
    return list[static_cast<std::size_t>(i)];
  };
  const Point point = at(points_, corner[0]);
  MeshVertex& vertex = mesh_.vertices.emplace_back();
  vertex.position_mm = point.position;
  if (corner[1] >= 0) vertex.uv = at(texture_coordinates_, corner[1]);
  if (corner[2] >= 0) vertex.normal = at(normals_, corner[2]);
  vertex.albedo_bgr = material_->albedo_bgr();
  if (point.color_bgr) {
    const bool has_material = material_->diffuse_bgr || !material_->texture.empty();
    vertex.albedo_bgr =
        has_material ? vertex.albedo_bgr.cwiseProduct(*point.color_bgr).eval() : *point.color_bgr;
  }
  return next;
}

}  // namespace

MeshData load_obj(const fs::path& path) {
  const std::string content = read_file(path);
  return ObjReader(path).read(content);
}

}  // namespace anneal6d
