// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "gltf_file.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/srgb.h"
#include "base64.h"
#include "gltf_document.h"
#include "texture_file.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;
using Part = GltfDocument::Part;
using Json = GltfDocument::Json;

// Modes of primitives; the ones before are points and lines, between the two are strips.
constexpr std::size_t kTriangles = 4, kTriangleFan = 6;

/// How a material colours the surface.
struct Paint {
  Eigen::Vector3f light_bgr = Eigen::Vector3f::Ones();  ///< linear: not yet encoded
  std::optional<std::size_t> image;
  std::size_t uv_channel = 0;
};

class GltfReader {
 public:
  GltfReader(const fs::path& path, std::string_view content, bool is_binary)
      : file_(path, content, is_binary) {}

  MeshData read();

 private:
  void add_mesh(std::size_t index, const Eigen::Affine3d& object_from_mesh);
  void add_primitive(const Part& primitive, const Eigen::Affine3d& object_from_mesh);
  void add_vertices(const Part& primitive, const Eigen::Affine3d& object_from_mesh,
                    const Paint& paint);
  void add_triangles(const Part& primitive, std::size_t mode, std::size_t first, std::size_t count);
  Paint read_paint(const Part& primitive) const;
  Eigen::Affine3d transform_of(const Part& node) const;
  std::optional<GltfDocument::Numbers> read_attribute(const Part& primitive,
                                                      const std::string& name, std::size_t count);
  cv::Mat read_image(std::size_t index);

  GltfDocument file_;
  MeshData mesh_;
  SoleTexture texture_;
  std::optional<std::size_t> image_;
};

MeshData GltfReader::read() {
  const Part scene = file_.part("scenes", file_.index(file_.root(), "scene").value_or(0));
  using Placed = std::pair<std::size_t, Eigen::Affine3d>;
  std::vector<Placed> nodes;
  const auto push = [&](const Part& owner, const char* key, const Eigen::Affine3d& place) {
    for (const std::size_t node : file_.indices(owner, key)) nodes.emplace_back(node, place);
  };
  push(scene, "nodes", Eigen::Affine3d::Identity());
  for (std::size_t visited = 0; !nodes.empty(); ++visited) {
    const auto [index, object_from_parent] = nodes.back();
    nodes.pop_back();
    // Every node has one parent: more visits than nodes mean a circle.
    if (visited >= file_.size_of("nodes")) file_.fail("nodes", "contain each other, or themselves");
    const Part node = file_.part("nodes", index);
    const Eigen::Affine3d object_from_node = object_from_parent * transform_of(node);
    if (const auto mesh = file_.index(node, "mesh")) add_mesh(*mesh, object_from_node);
    push(node, "children", object_from_node);
  }
  if (image_) mesh_.texture_bgr = read_image(*image_);
  return std::move(mesh_);
}

Eigen::Affine3d GltfReader::transform_of(const Part& node) const {
  const std::vector<double> matrix = file_.numbers(node, "matrix", 16);
  if (!matrix.empty()) return Eigen::Affine3d(Eigen::Map<const Eigen::Matrix4d>(matrix.data()));
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (const auto t = file_.numbers(node, "translation", 3); !t.empty()) {
    transform.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  }
  if (const auto r = file_.numbers(node, "rotation", 4); !r.empty()) {
    transform.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
  }
  if (const auto s = file_.numbers(node, "scale", 3); !s.empty()) {
    transform.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  }
  return transform;
}

void GltfReader::add_mesh(std::size_t index, const Eigen::Affine3d& object_from_mesh) {
  const Part mesh = file_.part("meshes", index);
  const Json& primitives = file_.child(mesh, "primitives");
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    add_primitive({primitives[i], mesh.name + ".primitives[" + std::to_string(i) + "]"},
                  object_from_mesh);
  }
}

void GltfReader::add_primitive(const Part& primitive, const Eigen::Affine3d& object_from_mesh) {
  const std::size_t mode = file_.index(primitive, "mode").value_or(kTriangles);
  if (mode > kTriangleFan) file_.fail(primitive.name, "'mode' is unknown");
  if (mode < kTriangles) return;  // points and lines

  const Paint paint = read_paint(primitive);
  const std::string texture = paint.image ? "image " + std::to_string(*paint.image) : "";
  texture_.add(texture, file_.path(), primitive.name);
  image_ = paint.image;
  const std::size_t first = mesh_.vertices.size();
  add_vertices(primitive, object_from_mesh, paint);
  add_triangles(primitive, mode, first, mesh_.vertices.size() - first);
}

Paint GltfReader::read_paint(const Part& primitive) const {
  Paint paint;
  const auto material_index = file_.index(primitive, "material");
  if (!material_index) return paint;
  const Part material = file_.part("materials", *material_index);
  const Json& surface = file_.child(material, "pbrMetallicRoughness");
  if (surface.is_null()) return paint;
  const Part pbr{surface, material.name};
  if (const auto factor = file_.numbers(pbr, "baseColorFactor", 4); !factor.empty()) {
    paint.light_bgr = Eigen::Vector3d(factor[2], factor[1], factor[0]).cast<float>();
  }
  const Json& reference = file_.child(pbr, "baseColorTexture");
  if (reference.is_null()) return paint;
  const Part use{reference, material.name + ".baseColorTexture"};
  if (!file_.child(use, "extensions").empty()) {
    file_.fail(use.name, "moves or scales the texture; bake that into the texture coordinates");
  }
  const Part texture = file_.part("textures", file_.needed_index(use, "index"));
  paint.image = file_.needed_index(texture, "source");
  paint.uv_channel = file_.index(use, "texCoord").value_or(0);
  return paint;
}

