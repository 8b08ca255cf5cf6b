// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/symmetry.h"

namespace anneal6d {

/// What a sequence folder holds beside its images.
struct SequenceFolder {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> images;         ///< sorted; the position is the frame's index
  std::optional<std::filesystem::path> camera_file;  ///< camera.yml
  std::optional<std::filesystem::path> model_file;   ///< model.obj
  std::map<std::int64_t, Pose> ground_truth;         ///< groundtruth.csv; empty if there is none
  Symmetry symmetry;                                 ///< of meta.json
};

/// Looks at a folder: images are `frame_%04d.png|jpg`, or else all images (png jpg jpeg bmp pgm ppm
/// tif tiff) in natural order ("image2" before "image10"). Throws FileError: no folder, no image,
/// malformed CSV or meta.json.
SequenceFolder open_sequence_folder(const std::filesystem::path& folder);

/// `symmetry` of a meta.json: "none", an axis [x, y, z], or a list of discrete rotations, each a
/// quaternion [w, x, y, z] or a 3x3 matrix as nine numbers or three rows. No such key: none. Throws
/// FileError.
Symmetry load_symmetry(const std::filesystem::path& meta_json);

}  // namespace anneal6d
