// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/rigid_object_tracker.h"

namespace anneal6d {

/// Poses by frame index: reads `frame,tx,ty,tz,qw,qx,qy,qz[,...]` (millimetres, unit quaternion;
/// further columns are ignored). Throws FileError with the line: wrong header, wrong count, not a
/// number, not finite, a quaternion further than 1e-3 from unit length, a frame given twice.
std::map<std::int64_t, Pose> load_poses(const std::filesystem::path& path);

/// "tx ty tz qw qx qy qz" as of the tool's --init; throws ConfigError.
Pose parse_pose(std::string_view text);

/// One row of the tool's poses.csv.
struct PoseRow {
  std::int64_t frame = 0;
  Pose camera_from_object;
  double quality = 0;
  TrackStatus status = TrackStatus::tracking;
  bool reset = false;  ///< the pose was given to the tracker, not estimated
  double milliseconds = 0;
};

/// The first line of the tool's poses.csv, and the line of one frame; both without a line end.
std::string_view pose_row_header();
std::string to_csv(const PoseRow& row);

/// Writes `frame,tx,ty,tz,qw,qx,qy,qz,quality,status,reset,milliseconds` to a temporary file beside
/// `path`, which takes its name on `commit()`; without a commit nothing is left. Throws FileError.
class PoseWriter {
 public:
  explicit PoseWriter(std::filesystem::path path);
  ~PoseWriter();
  PoseWriter(const PoseWriter&) = delete;
  PoseWriter& operator=(const PoseWriter&) = delete;

  void write(const PoseRow& row);
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  std::ofstream stream_;
};

/// Ground truth in the same order, `frame,tx,ty,tz,qw,qx,qy,qz`, atomically. Throws FileError.
void save_poses(const std::map<std::int64_t, Pose>& poses, const std::filesystem::path& path);

}  // namespace anneal6d
