// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "sparse_scorer.h"

#include <cassert>
#include <cmath>
#include <string>

#include "anneal6d/framework/error.h"
#include "packed_edges.h"
#include "sparse_kernels.h"
#include "view_store.h"
#include "workers.h"

namespace anneal6d {
namespace {

constexpr std::size_t kLookedUpPerTask = 64;

class SparseScorer final : public PoseScorer {
 public:
  explicit SparseScorer(const ScorerSetup& setup)
      : camera_((setup.validate(), setup.camera)),
        radius_mm_(setup.mesh->radius_mm()),
        views_(view_model_of(setup)),
        workers_(setup.threads) {}

  void set_edges(const EdgeImage& edges) override {
    check_edge_image(edges, {camera_.width_px, camera_.height_px});
    frame_packed_.assign(edges.binary);
  }

  void score(std::span<const Pose> camera_from_object, std::span<EdgeMatch> matches) override {
    assert(camera_from_object.size() == matches.size());
    if (frame_packed_.size().empty()) throw ConfigError("scorer: set_edges() comes before score()");
    workers_.each(matches.size(), kLookedUpPerTask,
                  [&](std::size_t i) { matches[i] = score_one(camera_from_object[i]); });
  }

 private:
  EdgeMatch score_one(const Pose& camera_from_object) const {
    if (!camera_from_object.is_finite()) return {};
    const double center_z_mm = (camera_from_object * views_->center_mm()).z();
    if (!(center_z_mm > -radius_mm_)) return {};
    const ModelView& view = views_->seen_from(camera_from_object);
    if (view.edges == 0) return {};
    const Eigen::Matrix3d rotation = camera_from_object.rotation.toRotationMatrix();
    LookUpJob job{.x = view.edge_x.data(),
                  .y = view.edge_y.data(),
                  .z = view.edge_z.data(),
                  .count = view.edge_x.size(),
                  .rotation = {},
                  .translation_mm = {},
                  .fx = static_cast<float>(camera_.fx_px),
                  .fy = static_cast<float>(camera_.fy_px),
                  .cx = static_cast<float>(camera_.cx_px),
                  .cy = static_cast<float>(camera_.cy_px),
                  .near_mm = static_cast<float>(kNearPlane_mm),
                  .width = camera_.width_px,
                  .height = camera_.height_px,
                  .edges = frame_packed_.words(),
                  .words = frame_packed_.words_a_row(),
                  .inside = 0,
                  .on_edge = 0};
    for (int i = 0; i < 9; ++i) job.rotation[i] = static_cast<float>(rotation(i / 3, i % 3));
    for (int i = 0; i < 3; ++i) {
      job.translation_mm[i] = static_cast<float>(camera_from_object.translation_mm[i]);
    }
    look_up(job);
    // Edges are lines: their pixels grow in number with the object's size in the image.
    const double px_per_mm = camera_.fx_px / std::max(center_z_mm, kNearPlane_mm);
    const double pixels = view.edge_px / static_cast<double>(view.edges) * px_per_mm /
                          ViewModel::px_per_mm(radius_mm_);
    return {static_cast<std::int32_t>(std::lround(pixels * job.inside)),
            static_cast<std::int32_t>(std::lround(pixels * job.on_edge))};
  }

  CameraModel camera_;
  double radius_mm_;
  std::shared_ptr<const ViewModel> views_;
  PackedEdges frame_packed_;
  Workers workers_;
};

}  // namespace

std::unique_ptr<PoseScorer> make_sparse_scorer(const ScorerSetup& setup) {
  return std::make_unique<SparseScorer>(setup);
}

}  // namespace anneal6d
