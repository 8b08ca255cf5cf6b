// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "fuzz_readers.h"

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/framework/float_matrix_file.h"
#include "anneal6d/framework/mesh_file.h"
#include "anneal6d/framework/pose_file.h"
#include "anneal6d/framework/sequence_folder.h"

namespace anneal6d::fuzz {
namespace {

namespace fs = std::filesystem;

/// A folder of this process, gone at its end.
class Folder {
 public:
  Folder() {
    std::random_device random;
    path_ = fs::temp_directory_path() /
            ("anneal6d_fuzz_" + std::to_string(random()) + std::to_string(random()));
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::vector<std::string_view> split(std::string_view content) {
  constexpr std::string_view kSeparator = "\n====\n";
  std::vector<std::string_view> parts;
  for (std::size_t at; (at = content.find(kSeparator)) != std::string_view::npos;) {
    parts.push_back(content.substr(0, at));
    content.remove_prefix(at + kSeparator.size());
  }
  parts.push_back(content);
  return parts;
}

/// Writes the parts of the input to files of these names and reads the first one.
template <class Reader>
int run(const std::uint8_t* data, std::size_t size, const std::vector<std::string>& names,
        const Reader& reader) {
  static const Folder folder;
  const auto parts = split({reinterpret_cast<const char*>(data), size});
  for (std::size_t i = 0; i < names.size(); ++i) {
    const fs::path file = folder.path() / names[i];
    if (i >= parts.size()) {
      fs::remove(file);
      continue;
    }
    std::ofstream stream(file, std::ios::binary);
    stream.write(parts[i].data(), static_cast<std::streamsize>(parts[i].size()));
  }
  try {
    reader(folder.path() / names.front());
  } catch (const FileError&) {
    // How a reader refuses a file.
  }
  return 0;
}

int run_mesh(const std::uint8_t* data, std::size_t size, const std::vector<std::string>& names) {
  return run(data, size, names, [](const fs::path& path) { load_mesh(path); });
}

}  // namespace

int fuzz_camera(const std::uint8_t* data, std::size_t size) {
  return run(data, size, {"camera.yml"}, load_camera);
}
int fuzz_float_matrix(const std::uint8_t* data, std::size_t size) {
  return run(data, size, {"matrix.dat"}, load_float_matrix);
}
int fuzz_mesh_cao(const std::uint8_t* data, std::size_t size) {
  return run_mesh(data, size, {"model.cao", "part.cao"});
}
int fuzz_mesh_dat(const std::uint8_t* data, std::size_t size) {
  return run_mesh(data, size, {"model.dat", "modelTex.dat", "model.bmp"});
}
int fuzz_mesh_glb(const std::uint8_t* data, std::size_t size) {
  return run_mesh(data, size, {"model.glb"});
}
int fuzz_mesh_gltf(const std::uint8_t* data, std::size_t size) {
  return run_mesh(data, size, {"model.gltf", "picture.png"});
}
int fuzz_mesh_obj(const std::uint8_t* data, std::size_t size) {
  return run_mesh(data, size, {"model.obj", "model.mtl", "picture.png"});
}
int fuzz_mesh_ply(const std::uint8_t* data, std::size_t size) {
  return run_mesh(data, size, {"model.ply", "picture.png"});
}
int fuzz_mesh_stl(const std::uint8_t* data, std::size_t size) {
  return run_mesh(data, size, {"model.stl"});
}
int fuzz_poses(const std::uint8_t* data, std::size_t size) {
  return run(data, size, {"poses.csv"}, load_poses);
}
int fuzz_symmetry(const std::uint8_t* data, std::size_t size) {
  return run(data, size, {"meta.json"}, load_symmetry);
}

}  // namespace anneal6d::fuzz
