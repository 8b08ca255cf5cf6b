// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "cpu_scorer.h"

#include <tbb/enumerable_thread_specific.h>

#include <cassert>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "anneal6d/framework/error.h"
#include "rasterizer.h"
#include "workers.h"

namespace anneal6d {
namespace {

constexpr std::size_t kDrawnPerTask = 4;

/// What one thread works with.
struct Workspace {
  Rasterizer rasterizer;
  cv::Mat grey;
  EdgeDetector edge_detector;
  EdgeImage edges;
};

/// Canny's low threshold follows from the high one if it is not given.
EdgeOptions with_thresholds(EdgeOptions options) {
  if (options.op == EdgeOperator::canny) {
    options.low_threshold = EdgeDetector().thresholds({}, options).low;
  }
  return options;
}

class CpuScorer final : public PoseScorer {
 public:
  explicit CpuScorer(const ScorerSetup& setup)
      : model_((setup.validate(), setup.mesh), setup.textured),
        camera_(setup.camera),
        edges_(with_thresholds(setup.edges)),
        workspaces_([this, shading = setup.shading] {
          return Workspace{Rasterizer(model_, camera_, shading), {}, {}, {}};
        }),
        workers_(setup.threads) {}

  void set_edges(const EdgeImage& edges) override {
    check_edge_image(edges, {camera_.width_px, camera_.height_px});
    frame_binary_ = edges.binary;
    frame_packed_.assign(edges.binary);
  }

  void score(std::span<const Pose> camera_from_object, std::span<EdgeMatch> matches) override {
    assert(camera_from_object.size() == matches.size());
    if (frame_binary_.empty()) throw ConfigError("scorer: set_edges() comes before score()");
    workers_.each(matches.size(), kDrawnPerTask, [&](std::size_t i) {
      matches[i] = score_one(workspaces_.local(), camera_from_object[i]);
    });
  }

 private:
  EdgeMatch score_one(Workspace& workspace, const Pose& camera_from_object) const {
    // Canny's smoothing-free gradients and non-maximum suppression reach two pixels, a Gaussian
    // four of its sigmas.
    const int reach_px = 2 + static_cast<int>(std::ceil(4 * edges_.blur_sigma_px));
    const int margin_px = reach_px + edges_.dilation_px;
    if (edges_.blur_sigma_px <= 0) {
      if (workspace.rasterizer.draw(camera_from_object, margin_px).empty()) return {};
      return workspace.rasterizer.count_edges(frame_packed_, edges_);
    }

    const Region region =
        workspace.rasterizer.draw_images(camera_from_object, margin_px, workspace.grey);
    if (region.empty()) return {};
    workspace.edge_detector.detect(workspace.grey, edges_, workspace.edges);
    cv::Mat& edges = workspace.edges.binary;
    EdgeMatch match;
    match.rendered = cv::countNonZero(edges);
    cv::bitwise_and(edges, frame_binary_({region.x, region.y, region.width, region.height}), edges);
    match.matched = cv::countNonZero(edges);
    return match;
  }

  RasterModel model_;
  CameraModel camera_;
  EdgeOptions edges_;
  cv::Mat frame_binary_;
  PackedEdges frame_packed_;
  tbb::enumerable_thread_specific<Workspace> workspaces_;
  Workers workers_;
};

}  // namespace

std::unique_ptr<PoseScorer> make_cpu_scorer(const ScorerSetup& setup) {
  return std::make_unique<CpuScorer>(setup);
}

}  // namespace anneal6d
