// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace anneal6d::fuzz {

// Each hands the bytes as a file to one reader, which must read it or throw FileError; anything
// else that happens is a fault. Where a model has several files, a line "====" separates them.
// Returns 0.
int fuzz_camera(const std::uint8_t* data, std::size_t size);
int fuzz_float_matrix(const std::uint8_t* data, std::size_t size);
int fuzz_mesh_cao(const std::uint8_t* data, std::size_t size);
int fuzz_mesh_dat(const std::uint8_t* data, std::size_t size);  // matrix, texture matrix, BMP
int fuzz_mesh_glb(const std::uint8_t* data, std::size_t size);
int fuzz_mesh_gltf(const std::uint8_t* data, std::size_t size);  // glTF, picture.png
int fuzz_mesh_obj(const std::uint8_t* data, std::size_t size);   // OBJ, model.mtl, picture.png
int fuzz_mesh_ply(const std::uint8_t* data, std::size_t size);   // PLY, picture.png
int fuzz_mesh_stl(const std::uint8_t* data, std::size_t size);
int fuzz_poses(const std::uint8_t* data, std::size_t size);
int fuzz_symmetry(const std::uint8_t* data, std::size_t size);

struct Target {
  const char* name;  // of its folder in corpus/
  int (*run)(const std::uint8_t* data, std::size_t size);
};

inline constexpr std::array<Target, 11> kTargets = {{{"camera", fuzz_camera},
                                                     {"float_matrix", fuzz_float_matrix},
                                                     {"mesh_cao", fuzz_mesh_cao},
                                                     {"mesh_dat", fuzz_mesh_dat},
                                                     {"mesh_glb", fuzz_mesh_glb},
                                                     {"mesh_gltf", fuzz_mesh_gltf},
                                                     {"mesh_obj", fuzz_mesh_obj},
                                                     {"mesh_ply", fuzz_mesh_ply},
                                                     {"mesh_stl", fuzz_mesh_stl},
                                                     {"poses", fuzz_poses},
                                                     {"symmetry", fuzz_symmetry}}};

}  // namespace anneal6d::fuzz
