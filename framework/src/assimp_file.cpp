// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "assimp_file.h"

#include <assimp/BaseImporter.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "anneal6d/framework/error.h"
#include "assimp_files.h"
#include "gltf_check.h"
#include "texture_file.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kExtensions = {".obj", ".gltf", ".glb"};

/// glTF gives colours as amounts of light; pictures and the other formats as screen values.
float screen_value(float light) {
  return light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1 / 2.4F) - 0.055F;
}

/// How a material colours the surface.
struct Paint {
  Eigen::Vector3f albedo_bgr = Eigen::Vector3f::Ones();
  std::string texture;  ///< as the file names it; empty: none
  unsigned uv_channel = 0;
};

class SceneReader {
 public:
  SceneReader(const fs::path& path, std::string_view extension, const aiScene& scene)
      : path_(path), extension_(extension), scene_(scene) {}

  MeshData read();

 private:
  Paint read_paint(const aiMesh& mesh) const;
  void add_mesh(const aiMesh& source, const Eigen::Affine3f& object_from_mesh);
  void add_vertices(const aiMesh& source, const Eigen::Affine3f& object_from_mesh,
                    const Paint& paint);
  void use_texture(const aiMesh& source, const Paint& paint);
  cv::Mat read_texture() const;

  bool is_gltf() const { return extension_.starts_with(".gl"); }
  [[noreturn]] void fail(const std::string& what) const { throw FileError(path_, "", what); }

  const fs::path& path_;
  std::string_view extension_;
  const aiScene& scene_;
  MeshData result_;
  std::optional<std::string> texture_;  // of all meshes so far; empty text: without
};

MeshData SceneReader::read() {
  using Placed = std::pair<const aiNode*, Eigen::Affine3f>;
  std::vector<Placed> nodes = {{scene_.mRootNode, Eigen::Affine3f::Identity()}};
  while (!nodes.empty()) {
    const auto [node, object_from_parent] = nodes.back();
    nodes.pop_back();
    using RowMajor = Eigen::Matrix<float, 4, 4, Eigen::RowMajor>;
    const Eigen::Affine3f object_from_node =
        object_from_parent * Eigen::Affine3f(Eigen::Map<const RowMajor>(&node->mTransformation.a1));
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      add_mesh(*scene_.mMeshes[node->mMeshes[i]], object_from_node);
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i) {
      nodes.emplace_back(node->mChildren[i], object_from_node);
    }
  }
  if (texture_ && !texture_->empty()) result_.texture_bgr = read_texture();
  return std::move(result_);
}

Paint SceneReader::read_paint(const aiMesh& mesh) const {
  constexpr float kDefaultAlbedo = 0.8F;
  const aiMaterial& material = *scene_.mMaterials[mesh.mMaterialIndex];
  Paint paint;
  for (const aiTextureType type : {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR}) {
    aiString name;
    if (!paint.texture.empty() || material.GetTextureCount(type) == 0) continue;
    if (material.GetTexture(type, 0, &name, nullptr, &paint.uv_channel) != aiReturn_SUCCESS)
      continue;
    paint.texture = name.C_Str();
    aiUVTransform transform;
    if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS &&
        (transform.mTranslation != aiVector2D(0, 0) || transform.mScaling != aiVector2D(1, 1) ||
         transform.mRotation != 0)) {
      fail("moves, scales or turns its texture; bake that into the texture coordinates");
    }
  }

  const bool is_default = material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME);
  aiColor3D color;
  if (is_default || material.Get(AI_MATKEY_COLOR_DIFFUSE, color) != aiReturn_SUCCESS) {
    const bool is_plain = paint.texture.empty() && !mesh.HasVertexColors(0);
    paint.albedo_bgr.setConstant(is_plain ? kDefaultAlbedo : 1.0F);
  } else if (!paint.texture.empty() && color.IsBlack()) {
    // Some programs write black beside a texture and mean that the texture alone counts.
    paint.albedo_bgr.setOnes();
  } else {
    paint.albedo_bgr = {color.b, color.g, color.r};
    if (is_gltf()) paint.albedo_bgr = paint.albedo_bgr.unaryExpr(&screen_value);
  }
  return paint;
}

void SceneReader::add_mesh(const aiMesh& source, const Eigen::Affine3f& object_from_mesh) {
  const std::span<const aiFace> faces(source.mFaces, source.mNumFaces);
  const auto is_triangle = [](const aiFace& face) { return face.mNumIndices == 3; };
  const auto count =
      static_cast<std::size_t>(std::count_if(faces.begin(), faces.end(), is_triangle));
  if (count == 0) return;
  // A scene may place one mesh many times.
  if (result_.triangles.size() + count > kMaxTriangles ||
      result_.vertices.size() + source.mNumVertices > 3 * kMaxTriangles) {
    fail("has more than " + std::to_string(kMaxTriangles) + " triangles; simplify the model");
  }

  const Paint paint = read_paint(source);
  use_texture(source, paint);
  const auto first = static_cast<std::uint32_t>(result_.vertices.size());
  add_vertices(source, object_from_mesh, paint);
  for (const aiFace& face : faces) {
    if (!is_triangle(face)) continue;
    Triangle& triangle = result_.triangles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) triangle[c] = first + face.mIndices[c];
  }
}

