// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <span>

#include "anneal6d/framework/pose_scorer.h"
#include "pose_search.h"
#include "synthetic.h"

namespace anneal6d::test {

/// For particle filters whose particles are not rated.
class NoScorer final : public PoseScorer {
 public:
  void set_edges(const EdgeImage& /*edges*/) override {}
  void score(std::span<const Pose> /*camera_from_object*/,
             std::span<EdgeMatch> /*matches*/) override {}
};

/// A box seen from a corner, and all that is needed to refine and to search poses of it without
/// particles.
class BoxScene : public testing::Test {
 protected:
  /// What the motion model leaves open around the truth, along and about each axis.
  BoxScene(double sigma_deg, double sigma_mm) {
    expected_.camera_from_center = filter_.to_center(truth_);
    expected_.sigma << Eigen::Vector3d::Constant(sigma_deg * kDegree),
        Eigen::Vector3d::Constant(sigma_mm);
  }

  void show(const cv::Mat& image) { refiner_.set_image(image, {0, 0, image.cols, image.rows}); }
  const TriangleMesh& mesh() const { return *model_.mesh; }

  const CameraModel camera_ = small_camera().scaled(2);
  const Pose truth_ = corner_view();
  const RasterModel model_{make_box(90, 60, 75), false};
  const ViewModel views_ = views_near(model_, truth_);
  const Appearance appearance_{1};
  NoScorer scorer_;
  Refiner refiner_{views_, camera_, workers()};
  PoseFilter filter_{scorer_, {}, mesh().center_mm().cast<double>(), workers()};
  PoseSearch search_{filter_, refiner_, workers(), {1, 1}, mesh().radius_mm()};
  Expectation expected_;
};

}  // namespace anneal6d::test
