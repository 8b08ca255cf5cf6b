// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "mtl_file.h"

#include <algorithm>
#include <array>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"
#include "anneal6d/framework/triangle_mesh.h"
#include "statements.h"
#include "text_tokens.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxMtlFileSize = std::size_t{16} << 20;

/// Position of the file's name behind the options of map_Kd.
std::size_t skip_options(const Statements& line) {
  struct Option {
    std::string_view name;
    std::size_t arguments;
  };
  constexpr std::array<Option, 10> kOptions = {{{"-blendu", 1},
                                                {"-blendv", 1},
                                                {"-bm", 1},
                                                {"-boost", 1},
                                                {"-cc", 1},
                                                {"-clamp", 1},
                                                {"-imfchan", 1},
                                                {"-mm", 2},
                                                {"-texres", 1},
                                                {"-type", 1}}};
  std::size_t at = 0;
  while (at < line.argument_count() && line.argument(at).starts_with('-')) {
    const std::string_view name = line.argument(at++);
    if (name == "-o" || name == "-s" || name == "-t") {
      const double neutral = name == "-s" ? 1 : 0;  // offset and turbulence; scale
      while (at < line.argument_count() && parse_number(line.argument(at))) {
        if (line.number(at++) != neutral) {
          line.fail("moves or scales the texture; bake that into the texture coordinates");
        }
      }
      continue;
    }
    const auto option = std::find_if(kOptions.begin(), kOptions.end(),
                                     [&](const Option& row) { return row.name == name; });
    if (option == kOptions.end()) line.fail(excerpt(name) + " is no option of map_Kd");
    at += option->arguments;
  }
  return at;
}

}  // namespace

Eigen::Vector3f Material::albedo_bgr() const {
  // Some programs write black beside a texture and mean that the texture alone counts.
  if (!texture.empty() && (!diffuse_bgr || diffuse_bgr->isZero(0))) return Eigen::Vector3f::Ones();
  return diffuse_bgr.value_or(MeshVertex{}.albedo_bgr);
}

std::map<std::string, Material, std::less<>> load_mtl(const fs::path& path) {
  const std::string content = read_file(path, kMaxMtlFileSize);
  std::map<std::string, Material, std::less<>> materials;
  Material* current = nullptr;
  for (Statements line(path, content); line.next();) {
    const std::string_view keyword = line.keyword();
    if (keyword == "newmtl") {
      const std::string name(line.text_from(0));
      const auto [entry, is_new] = materials.try_emplace(name);
      if (!is_new) line.fail("the material " + excerpt(name) + " is given a second time");
      current = &entry->second;
    } else if (keyword == "Kd" || keyword == "map_Kd") {
      if (current == nullptr) line.fail(excerpt(keyword) + " should follow newmtl");
      if (keyword == "Kd") {
        current->diffuse_bgr =
            Eigen::Vector3d(line.number(2), line.number(1), line.number(0)).cast<float>();
      } else {
        std::string name(line.text_from(skip_options(line)));
        if (name.empty()) line.fail("map_Kd names no file");
        std::replace(name.begin(), name.end(), '\\', '/');
        current->texture = path.parent_path() / name;
      }
    }  // all else is about light that we do not simulate
  }
  return materials;
}

}  // namespace anneal6d
