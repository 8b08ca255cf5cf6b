// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// A complete tracker of one's own, built as a shared library that the tool loads:
//
//   anneal6d track FOLDER --plugin ./02_write_a_tracker.so --tracker random-search
//
// It tries random poses around the last one, in rounds of shrinking reach, and keeps the best.

#include <algorithm>
#include <memory>
#include <vector>

#include "anneal6d/framework/random.h"
#include "anneal6d/framework/rigid_object_tracker.h"

namespace {

using namespace anneal6d;

constexpr std::size_t kTries = 400;
constexpr EdgeOptions kImageEdges{.threshold = {}, .low_threshold = {}, .dilation_px = 1};
constexpr EdgeOptions kRenderedEdges{.threshold = 40, .low_threshold = {}};

class RandomSearchTracker final : public RigidObjectTracker {
 public:
  explicit RandomSearchTracker(const TrackerSetup& setup)
      : RigidObjectTracker(setup.mesh, setup.camera),
        scorer_(make_plugin(setup.scorers, "scorer", setup.settings.text("scorer").value_or("cpu"),
                            ScorerSetup{setup.mesh, setup.camera, kRenderedEdges, Shading{}})),
        seed_(setup.settings.natural_number("seed").value_or(1)),
        poses_(kTries),
        matches_(kTries) {}

 private:
  void on_reset(const Pose& camera_from_object) override {
    pose_ = camera_from_object;
    frame_ = 0;
  }

  void preprocess(const cv::Mat& undistorted) override {
    scorer_->set_edges(detect_edges(undistorted, kImageEdges));
    ++frame_;
  }

  void estimate(TrackResult& result) override {
    std::uint32_t round = 0;
    for (const double reach : {1.0, 0.5, 0.2, 0.1}) {
      const RandomKey key{seed_, frame_, round++, 0};
      for (std::size_t i = 0; i < kTries; ++i) poses_[i] = i == 0 ? pose_ : moved(key, i, reach);
      scorer_->score(poses_, matches_);
      const auto best = std::max_element(matches_.begin(), matches_.end(), worse);
      pose_ = poses_[static_cast<std::size_t>(best - matches_.begin())];
      match_ = *best;
    }
    result.camera_from_object = result.best_camera_from_object = pose_;
  }

  Judgement judge(const TrackResult&) override {
    const double quality = match_.rendered > 0 ? double(match_.matched) / match_.rendered : 0;
    return {quality, quality > 0.4 ? TrackStatus::tracking : TrackStatus::lost};
  }

  /// Many edges that match, and few that do not.
  static bool worse(const EdgeMatch& a, const EdgeMatch& b) {
    return 2 * a.matched - a.rendered < 2 * b.matched - b.rendered;
  }

  /// The last pose after a random motion of 5 mm and 2 degrees (standard deviations) times `reach`.
  Pose moved(RandomKey key, std::size_t index, double reach) const {
    key.particle = static_cast<std::uint32_t>(index);
    const auto [a, b] = random_normals(key, 0);
    const auto [c, x] = random_normals(key, 1);
    const auto [y, z] = random_normals(key, 2);
    return {rotation_from_vector(0.035 * reach * Eigen::Vector3d(a, b, c)) * pose_.rotation,
            pose_.translation_mm + 5 * reach * Eigen::Vector3d(x, y, z)};
  }

  std::unique_ptr<PoseScorer> scorer_;
  std::uint64_t seed_;
  std::uint32_t frame_ = 0;
  Pose pose_;
  EdgeMatch match_;
  std::vector<Pose> poses_;
  std::vector<EdgeMatch> matches_;
};

}  // namespace

#ifdef _WIN32
#define ANNEAL6D_EXPORT __declspec(dllexport)
#else
#define ANNEAL6D_EXPORT __attribute__((visibility("default")))
#endif

/// What the tool looks for in a plugin.
extern "C" ANNEAL6D_EXPORT void anneal6d_tracker_plugins(TrackerTable& table) {
  table.push_back(
      {"random-search", "sample: tries random poses around the last one",
       [] { return std::string(); },
       [](const TrackerSetup& setup) { return std::make_unique<RandomSearchTracker>(setup); }});
}
