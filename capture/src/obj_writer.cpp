// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "obj_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "image_file.h"

namespace anneal6d {
namespace {

// A line of numbers, shortest form that reads back exactly, independent of the locale.
void append(std::string& text, std::string_view keyword, std::initializer_list<float> numbers) {
  text += keyword;
  for (const float number : numbers) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
    text += ' ';
    text.append(buffer, end);
  }
  text += '\n';
}

bool has_one_color(const TriangleMesh& mesh, const Triangle& triangle) {
  const auto vertices = mesh.vertices();
  const Eigen::Vector3f& color = vertices[triangle[0]].albedo_bgr;
  return vertices[triangle[1]].albedo_bgr == color && vertices[triangle[2]].albedo_bgr == color;
}

std::string material_name(std::size_t index) { return "material" + std::to_string(index); }

// The materials' colours, and for each triangle the index of its own.
struct Materials {
  std::vector<Eigen::Vector3f> colors_bgr;
  std::vector<std::size_t> of_triangle;
};

Materials collect_materials(const TriangleMesh& mesh) {
  Materials materials;
  std::map<std::array<float, 3>, std::size_t> numbers;
  for (const Triangle& triangle : mesh.triangles()) {
    const Eigen::Vector3f& color = mesh.vertices()[triangle[0]].albedo_bgr;
    const auto [known, is_new] =
        numbers.try_emplace({color[0], color[1], color[2]}, materials.colors_bgr.size());
    materials.of_triangle.push_back(known->second);
    if (is_new) materials.colors_bgr.push_back(color);
  }
  return materials;
}

// Readers, ours among them, take black beside a texture for "the texture alone counts".
Eigen::Vector3f beside_texture(const Eigen::Vector3f& color) {
  constexpr float kNearlyBlack = 1e-6F;
  return color.isZero() ? Eigen::Vector3f::Constant(kNearlyBlack) : color;
}

// The lines of one keyword, each once: corners that the mesh keeps apart share them in the file.
class Lines {
 public:
  explicit Lines(std::string_view keyword) : keyword_(keyword) {}

  // The line's number, as faces refer to it.
  std::string number_of(std::initializer_list<float> values) {
    std::string line;
    append(line, keyword_, values);
    const auto [known, is_new] = numbers_.try_emplace(std::move(line), numbers_.size() + 1);
    if (is_new) text_ += known->first;
    return std::to_string(known->second);
  }
  const std::string& text() const { return text_; }

 private:
  std::string_view keyword_;
  std::unordered_map<std::string, std::size_t> numbers_;
  std::string text_;
};

// Vertices, texture coordinates and normals, and how a face refers to each of the mesh's vertices.
class Corners {
 public:
  Corners(const TriangleMesh& mesh, bool with_color) {
    for (const MeshVertex& vertex : mesh.vertices()) {
      const Eigen::Vector3f& p = vertex.position_mm;
      const Eigen::Vector3f& c = vertex.albedo_bgr;
      std::string reference = with_color
                                  ? positions_.number_of({p.x(), p.y(), p.z(), c.z(), c.y(), c.x()})
                                  : positions_.number_of({p.x(), p.y(), p.z()});
      reference += '/';
      // The format has v = 0 at the bottom of the texture, the mesh at its top.
      if (mesh.has_texture()) reference += uvs_.number_of({vertex.uv.x(), 1 - vertex.uv.y()});
      const Eigen::Vector3f& n = vertex.normal;
      reference += '/' + normals_.number_of({n.x(), n.y(), n.z()});
      references_.push_back(std::move(reference));
    }
  }

  std::string text() const { return positions_.text() + uvs_.text() + normals_.text(); }
  const std::string& reference(std::uint32_t vertex) const { return references_[vertex]; }

 private:
  Lines positions_{"v"}, uvs_{"vt"}, normals_{"vn"};
  std::vector<std::string> references_;
};

}  // namespace

void write_obj(const TriangleMesh& mesh, const std::filesystem::path& path) {
  const std::filesystem::path material_path = std::filesystem::path(path).replace_extension("mtl");
  const std::filesystem::path texture_path = std::filesystem::path(path).replace_extension("png");
  const bool colored_vertices =
      !std::all_of(mesh.triangles().begin(), mesh.triangles().end(),
                   [&mesh](const Triangle& triangle) { return has_one_color(mesh, triangle); });
  Materials materials;
  if (colored_vertices) {
    materials = {{Eigen::Vector3f::Ones()}, std::vector<std::size_t>(mesh.triangles().size(), 0)};
  } else {
    materials = collect_materials(mesh);
  }

  std::string text = "# millimetres\nmtllib " + material_path.filename().string() + '\n';
  const Corners corners(mesh, colored_vertices);
  text += corners.text();
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    if (i == 0 || materials.of_triangle[i] != materials.of_triangle[i - 1]) {
      text += "usemtl " + material_name(materials.of_triangle[i]) + '\n';
    }
    text += 'f';
    for (const std::uint32_t vertex : mesh.triangles()[i]) text += ' ' + corners.reference(vertex);
    text += '\n';
  }

  std::string material_text;
  for (std::size_t i = 0; i < materials.colors_bgr.size(); ++i) {
    const Eigen::Vector3f color =
        mesh.has_texture() ? beside_texture(materials.colors_bgr[i]) : materials.colors_bgr[i];
    material_text += "newmtl " + material_name(i) + '\n';
    append(material_text, "Kd", {color.z(), color.y(), color.x()});
    if (mesh.has_texture()) material_text += "map_Kd " + texture_path.filename().string() + '\n';
  }

  if (mesh.has_texture()) {
    write_image(texture_path, mesh.texture_levels().front());
  }
  write_file_atomically(material_path, material_text);
  write_file_atomically(path, text);
}

}  // namespace anneal6d
