// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/trackers/universal_tracker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/particle_filter.h"
#include "drawn_mesh.h"
#include "exact_contour.h"
#include "motion_model.h"
#include "pose_filter.h"
#include "pose_search.h"
#include "pose_uncertainty.h"
#include "refiner.h"
#include "region_cue.h"
#include "view_store.h"
#include "workers.h"

namespace anneal6d {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSure = 0.92;  // of the usual support: there is no need to search
constexpr double kPoor = 0.85;  // of the usual fit: less is searched once
// What a second attempt found, by colours, must be confirmed better.
constexpr double kSecondAttempt = 1.06;
constexpr double kFitting = 0.94;  // of the usual fit: there is no need to look at all neighbours
constexpr double kFitRise = 0.3, kFitFall = 0.03;  // of the newest frame in the usual fit
constexpr double kNeighbour_px = 4.0, kNeighbourShift_px = 3.0;
constexpr double kNeighbourReach_px = 3.0;
constexpr double kNeighbourApart_px = 1.0;  // less is the same place
constexpr std::uint32_t kNeighbourMotions = 4;
// By how much a neighbour must be likelier, by views and by the exact contour: else noise decides.
constexpr double kNeighbourGain = 0.006, kExactGain = 0.01;
constexpr std::uint32_t kPasses = 3;  // of the search, each twice as wide as the one before
constexpr double kWider = 0.9;        // of what is sure: less lets the search go on, wider
constexpr double kGain = 0.03;        // in evidence, without which a search was in vain
constexpr double kRegionWeight = 20;  // of the colours beside the edges, as the rating's c
constexpr double kFirstSupport = 0.8;
constexpr double kSupportRise = 0.1, kSupportFall = 0.3;  // the same in the usual support
constexpr double kWindow_px = 30.0;  // around the object, and three deviations of its motion
constexpr double kLeastReach_px = 6.0, kMostReach_px = 16.0;
constexpr std::size_t kLargeModel = 40'000;       // triangles, too many to be drawn in every frame
constexpr double kRight_mm = 10, kRight_deg = 2;  // what quality is the probability of
constexpr double kFarthest = 4;                   // of a particle, in standard deviations
constexpr double kLostQuality = 0.25;
constexpr int kFramesUntilLost = 2;

ScorerSetup scorer_setup(const TrackerSetup& setup, const UniversalTrackerOptions& options) {
  ScorerSetup scorer;
  scorer.mesh = mesh_to_draw(setup.mesh);
  scorer.camera = setup.camera;
  scorer.edges = options.model_edges;
  scorer.textured = options.textured;
  scorer.threads = options.threads;
  scorer.view_cache = options.view_cache;
  scorer.progress = setup.progress;
  return scorer;
}

/// Share of frames with such support beyond chance (1: all that is possible, 0: none) whose pose
/// was right to 10 mm and 2 degrees, by and large; see README.md, "Quality".
double quality_of(double support_beyond_chance) {
  return 0.92 * std::clamp((support_beyond_chance + 0.05) / 0.28, 0.0, 1.0) +
         0.08 * std::clamp((support_beyond_chance - 0.25) / 0.5, 0.0, 1.0);
}

/// What the default mode works with; the thesis's does without.
struct Sight {
  Sight(const ScorerSetup& setup, PoseFilter& filter, const PoseSearch::Effort& effort,
        Workers& workers)
      : views(view_model_of(setup)),
        refiner(*views, setup.camera),
        region(*views, setup.camera, workers),
        search(filter, refiner, workers, effort, setup.mesh->radius_mm()) {
    filter.set_region_cue(region);
    if (setup.mesh->triangles().size() < kLargeModel) exact = std::make_unique<ExactContour>(setup);
  }

  std::shared_ptr<const ViewModel> views;
  Refiner refiner;
  RegionCue region;
  PoseSearch search;
  std::unique_ptr<ExactContour> exact;   ///< null for very large models
  std::optional<Appearance> appearance;  ///< for as many channels as the frames have
};

class UniversalTracker final : public RigidObjectTracker {
 public:
  UniversalTracker(const TrackerSetup& setup, const UniversalTrackerOptions& options)
      : UniversalTracker(setup, options, scorer_setup(setup, options)) {}