void SceneReader::add_vertices(const aiMesh& source, const Eigen::Affine3f& object_from_mesh,
                               const Paint& paint) {
  const Eigen::Matrix3f linear = object_from_mesh.linear();
  const bool has_normals = source.HasNormals() && linear.determinant() != 0;
  const Eigen::Matrix3f normal_matrix =
      has_normals ? Eigen::Matrix3f(linear.inverse().transpose()) : Eigen::Matrix3f::Zero();
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    MeshVertex& vertex = result_.vertices.emplace_back();
    const aiVector3D& p = source.mVertices[i];
    vertex.position_mm = object_from_mesh * Eigen::Vector3f(p.x, p.y, p.z);
    if (has_normals) {
      const aiVector3D& n = source.mNormals[i];
      vertex.normal = usable_normal(normal_matrix * Eigen::Vector3f(n.x, n.y, n.z));
    }
    if (source.HasTextureCoords(paint.uv_channel)) {
      const aiVector3D& uv = source.mTextureCoords[paint.uv_channel][i];
      vertex.uv = {uv.x, uv.y};
    }
    vertex.albedo_bgr = paint.albedo_bgr;
    if (source.HasVertexColors(0)) {
      const aiColor4D& c = source.mColors[0][i];
      Eigen::Vector3f color(c.b, c.g, c.r);
      if (is_gltf()) color = color.unaryExpr(&screen_value);
      vertex.albedo_bgr = vertex.albedo_bgr.cwiseProduct(color);
    }
  }
}

void SceneReader::use_texture(const aiMesh& source, const Paint& paint) {
  if (texture_ && *texture_ != paint.texture) {
    const bool is_mixed = texture_->empty() || paint.texture.empty();
    fail(is_mixed ? "is textured in parts; give the whole model one texture (bake its materials)"
                  : "has several textures ('" + *texture_ + "' and '" + paint.texture +
                        "'); bake them into one");
  }
  if (!paint.texture.empty() && !source.HasTextureCoords(paint.uv_channel)) {
    fail("names the texture '" + paint.texture + "' but gives no texture coordinates");
  }
  texture_ = paint.texture;
}

cv::Mat SceneReader::read_texture() const {
  if (const aiTexture* const embedded = scene_.GetEmbeddedTexture(texture_->c_str())) {
    if (embedded->mHeight != 0) fail("embeds its texture uncompressed; embed it as PNG or JPEG");
    return decode_texture(
        {reinterpret_cast<const unsigned char*>(embedded->pcData), embedded->mWidth}, path_,
        "embedded texture");
  }
  std::string name = *texture_;
  std::replace(name.begin(), name.end(), '\\', '/');
  return load_texture(path_.parent_path() / name);
}

/// Leaves assimp the reader for the file's format alone: it would try others on content that the
/// right one refuses. Its reader of glTF 1, a format long gone, goes, too.
void keep_reader_for(std::string_view extension, Assimp::Importer& importer) {
  const std::string wanted = " " + std::string(extension.substr(1)) + " ";
  std::size_t i = 0;
  while (Assimp::BaseImporter* const reader = importer.GetImporter(i)) {
    const aiImporterDesc& about = *importer.GetImporterInfo(i);
    const std::string extensions = " " + std::string(about.mFileExtensions) + " ";
    if (extensions.find(wanted) != std::string::npos &&
        std::string_view(about.mName) != "glTF Importer") {
      ++i;
    } else {
      importer.UnregisterLoader(reader);
      delete reader;  // ours now
    }
  }
}

}  // namespace

bool is_read_by_assimp(std::string_view extension) {
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

MeshData load_with_assimp(const fs::path& path, std::string_view extension) {
  Assimp::Importer importer;
  keep_reader_for(extension, importer);
  auto* const files = new AssimpFiles;
  importer.SetIOHandler(files);  // takes it over
  const std::string name = path.string();
  const std::string& content = files->content(name);
  if (extension != ".obj") check_gltf(path, content, extension == ".glb");

  // With v = 0 at the top, as our textures have it; assimp has it at the bottom for all formats.
  constexpr unsigned kSteps =
      aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_FlipUVs;
  const aiScene* scene = nullptr;
  std::string fault;
  try {
    scene = importer.ReadFile(name, kSteps);
    fault = importer.GetErrorString();
  } catch (const std::exception& error) {  // most are caught inside, not all
    fault = error.what();
  }
  if (files->failure()) throw *files->failure();
  if (scene == nullptr) throw FileError(path, "", "is malformed: " + fault);
  if (scene->mRootNode == nullptr || scene->mNumMeshes == 0) {
    throw FileError(path, "", "holds no surface");
  }
  return SceneReader(path, extension, *scene).read();
}

}  // namespace anneal6d
