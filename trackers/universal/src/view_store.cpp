// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "view_store.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "anneal6d/framework/shading.h"
#include "fnv_hash.h"
#include "view_file.h"

namespace anneal6d {
namespace {

/// Viewpoints that see all of a smaller object would be nearer than the near plane.
constexpr double kLeastRadius_mm = 2 * kNearPlane_mm / ViewModel::kDistance;

ViewKey key_of(const ScorerSetup& setup) {
  FnvHash hash;
  const TriangleMesh& mesh = *setup.mesh;
  hash.add(mesh.vertices().data(), mesh.vertices().size_bytes());
  hash.add(mesh.triangles().data(), mesh.triangles().size_bytes());
  const bool textured = setup.textured && mesh.has_texture();
  hash.add(textured);
  if (textured) {
    const cv::Mat& texture = mesh.texture_levels().front();
    for (int y = 0; y < texture.rows; ++y) {
      hash.add(texture.ptr(y), static_cast<std::size_t>(texture.cols) * texture.elemSize());
    }
  }
  hash.add(static_cast<int>(setup.edges.op));
  hash.add(setup.edges.threshold.value_or(-1));
  hash.add(setup.edges.low_threshold.value_or(-1));
  hash.add(setup.edges.blur_sigma_px);
  hash.add(setup.edges.dilation_px);
  for (const float value : setup.shading.to_light) hash.add(value);
  hash.add(setup.shading.ambient);
  hash.add(setup.shading.diffuse);
  hash.add(ViewModel::kViews);
  hash.add(ViewModel::kDistance);
  hash.add(ViewModel::kRadius_px);
  return hash.value();
}

std::optional<std::string> read_if_there(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  try {
    return read_file(path);
  } catch (const FileError& error) {
    log(LogLevel::warning,
        std::string("the views of an earlier run are not used: ") + error.what());
    return std::nullopt;
  }
}

void write_if_possible(const std::filesystem::path& path, const std::string& bytes) {
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  try {
    write_file_atomically(path, bytes);
  } catch (const FileError& error) {
    log(LogLevel::warning,
        std::string("the next run will prepare the model again: ") + error.what());
  }
}

std::shared_ptr<const ViewModel> load_or_make(const ScorerSetup& setup, ViewKey key) {
  const Eigen::Vector3d center_mm = setup.mesh->center_mm().cast<double>();
  const double radius_mm = setup.mesh->radius_mm();
  std::filesystem::path path;
  if (!setup.view_cache.empty()) {
    char name[32];
    std::snprintf(name, sizeof name, "%016llx.views", static_cast<unsigned long long>(key));
    path = setup.view_cache / name;
    if (const auto bytes = read_if_there(path)) {
      if (auto views = unpack_views(*bytes, key, center_mm, radius_mm)) {
        return std::make_shared<const ViewModel>(center_mm, std::move(*views));
      }
      log(LogLevel::warning, path.string() + " is damaged or of another version; made anew");
    }
  }
  const RasterModel model(setup.mesh, setup.textured);
  const ViewModel made(model, setup.edges, setup.shading, setup.threads, setup.progress);
  const std::string bytes = pack_views(made.views(), key, center_mm, radius_mm);
  if (!path.empty()) write_if_possible(path, bytes);
  // Through the file's rounding, so that the first run gives the same poses as all others.
  return std::make_shared<const ViewModel>(center_mm,
                                           *unpack_views(bytes, key, center_mm, radius_mm));
}

}  // namespace

std::shared_ptr<const ViewModel> view_model_of(const ScorerSetup& setup) {
  const double radius_mm = setup.mesh->radius_mm();
  if (radius_mm < kLeastRadius_mm) {
    throw ConfigError("the model measures only " + std::to_string(2 * radius_mm) +
                      " mm: is its unit millimetres?");
  }
  static std::mutex mutex;
  static std::map<ViewKey, std::weak_ptr<const ViewModel>> in_use;
  const ViewKey key = key_of(setup);
  const std::scoped_lock lock(mutex);
  std::weak_ptr<const ViewModel>& known = in_use[key];
  if (auto views = known.lock()) return views;
  auto views = load_or_make(setup, key);
  known = views;
  return views;
}

}  // namespace anneal6d