  UniversalTracker(const TrackerSetup& setup, const UniversalTrackerOptions& options,
                   const ScorerSetup& drawing)
      : RigidObjectTracker(setup.mesh, setup.camera),
        options_(options),
        symmetry_(setup.symmetry),
        scorer_(make_plugin(setup.scorers, "scorer", options.scorer, drawing)),
        workers_(options.threads),
        filter_(*scorer_, options.rating, setup.mesh->center_mm().cast<double>(), workers_),
        motion_(options.sigma_mm, options.sigma_deg * kDegree) {
    if (options.mode == UniversalMode::standard) {
      sight_.emplace(drawing, filter_, PoseSearch::Effort{options.particles, options.layers},
                     workers_);
    }
  }

 protected:
  void on_reset(const Pose& camera_from_object) override {
    center_ = filter_.to_center(camera_from_object);
    filter_.initialize(center_, static_cast<std::size_t>(options_.particles));  // Alg. 1
    motion_.reset();
    uncertainty_.reset();
    last_motion_.setZero();
    frame_number_ = 0;
    bad_frames_ = 0;
    usual_support_ = kFirstSupport;
    usual_fit_ = 0;
    if (!sight_) return;
    sight_->appearance.reset();
    if (sight_->exact) sight_->exact->reset();
  }

  void on_shown(const cv::Mat& undistorted) override {
    if (!sight_) return;
    look(undistorted, center_, kWindow_px);
    const Pose pose = filter_.to_object(center_);
    sight_->refiner.teach(pose, *sight_->appearance);
    const Refiner::Result shown = sight_->refiner.examine(pose, *sight_->appearance);
    usual_support_ = shown.support;
    usual_fit_ = shown.fit;
  }

  void preprocess(const cv::Mat& undistorted) override {
    image_ = undistorted;
    if (!sight_) {
      // Wherever particles may go within the frame's layers.
      const double wander_mm = kFarthest * options_.sigma_mm + last_motion_.tail<3>().norm();
      const cv::Rect around = detect_edges_around(center_, mesh().radius_mm() + wander_mm);
      chance_ = static_cast<double>(cv::countNonZero(edges_.binary(around))) /
                static_cast<double>(around.area());
      return;
    }
    expected_ = {moved(center_, motion_.drift()), motion_.sigma()};
    look(undistorted, expected_.camera_from_center, kWindow_px + 3 * deviation_px());
  }

  void estimate(TrackResult& result) override {
    if (sight_) {
      estimate_by_default(result);
    } else {
      estimate_as_in_thesis(result);
    }
    ++frame_number_;
  }

  Judgement judge(const TrackResult& result) override {
    Judgement judgement;
    if (sight_) {
      judgement.quality = quality_;
    } else {
      // Edges that match by chance, because the image is full of them, confirm nothing.
      const double ratio = match_ratio(match_of(result.camera_from_object));
      judgement.quality = std::clamp((ratio - chance_) / std::max(1e-6, 1.0 - chance_), 0.0, 1.0);
    }
    const bool bad = (sight_ ? confirmation_ : judgement.quality) < kLostQuality;
    bad_frames_ = bad ? bad_frames_ + 1 : 0;
    judgement.status = bad_frames_ >= kFramesUntilLost ? TrackStatus::lost : TrackStatus::tracking;
    return judgement;
  }

 private:
  /// Algorithms 1-5 with the annealing of 4.1.2.
  void estimate_as_in_thesis(TrackResult& result) {
    const Pose last = center_;
    double rating = 0;  // Alg. 4, of the last layer's estimate
    for (int layer = 0; layer < options_.layers; ++layer) {
      PoseFilter::Layer step;
      if (layer == 0 && options_.drift) step.drift = last_motion_;  // Alg. 3: meanPose - lastPose
      const double factor =
          annealing_factor(options_.annealing, layer, rating, options_.annealing_ratio);
      step.diffusion = (factor * initial_sigma()).asDiagonal();
      filter_.set_layer(step);
      center_ = filter_.run_layer(key(layer), Resampling::multinomial);
      const double ratio = match_ratio(match_of(filter_.to_object(center_)));
      rating = std::exp(-options_.rating.c * (1.0 - ratio));
    }
    last_motion_ = twist_between(last, center_);
    result.camera_from_object = filter_.to_object(center_);
    result.best_camera_from_object = filter_.to_object(filter_.best());
  }

