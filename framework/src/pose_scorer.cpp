// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/pose_scorer.h"

#include "anneal6d/framework/error.h"

namespace anneal6d {

void ScorerSetup::validate() const {
  if (!mesh) throw ConfigError("a scorer needs a mesh");
  camera.validate();
  edges.validate();
  if (!edges.threshold) {
    throw ConfigError("the edges of rendered objects need a threshold that is a number, not auto");
  }
  if (threads < 0) throw ConfigError("threads: " + std::to_string(threads) + " is negative");
}

void check_edge_image(const EdgeImage& edges, const cv::Size& camera_size) {
  const cv::Mat& binary = edges.binary;
  if (binary.type() == CV_8UC1 && binary.size() == camera_size) return;
  throw ConfigError("the frame's edge image must be CV_8UC1 of the camera's size, " +
                    std::to_string(camera_size.width) + "x" + std::to_string(camera_size.height) +
                    "; it has " + std::to_string(binary.cols) + "x" + std::to_string(binary.rows) +
                    " and OpenCV type " + std::to_string(binary.type()));
}

}  // namespace anneal6d
