// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "edge_pictures.h"

#include <spdlog/fmt/fmt.h>

#include <opencv2/imgcodecs.hpp>
#include <string_view>
#include <system_error>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"
#include "anneal6d/visualizer/overlay.h"

namespace anneal6d {

namespace {

void write_png(const std::filesystem::path& path, const EdgeImage& edges) {
  std::vector<std::uint8_t> png;
  cv::imencode(".png", edge_picture(edges), png);
  write_file_atomically(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace

EdgePictures::EdgePictures(std::filesystem::path folder, const CameraModel& camera,
                           std::unique_ptr<ObjectRenderer> renderer, const EdgeOptions& frame_edges,
                           const EdgeOptions& model_edges)
    : folder_(std::move(folder)),
      undistort_(camera),
      renderer_(std::move(renderer)),
      frame_edges_(frame_edges),
      model_edges_(model_edges) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw FileError(folder_, "", "cannot be made: " + error.message());
}

void EdgePictures::write(const Frame& frame, const Pose& camera_from_object) {
  const EdgeImage found = detect_edges(undistort_(frame.image), frame_edges_);
  const EdgeImage rendered =
      rendered_edges(*renderer_, camera_from_object, Shading{}, model_edges_);
  const auto path = [&](std::string_view what) {
    return folder_ / fmt::format("{}_{:04}.png", what, frame.index);
  };
  write_png(path("edges"), found);
  write_png(path("rendered"), rendered);
  write_png(path("matched"), matched_edges(found, rendered));
}

}  // namespace anneal6d