std::optional<GltfDocument::Numbers> GltfReader::read_attribute(const Part& primitive,
                                                                const std::string& name,
                                                                std::size_t count) {
  const Part attributes{file_.child(primitive, "attributes"), primitive.name + ".attributes"};
  if (attributes.json.is_null()) file_.fail(primitive.name, "'attributes' is missing");
  const auto accessor = file_.index(attributes, name);
  if (!accessor) return std::nullopt;
  GltfDocument::Numbers numbers = file_.read_accessor(*accessor);
  const std::size_t width = name.starts_with("TEXCOORD") ? 2 : 3;  // a colour may have a fourth
  const bool fits = numbers.width == width || (name == "COLOR_0" && numbers.width == 4);
  if (!fits || (count > 0 && numbers.count() != count)) {
    file_.fail(attributes.name,
               name + " should have " + std::to_string(width) + " numbers for each vertex");
  }
  return numbers;
}

void GltfReader::add_vertices(const Part& primitive, const Eigen::Affine3d& object_from_mesh,
                              const Paint& paint) {
  const auto positions = read_attribute(primitive, "POSITION", 0);
  if (!positions) file_.fail(primitive.name, "has no POSITION");
  const std::size_t count = positions->count();
  const auto normals = read_attribute(primitive, "NORMAL", count);
  const auto colors = read_attribute(primitive, "COLOR_0", count);
  const auto uvs = read_attribute(primitive, "TEXCOORD_" + std::to_string(paint.uv_channel), count);
  if (paint.image && !uvs) file_.fail(primitive.name, "is textured but has no TEXCOORD");
  // A scene may place one mesh many times.
  if (mesh_.vertices.size() + count > 3 * kMaxTriangles) {
    file_.fail(primitive.name, "the model has too many vertices; simplify it");
  }

  const Eigen::Matrix3d linear = object_from_mesh.linear();
  Eigen::Matrix3f normal_matrix = Eigen::Matrix3f::Zero();
  if (linear.determinant() != 0) normal_matrix = linear.inverse().transpose().cast<float>();
  const auto vector = [](const GltfDocument::Numbers& numbers, std::size_t i) {
    return Eigen::Vector3f(numbers.values.data() + i * numbers.width);
  };
  for (std::size_t i = 0; i < count; ++i) {
    MeshVertex& vertex = mesh_.vertices.emplace_back();
    vertex.position_mm = (object_from_mesh * vector(*positions, i).cast<double>()).cast<float>();
    if (normals) vertex.normal = usable_normal(normal_matrix * vector(*normals, i));
    if (uvs) vertex.uv = {uvs->values[2 * i], uvs->values[2 * i + 1]};
    Eigen::Vector3f light_bgr = paint.light_bgr;
    if (colors) light_bgr = light_bgr.cwiseProduct(vector(*colors, i).reverse());
    vertex.albedo_bgr = light_bgr.cast<double>().unaryExpr(&encoded_srgb).cast<float>();
  }
}

void GltfReader::add_triangles(const Part& primitive, std::size_t mode, std::size_t first,
                               std::size_t count) {
  std::vector<std::uint32_t> corners;
  if (const auto accessor = file_.index(primitive, "indices")) {
    const GltfDocument::Numbers numbers = file_.read_accessor(*accessor);
    for (const float number : numbers.values) {
      // Floats hold every whole number up to the largest accepted count.
      if (!(number >= 0 && number < static_cast<float>(count)) || number != std::floor(number)) {
        file_.fail(primitive.name, "an index names a vertex that does not exist");
      }
      corners.push_back(static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(number));
    }
  } else {
    corners.resize(count);
    std::iota(corners.begin(), corners.end(), static_cast<std::uint32_t>(first));
  }
  if (mode == kTriangles && corners.size() % 3 != 0) {
    file_.fail(primitive.name, "the number of its corners should be a multiple of three");
  }
  const std::size_t step = mode == kTriangles ? 3 : 1;
  if (mesh_.triangles.size() + corners.size() / step > kMaxTriangles) {
    file_.fail(primitive.name, "the model has too many triangles; simplify it");
  }
  for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
    mesh_.triangles.push_back(
        {corners[mode == kTriangleFan ? 0 : i], corners[i + 1], corners[i + 2]});
  }
}

cv::Mat GltfReader::read_image(std::size_t index) {
  const Part image = file_.part("images", index);
  const auto decode = [&](std::string_view bytes) {
    return decode_texture({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()},
                          file_.path(), image.name);
  };
  if (const auto view = file_.index(image, "bufferView")) return decode(file_.read_view(*view));
  const auto uri = image.json.find("uri");
  if (uri == image.json.end() || !uri->is_string()) {
    file_.fail(image.name, "has neither a 'bufferView' nor a 'uri'");
  }
  const std::string text = *uri;
  if (!text.starts_with("data:")) return load_texture(file_.resolve(text));
  const auto bytes = decode_data_uri(text);
  if (!bytes) file_.fail(image.name, "'uri' is no sound base64");
  return decode(*bytes);
}

}  // namespace

MeshData load_gltf(const fs::path& path, bool is_binary) {
  constexpr std::size_t kMaxFileSize = std::size_t{1} << 30;
  const std::string content = read_file(path, kMaxFileSize);
  return GltfReader(path, content, is_binary).read();
}

}  // namespace anneal6d