  /// First the motion model's guess is refined; colours, particles and neighbouring poses may find
  /// a better one.
  void estimate_by_default(TrackResult& result) {
    const Pose last = center_;
    const Appearance& appearance = *sight_->appearance;
    const Pose guess = filter_.to_object(expected_.camera_from_center);
    const double reach_px = std::clamp(deviation_px(), kLeastReach_px, kMostReach_px);
    Refiner::Result best = sight_->refiner.refine(guess, guess, reach_px, appearance);
    if (!confirmed_as_usual(best)) {
      // Too far off for edges; colours lead nearer.
      const Pose nearer = sight_->refiner.approach(guess, appearance);
      const auto other = sight_->refiner.refine(nearer, guess, reach_px, appearance);
      if (likelihood(other) > likelihood(best)) best = other;
      if (!confirmed_as_usual(best, kSecondAttempt)) best = search_around(best, appearance);
    }
    const auto draw = [&] {
      if (sight_->exact) sight_->exact->draw(best.camera_from_object, workers_);
    };
    if (const auto better = better_neighbour(best, appearance, draw)) {
      best = *better;
      draw();
    }
    usual_fit_ += (best.fit > usual_fit_ ? kFitRise : kFitFall) * (best.fit - usual_fit_);
    usual_support_ += (best.support > usual_support_ ? kSupportRise : kSupportFall) *
                      (best.support - usual_support_);
    if (sight_->exact) best = polished(best, appearance);
    Pose found = filter_.to_center(best.camera_from_object);
    found.rotation = symmetry_.fold(found.rotation, last.rotation);
    result.camera_from_object = result.best_camera_from_object = filter_.to_object(found);

    const double chance = sight_->refiner.chance(best.camera_from_object);
    confirmation_ = quality_of((best.support - chance) / std::max(1e-6, 1.0 - chance));
    uncertainty_.update(motion_.seen_sigma(), best.unseen);
    quality_ = confirmation_ * uncertainty_.probability_within(kRight_mm, kRight_deg * kDegree,
                                                               found.rotation * symmetry_.axis);
    const bool confirmed = confirmation_ >= kLostQuality;
    if (!confirmed && bad_frames_ > 0) {
      // Go on searching around the pose of the first bad frame.
      motion_.reset();
      return;
    }
    center_ = found;
    motion_.observe(last, center_);
    if (confirmed) sight_->refiner.teach(result.camera_from_object, *sight_->appearance);
  }

  bool supported_as_usual(const Refiner::Result& result, double demand = 1) const {
    return result.support >= demand * kSure * usual_support_;
  }

  bool confirmed_as_usual(const Refiner::Result& result, double demand = 1) const {
    return supported_as_usual(result, demand) && result.fit >= demand * kPoor * usual_fit_;
  }

  /// Particles search, wider and wider, for a pose that the image confirms better than the refined
  /// one. Where even they find none, less is usual from now on: something hides the object.
  Refiner::Result search_around(const Refiner::Result& refined, const Appearance& appearance) {
    detect_edges_around(expected_.camera_from_center, mesh().radius_mm() + 3 * expected_.sigma[5]);
    sight_->region.set_image(sight_->refiner.picture(), appearance);
    Refiner::Result best = refined;
    Expectation wider = expected_;
    for (std::uint32_t pass = 0; pass < kPasses; ++pass) {
      if (pass > 0 && supported_as_usual(best, kWider)) break;
      const double weight = appearance.learned() ? kRegionWeight : 0.0;
      RandomKey random = key(0);
      random.frame = frame_number_ * kPasses + pass;
      const Refiner::Result found =
          sight_->search.run(wider, {appearance, weight}, random, camera().fx_px);
      if (likelihood(found) > likelihood(best)) best = found;
      wider.sigma *= 2.0;
    }
    if (likelihood(best) < likelihood(refined) + kGain) {
      usual_support_ = std::min(usual_support_, best.support);
      usual_fit_ = std::min(usual_fit_, best.fit);
    }
    return best;
  }

