// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/mesh_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <exception>
#include <sstream>
#include <string>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "cao_file.h"
#include "dat_file.h"
#include "gltf_file.h"
#include "obj_file.h"
#include "ply_file.h"
#include "stl_file.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

constexpr float kMinDiameter_mm = 5;
constexpr float kMaxDiameter_mm = 5000;
// Farther from its own origin a model's float coordinates become coarse.
constexpr float kMaxCoordinate_mm = 100'000;

struct UnitRow {
  LengthUnit unit;
  std::string_view name;
  float mm;
};
constexpr std::array<UnitRow, 3> kUnits = {{{LengthUnit::millimetre, "mm", 1},
                                            {LengthUnit::centimetre, "cm", 10},
                                            {LengthUnit::metre, "m", 1000}}};

MeshData read_by_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".dat") return load_dat(path);
  if (extension == ".cao") return load_cao(path);
  if (extension == ".gltf" || extension == ".glb") return load_gltf(path, extension == ".glb");
  if (extension == ".obj") return load_obj(path);
  if (extension == ".ply") return load_ply(path);
  if (extension == ".stl") return load_stl(path);
  throw FileError(path, "",
                  "has an unknown ending; models are .obj, .ply, .stl, .gltf, .glb, .dat (IVT) or "
                  ".cao (ViSP)");
}

/// Box of the corners of all triangles, in the file's unit; throws FileError if there is none.
Eigen::AlignedBox3f bounds_of(const MeshData& data, const fs::path& path) {
  Eigen::AlignedBox3f box;
  for (const Triangle& triangle : data.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= data.vertices.size()) {
        throw FileError(path, "", "a triangle names a vertex that does not exist");
      }
      const Eigen::Vector3f& position = data.vertices[corner].position_mm;
      if (!position.allFinite()) throw FileError(path, "", "a coordinate is not finite");
      box.extend(position);
    }
  }
  if (box.isEmpty()) throw FileError(path, "", "holds no triangle");
  return box;
}

std::string formatted(double length) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << length;
  return text.str();
}

/// Which unit would make the model's size a sensible one.
std::string unit_hint(float diameter) {
  for (const UnitRow& row : kUnits) {
    const float diameter_mm = diameter * row.mm;
    if (diameter_mm >= kMinDiameter_mm && diameter_mm <= kMaxDiameter_mm) {
      return "; if the file is in " + std::string(row.name) + ", say so (--model-unit " +
             std::string(row.name) + ")";
    }
  }
  return "; scale the model to millimetres, centimetres or metres";
}

void check_size(const Eigen::AlignedBox3f& box, float mm_per_unit, const fs::path& path) {
  const float diameter = box.diagonal().norm();
  const float diameter_mm = diameter * mm_per_unit;
  if (!(diameter_mm >= kMinDiameter_mm && diameter_mm <= kMaxDiameter_mm)) {
    throw FileError(path, "",
                    "the model would be " + formatted(diameter_mm) +
                        " mm across; 5 mm to 5 m are accepted" + unit_hint(diameter));
  }
  const float farthest_mm =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) * mm_per_unit;
  if (!(farthest_mm <= kMaxCoordinate_mm)) {
    throw FileError(path, "",
                    "the model lies " + formatted(farthest_mm / 1000) +
                        " m away from its origin; move it there");
  }
}

}  // namespace

TriangleMesh load_mesh(const fs::path& path, LengthUnit unit) {
  const float mm_per_unit = std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitRow& row) {
                              return row.unit == unit;
                            })->mm;
  try {
    MeshData data = read_by_extension(path);
    check_size(bounds_of(data, path), mm_per_unit, path);
    for (MeshVertex& vertex : data.vertices) vertex.position_mm *= mm_per_unit;
    TriangleMesh mesh(std::move(data.vertices), std::move(data.triangles),
                      std::move(data.texture_bgr));
    log(LogLevel::info, "model " + path.string() + ": " + std::to_string(mesh.triangles().size()) +
                            " triangles, " + formatted(mesh.diameter_mm()) + " mm across" +
                            (mesh.has_texture() ? ", textured" : ""));
    return mesh;
  } catch (const ConfigError& error) {
    throw FileError(path, "", error.what());
  } catch (const std::bad_alloc&) {
    throw FileError(path, "", "needs more memory than there is");
  }
}

LengthUnit parse_length_unit(std::string_view text) {
  for (const UnitRow& row : kUnits) {
    if (row.name == text) return row.unit;
  }
  throw ConfigError("unknown unit of length '" + std::string(text) + "'; there are: mm, cm, m");
}

}  // namespace anneal6d