  /// A better pose near it, if there is one: edges side by side, such as the two of a cup's rim,
  /// make false bottoms. A false bottom stays from frame to frame, so that each frame looks along
  /// one motion only, unless edges fit less closely than usual. `meanwhile` is called on some
  /// thread.
  std::optional<Refiner::Result> better_neighbour(const Refiner::Result& refined,
                                                  const Appearance& appearance,
                                                  const std::function<void()>& meanwhile) {
    const Refiner& refiner = sight_->refiner;
    const bool doubtful = refined.fit < kFitting * usual_fit_;
    std::vector<Pose> starts;
    for (std::uint32_t motion = 0; motion < kNeighbourMotions; ++motion) {
      if (!doubtful && motion != frame_number_ % kNeighbourMotions) continue;
      for (const Pose& start : beside(refined, motion)) starts.push_back(start);
    }
    std::vector<Refiner::Result> others(starts.size());
    Refiner::Result best;  // the refined one first, with as few points as the others
    workers_.each(others.size() + 2, 1, [&](std::size_t i) {
      if (i == 0) {
        meanwhile();  // it takes longest
      } else if (i == 1) {
        best = refiner.examine(refined.camera_from_object, appearance, Refiner::Care::quick);
      } else {
        others[i - 2] = refiner.refine(starts[i - 2], starts[i - 2], kNeighbourReach_px, appearance,
                                       Refiner::Care::quick);
      }
    });
    const auto likely = [&](const Refiner::Result& result) {
      return result.fit - strangeness(result);
    };
    bool better = false;
    for (const Refiner::Result& other : others) {
      if (likely(other) <= likely(best) || same_place(other, refined)) continue;
      best = other;
      better = true;
    }
    if (!better) return std::nullopt;
    best = refiner.refine(best.camera_from_object, best.camera_from_object, kNeighbourReach_px,
                          appearance);
    if (likely(best) <= likely(refined) + kNeighbourGain) return std::nullopt;
    return best;
  }

  /// A refined pose on the exact contour, which was drawn there. Views do not tell all false
  /// bottoms from the true one: a neighbour that the exact contour likes better is drawn, too.
  Refiner::Result polished(const Refiner::Result& refined, const Appearance& appearance) {
    const Refiner& refiner = sight_->refiner;
    ExactContour& exact = *sight_->exact;
    struct Polished {
      Refiner::Result result;
      double likelihood = 0;  ///< by the exact contour
    };
    const auto polish = [&](const Refiner::Result& start) -> Polished {
      const auto result = refiner.polish(start, exact.contour(), exact.feigned_share(), appearance);
      return {result, likelihood(refiner.examine_in(exact.contour(), result.camera_from_object,
                                                    appearance))};
    };
    // Along one motion while those of better_neighbour() take turns, so that all pairs are tried.
    const auto [before, behind] =
        beside(refined, frame_number_ / kNeighbourMotions % kNeighbourMotions);
    const std::array<Pose, 3> starts{before, behind,
                                     filter_.to_object(expected_.camera_from_center)};
    std::array<Refiner::Result, 3> others;
    Polished here;
    workers_.each(others.size() + 1, 1, [&](std::size_t i) {
      if (i == 0) {
        here = polish(refined);
      } else {
        others[i - 1] =
            refiner.refine_in(exact.contour(), starts[i - 1], kNeighbourReach_px, appearance);
      }
    });
    const Refiner::Result* rival = nullptr;
    double most = here.likelihood;
    for (const Refiner::Result& other : others) {
      if (likelihood(other) <= most || same_place(other, here.result)) continue;
      most = likelihood(other);
      rival = &other;
    }
    if (!rival) return here.result;
    exact.draw(rival->camera_from_object, workers_);
    Polished there = polish(*rival);
    if (there.likelihood <= here.likelihood + kExactGain) return here.result;
    there.result.support = refiner.examine(there.result.camera_from_object, appearance).support;
    return there.result;
  }

  /// Poses on both sides of a refined one. False bottoms lie along the motions that the contour
  /// shows least (`motion` 0 and 2) and, since either edge of a rim is taken for the other, a few
  /// pixels aside (1 and 3).
  std::array<Pose, 2> beside(const Refiner::Result& refined, std::uint32_t motion) const {
    const Pose center = filter_.to_center(refined.camera_from_object);
    const Twist step =
        motion % 2 == 0
            ? Twist(kNeighbour_px * refined.weak_motions[motion / 2])
            : Twist(kNeighbourShift_px * mm_per_px(center) * Twist::Unit(motion == 1 ? 4 : 3));
    return {filter_.to_object(moved(center, -step)), filter_.to_object(moved(center, step))};
  }

  /// Whether poses are in one basin, as far as that can be told from how near they are.
  bool same_place(const Refiner::Result& a, const Refiner::Result& b) const {
    const Pose center = filter_.to_center(a.camera_from_object);
    const Twist apart = twist_between(center, filter_.to_center(b.camera_from_object));
    return apart.head<3>().norm() * mesh().radius_mm() + apart.tail<3>().norm() <
           kNeighbourApart_px * mm_per_px(center);
  }

  double mm_per_px(const Pose& camera_from_center) const {
    return std::max(kNearPlane_mm, camera_from_center.translation_mm.z()) / camera().fx_px;
  }

  double likelihood(const Refiner::Result& result) const {
    return result.evidence() - strangeness(result);
  }

  double strangeness(const Refiner::Result& result) const {
    return expected_.strangeness(filter_.to_center(result.camera_from_object));
  }

  /// Shows the surroundings of a pose to the refiner.
  void look(const cv::Mat& undistorted, const Pose& camera_from_center, double margin_px) {
    const int channels = undistorted.channels();
    if (!sight_->appearance || sight_->appearance->channels() != channels) {
      sight_->appearance.emplace(channels);
    }
    sight_->refiner.set_image(undistorted,
                              window(camera_from_center, mesh().radius_mm(), margin_px));
  }

  /// Finds the edges of the frame for the scorer, where a sphere around the object may appear.
  /// Returns that part of the frame.
  cv::Rect detect_edges_around(const Pose& camera_from_center, double radius_mm) {
    const cv::Rect around = window(camera_from_center, radius_mm, kWindow_px);
    edge_detector_.detect(image_(around), options_.frame_edges, edges_around_);
    edges_.binary.create(image_.size(), CV_8UC1);
    edges_.binary.setTo(0);
    edges_around_.binary.copyTo(edges_.binary(around));
    scorer_->set_edges(edges_);
    return around;
  }

  /// Where a sphere about the object's centre and a margin around it appear; the whole image if
  /// that is none of it.
  cv::Rect window(const Pose& camera_from_center, double radius_mm, double margin_px) const {
    const cv::Rect whole(0, 0, camera().width_px, camera().height_px);
    const double z_mm = camera_from_center.translation_mm.z();
    if (!(z_mm > 1.2 * radius_mm)) return whole;
    const Eigen::Vector2d middle = camera().project(camera_from_center.translation_mm);
    const double half = camera().fx_px * radius_mm / (z_mm - radius_mm) + margin_px;
    if (!(middle.norm() < 1e6) || !(half < 1e6)) return whole;
    const int side = static_cast<int>(2 * half);
    const cv::Rect around = whole & cv::Rect(static_cast<int>(middle.x() - half),
                                             static_cast<int>(middle.y() - half), side, side);
    return around.area() >= 256 ? around : whole;
  }

  /// How far the object's edges may be, in the image, from where they are expected.
  double deviation_px() const {
    return (expected_.sigma[5] + expected_.sigma[0] * mesh().radius_mm()) /
           mm_per_px(expected_.camera_from_center);
  }

  Twist initial_sigma() const {
    Twist sigma;
    sigma << Eigen::Vector3d::Constant(options_.sigma_deg * kDegree),
        Eigen::Vector3d::Constant(options_.sigma_mm);
    return sigma;
  }

  EdgeMatch match_of(const Pose& camera_from_object) {
    EdgeMatch match;
    scorer_->score({&camera_from_object, 1}, {&match, 1});
    return match;
  }

  RandomKey key(int layer) const {
    return {options_.seed, frame_number_, static_cast<std::uint32_t>(layer), 0};
  }

  UniversalTrackerOptions options_;
  Symmetry symmetry_;
  std::unique_ptr<PoseScorer> scorer_;
  Workers workers_;
  PoseFilter filter_;
  MotionModel motion_;
  PoseUncertainty uncertainty_;
  std::optional<Sight> sight_;  ///< of the default mode
  EdgeDetector edge_detector_;

  Pose center_;  ///< camera_from_center of the last frame
  Expectation expected_;
  Twist last_motion_ = Twist::Zero();
  std::uint32_t frame_number_ = 0;
  int bad_frames_ = 0;
  /// Of the last estimate: how far the image confirms it, and that times the chance that it did not
  /// move away unseen.
  double confirmation_ = 0, quality_ = 0;
  double usual_support_ = 0, usual_fit_ = 0;  ///< of estimates lately
  cv::Mat image_;
  EdgeImage edges_, edges_around_;
  double chance_ = 0;  ///< share of edge pixels around the object, in thesis mode
};

}  // namespace

std::unique_ptr<RigidObjectTracker> make_universal_tracker(const TrackerSetup& setup) {
  if (!setup.mesh) throw ConfigError("a tracker needs a mesh");
  return std::make_unique<UniversalTracker>(setup, UniversalTrackerOptions::from(setup.settings));
}

}  // namespace anneal6d
