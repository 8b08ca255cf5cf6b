// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "confirmation.h"
#include "exact_contour.h"
#include "exposure.h"
#include "motion_model.h"
#include "neighbourhood.h"
#include "polisher.h"
#include "pose_filter_tracker.h"
#include "pose_search.h"
#include "pose_uncertainty.h"
#include "refiner.h"
#include "region_cue.h"
#include "shading_share.h"
#include "simplified_mesh.h"
#include "view_store.h"

namespace anneal6d {
namespace {

constexpr double kSure = 0.92;   // of the usual support: there is no need to search
constexpr double kPoorer = 0.1;  // in evidence, than usual: that is searched once
// What a second attempt found, by colours, must be supported better.
constexpr double kSecondAttempt = 1.06;
constexpr double kFitRise = 0.3, kFitFall = 0.03;  // of the newest frame in the usual fit
constexpr double kNeighbourGain = 0.006;  // by which one must be likelier: else noise decides
// By how much wider an object is searched for with each frame without it, and with how many.
constexpr double kGoneAway = 0.5, kLongestLost = 6;
constexpr std::uint32_t kPasses = 3;  // of a search; of particles, each twice as wide as the last
constexpr double kWider = 0.9;        // of what is sure: less lets the search go on, wider
constexpr double kGain = 0.03;        // in evidence, without which a search was in vain
constexpr double kRegionWeight = 20;  // of the colours beside the edges, as the rating's c
constexpr double kFirstSupport = 0.8;
constexpr double kSupportRise = 0.1, kSupportFall = 0.3;  // the same in the usual support
constexpr double kLeastReach_px = 6.0, kMostReach_px = 16.0;
// Triangles: what larger models are simplified to, and too many to be drawn in every frame.
constexpr std::size_t kDrawnTriangles = 20'000, kLargeModel = 40'000;
constexpr double kEdgeError_px = 0.15;  // by which all of a contour may be off together
constexpr double kClearlyBetter = 0.1;  // in evidence, than the pose that was given
// The shutter's time is learned in one of so many frames, of motions that blur enough, and shading
// in the others.
constexpr std::uint32_t kTellingFrames = 3;
constexpr double kTellingMotion_px = 2.0;
constexpr double kRight_mm = 10, kRight_deg = 2;  // what quality is the probability of

/// First the motion model's guess is refined; colours, particles and neighbouring poses may find a
/// better one, and the contour drawn there has the last word.
class DefaultTracker final : public PoseFilterTracker {
 public:
  DefaultTracker(const TrackerSetup& setup, const UniversalTrackerOptions& options)
      : DefaultTracker(setup, options, quick_drawing_of(setup, options)) {}

  DefaultTracker(const TrackerSetup& setup, const UniversalTrackerOptions& options,
                 const ScorerSetup& drawing)
      : PoseFilterTracker(setup, options, drawing),
        symmetry_(setup.symmetry),
        views_(view_model_of(drawing)),
        refiner_(*views_, setup.camera, workers_),
        region_(*views_, setup.camera, workers_),
        search_(filter_, refiner_, workers_, {options.particles, options.layers},
                setup.mesh->radius_mm()),
        neighbourhood_(setup.mesh->center_mm().cast<double>(), setup.mesh->radius_mm(),
                       setup.camera.fx_px),
        polisher_(refiner_, search_, neighbourhood_, workers_, setup.symmetry.axis.isZero()),
        motion_(options.sigma_mm, options.sigma_deg * kDegree) {
    filter_.set_region_cue(region_);
    if (drawing.mesh->triangles().size() < kLargeModel) {
      exact_ = std::make_unique<ExactContour>(drawing);
    }
  }

 protected:
  void on_reset(const Pose& camera_from_object) override {
    PoseFilterTracker::on_reset(camera_from_object);
    motion_.reset();
    uncertainty_.reset();
    exposure_.reset();
    shading_.reset();
    refiner_.set_shading_share(shading_.share());
    appearance_.reset();
    if (exact_) exact_->reset();
    usual_support_ = kFirstSupport;
    usual_fit_ = 0;
  }

  cv::Rect region_of_interest() override {
    // Where the object was lost sight of, it may go farther away with every frame.
    const double lost_for = std::min<double>(bad_frames(), kLongestLost);
    expected_ = {moved(center_, motion_.drift()), (1 + kGoneAway * lost_for) * motion_.sigma()};
    return with_surroundings(window(expected_.camera_from_center, mesh().radius_mm(), margin_px()) |
                             window(expected_.camera_from_center, searched_mm(), kWindow_px));
  }

  void on_shown(const cv::Mat& undistorted) override {
    look(undistorted, center_, kWindow_px);
    // Who tells the pose by eye is some pixels off: colours are learned where edges lead from
    // there.
    Pose pose = filter_.to_object(center_);
    const Refiner::Result near_by = refiner_.refine(pose, pose, kMostReach_px, *appearance_);
    if (near_by.evidence() > refiner_.examine(pose, *appearance_).evidence() + kClearlyBetter) {
      pose = near_by.camera_from_object;
      center_ = filter_.to_center(pose);
    }
    refiner_.teach(pose, *appearance_);
    const Refiner::Result shown = refiner_.examine(pose, *appearance_);
    usual_support_ = std::max(shown.support, kFirstSupport);
    usual_fit_ = shown.fit;
    if (exact_) {
      exact_->draw(pose, workers_);
      const Refiner::Result there = refiner_.polish(
          shown, exact_->contour(), exact_->feigned_share(), Twist::Zero(), *appearance_);
      learn_shading(refiner_.shading_evidence(there.camera_from_object, exact_->contour(),
                                              Twist::Zero(), *appearance_));
    }
  }

  void preprocess(const cv::Mat& undistorted) override {
    image_ = undistorted;
    look(undistorted, expected_.camera_from_center, margin_px());
  }

  void estimate(TrackResult& result) override {
    const Pose last = center_;
    const Appearance& appearance = *appearance_;
    const Pose guess = filter_.to_object(expected_.camera_from_center);
    const double reach_px = std::clamp(deviation_px(), kLeastReach_px, kMostReach_px);
    Refiner::Result best = refiner_.refine(guess, guess, reach_px, appearance);
    const bool lost_sight = bad_frames() > 0;
    if (lost_sight || !confirmed_as_usual(best)) {
      // Too far off for edges; colours lead nearer.
      const Pose nearer = refiner_.approach(guess, appearance);
      const auto other = refiner_.refine(nearer, guess, reach_px, appearance);
      if (likelihood(other) > likelihood(best)) best = other;
      if (lost_sight || !confirmed_as_usual(best, kSecondAttempt)) {
        best = search_around(best, appearance);
      }
    }
    const auto draw = [&] {
      if (exact_) exact_->draw(best.camera_from_object, workers_);
    };
    if (const auto better = better_neighbour(best, appearance, draw)) {
      best = *better;
      draw();
    }
    if (!lost_sight) {
      usual_fit_ += (best.fit > usual_fit_ ? kFitRise : kFitFall) * (best.fit - usual_fit_);
      usual_support_ += (best.support > usual_support_ ? kSupportRise : kSupportFall) *
                        (best.support - usual_support_);
    }
    if (exact_) {
      const Twist blur = blur_of(best.camera_from_object);
      best = polisher_.polish(best, {*exact_, expected_, guess, blur, appearance});
    }
    result.camera_from_object = best.camera_from_object;
    result.camera_from_object.rotation =
        symmetry_.fold(best.camera_from_object.rotation, last.rotation);
    result.best_camera_from_object = result.camera_from_object;
    judge_and_learn(best, filter_.to_center(result.camera_from_object));
  }

  Judgement judge(const TrackResult& /*result*/) override {
    return end_frame(quality_, confirmation_);
  }

 private:
  static ScorerSetup quick_drawing_of(TrackerSetup setup, const UniversalTrackerOptions& options) {
    setup.mesh = simplified(std::move(setup.mesh), kDrawnTriangles);
    return drawing_of(setup, options);
  }

  bool supported_as_usual(const Refiner::Result& result, double demand = 1) const {
    return result.support >= demand * kSure * usual_support_;
  }

  bool confirmed_as_usual(const Refiner::Result& result, double demand = 1) const {
    return supported_as_usual(result, demand) &&
           likelihood(result) > usual_support_ + usual_fit_ - kPoorer;
  }

  /// Whether a search may end. What is usual says nothing of an object that was lost sight of.
  bool suffices(const Refiner::Result& result) const {
    if (bad_frames() == 0) return supported_as_usual(result, kWider);
    return confirms(confirmation_of(result.support, refiner_.chance(result.camera_from_object)));
  }

  /// Looks for a pose that the image confirms better than the refined one. Where even so there is
  /// none, less is usual from now on: something hides the object.
  Refiner::Result search_around(const Refiner::Result& refined, const Appearance& appearance) {
    const bool lost_sight = bad_frames() > 0;
    const bool near_by = !lost_sight && supported_as_usual(refined);
    const Refiner::Result best =
        near_by ? hop_on(refined, appearance) : search_wider_and_wider(refined, appearance);
    if (!lost_sight && likelihood(best) < likelihood(refined) + kGain) {
      usual_support_ = std::min(usual_support_, best.support);
      usual_fit_ = std::min(usual_fit_, best.fit);
    }
    return best;
  }

  /// Support is as usual, only edges are not quite where they should be, or the motion is strange:
  /// the truth is a basin or two away. Particles find no more there than hops, and take longer.
  Refiner::Result hop_on(const Refiner::Result& refined, const Appearance& appearance) {
    Refiner::Result best = refined;
    for (std::uint32_t pass = 0; pass < kPasses; ++pass) {
      best = search_.hop_from(best, expected_, appearance, search_key(pass), camera().fx_px);
      if (confirmed_as_usual(best)) break;
    }
    return best;
  }

  /// Support falls short, or the object was lost sight of: it may be anywhere around.
  Refiner::Result search_wider_and_wider(const Refiner::Result& refined,
                                         const Appearance& appearance) {
    detect_edges_around(image_, expected_.camera_from_center, searched_mm());
    region_.set_image(refiner_.picture(), appearance);
    const double weight = appearance.learned() ? kRegionWeight : 0.0;
    Refiner::Result best = refined;
    Expectation wider = expected_;
    for (std::uint32_t pass = 0; pass < kPasses; ++pass) {
      if (pass > 0 && suffices(best)) break;
      const Refiner::Result found =
          search_.run(wider, {appearance, weight}, search_key(pass), camera().fx_px);
      if (likelihood(found) > likelihood(best)) best = found;
      best = search_.hop_from(best, expected_, appearance, search_key(pass), camera().fx_px);
      wider.sigma *= 2.0;
    }
    return best;
  }

  RandomKey search_key(std::uint32_t pass) const {
    RandomKey random = key(0);
    random.frame = frame_number_ * kPasses + pass;
    return random;
  }

  /// A better pose near it, if there is one: edges side by side, such as the two of a cup's rim,
  /// make false bottoms. A false bottom stays from frame to frame, so that each frame looks along
  /// one motion only, unless there is no exact contour to tell it by. `meanwhile` is called on some
  /// thread.
  std::optional<Refiner::Result> better_neighbour(const Refiner::Result& refined,
                                                  const Appearance& appearance,
                                                  const std::function<void()>& meanwhile) {
    std::vector<Pose> starts;
    for (std::uint32_t motion = 0; motion < Neighbourhood::kMotions; ++motion) {
      if (exact_ && motion != frame_number_ % Neighbourhood::kMotions) continue;
      for (const Pose& start : neighbourhood_.beside(refined, motion)) starts.push_back(start);
    }
    std::vector<Refiner::Result> others(starts.size());
    Refiner::Result best;  // the refined one first, with as few points as the others
    workers_.each(others.size() + 2, 1, [&](std::size_t i) {
      if (i == 0) {
        meanwhile();  // it takes longest
      } else if (i == 1) {
        best = refiner_.examine(refined.camera_from_object, appearance, Refiner::Care::quick);
      } else {
        others[i - 2] = refiner_.refine(starts[i - 2], starts[i - 2], Neighbourhood::kReach_px,
                                        appearance, Refiner::Care::quick);
      }
    });
    const auto likely = [&](const Refiner::Result& result) {
      return result.fit - strangeness(result);
    };
    const Refiner::Result* better = nullptr;
    double most = likely(best);
    for (const Refiner::Result& other : others) {
      if (likely(other) <= most) continue;
      if (neighbourhood_.same_place(other.camera_from_object, refined.camera_from_object)) continue;
      most = likely(other);
      better = &other;
    }
    if (!better) return std::nullopt;
    best = refiner_.refine(better->camera_from_object, better->camera_from_object,
                           Neighbourhood::kReach_px, appearance);
    if (likely(best) <= likely(refined) + kNeighbourGain) return std::nullopt;
    return best;
  }

  /// What the image says of the frame's pose, `found` (camera_from_center), and what it teaches for
  /// the next ones.
  void judge_and_learn(const Refiner::Result& best, const Pose& found) {
    const Pose last = center_;
    const bool lost_sight = bad_frames() > 0;
    const Appearance& appearance = *appearance_;
    double chance = 0;
    Refiner::Colours seen;
    std::vector<MovedEdge> moved_edges;
    ShadingEvidence shading;
    const Twist motion = twist_between(last, found);
    const bool blur_turn = frame_number_ % kTellingFrames == kTellingFrames - 1;
    const bool tells_blur =
        exact_ && blur_turn &&
        displacement_mm(motion, mesh().radius_mm()) > kTellingMotion_px * mm_per_px(found);
    const bool tells_shading = exact_ && !blur_turn;
    workers_.each(tells_blur || tells_shading ? 3 : 2, 1, [&](std::size_t i) {
      if (i == 0) {
        chance = refiner_.chance(best.camera_from_object);
      } else if (i == 1) {
        seen = refiner_.colours(best.camera_from_object, appearance);
      } else if (tells_shading) {
        shading = refiner_.shading_evidence(best.camera_from_object, exact_->contour(),
                                            blur_of(best.camera_from_object), appearance);
      } else {
        moved_edges = refiner_.moved_edges(best.camera_from_object, motion, appearance);
      }
    });
    confirmation_ = confirmation_of(best.support, chance);
    uncertainty_.update(motion_.seen_sigma(), best.unseen,
                        kEdgeError_px * kEdgeError_px * best.error_px2);
    quality_ = confirmation_ * uncertainty_.probability_within(kRight_mm, kRight_deg * kDegree,
                                                               found.rotation * symmetry_.axis);
    const bool confirmed = confirms(confirmation_);
    if (!confirmed && lost_sight) {
      // Go on searching around the pose of the first bad frame.
      motion_.reset();
      return;
    }
    center_ = found;
    if (bad_frames() < 2) motion_.observe(last, center_);  // else it took several frames
    if (confirmed) {
      appearance_->learn(seen.object, seen.beside);
      if (!lost_sight) exposure_.observe(moved_edges);
      learn_shading(shading);
    }
  }

  void learn_shading(const ShadingEvidence& evidence) {
    shading_.observe(evidence);
    refiner_.set_shading_share(shading_.share());
  }

  /// How the object moved while the shutter was open, if it is at this pose now.
  Twist blur_of(const Pose& camera_from_object) const {
    if (bad_frames() > 0) return Twist::Zero();
    return exposure_.share() * twist_between(center_, filter_.to_center(camera_from_object));
  }

  double mm_per_px(const Pose& camera_from_center) const {
    return anneal6d::mm_per_px(camera_from_center, camera().fx_px);
  }

  double likelihood(const Refiner::Result& result) const {
    return search_.likelihood(result, expected_);
  }

  double strangeness(const Refiner::Result& result) const {
    return expected_.strangeness(filter_.to_center(result.camera_from_object));
  }

  /// Shows the surroundings of a pose to the refiner.
  void look(const cv::Mat& undistorted, const Pose& camera_from_center, double margin_px) {
    const int channels = undistorted.channels();
    if (!appearance_ || appearance_->channels() != channels) {
      appearance_.emplace(channels);
    }
    refiner_.set_image(undistorted, window(camera_from_center, mesh().radius_mm(), margin_px));
  }

  /// Around the object as expected, what is looked at.
  double margin_px() const { return kWindow_px + 3 * deviation_px(); }
  /// Of a sphere around the object, in which it is searched for.
  double searched_mm() const { return mesh().radius_mm() + 3 * expected_.sigma[5]; }

  /// How far the object's edges may be, in the image, from where they are expected.
  double deviation_px() const {
    return (expected_.sigma[5] + expected_.sigma[0] * mesh().radius_mm()) /
           mm_per_px(expected_.camera_from_center);
  }

  Symmetry symmetry_;
  std::shared_ptr<const ViewModel> views_;
  Refiner refiner_;
  RegionCue region_;
  PoseSearch search_;
  Neighbourhood neighbourhood_;
  Polisher polisher_;
  std::unique_ptr<ExactContour> exact_;  ///< null for very large models
  MotionModel motion_;
  PoseUncertainty uncertainty_;
  Exposure exposure_;
  ShadingShare shading_;
  std::optional<Appearance> appearance_;  ///< for as many channels as the frames have

  Expectation expected_;
  /// Of the last estimate: how far the image confirms it, and that times the chance that it did not
  /// move away unseen.
  double confirmation_ = 0, quality_ = 0;
  double usual_support_ = 0, usual_fit_ = 0;  ///< of estimates lately
  cv::Mat image_;
};

}  // namespace

std::unique_ptr<RigidObjectTracker> make_default_tracker(const TrackerSetup& setup,
                                                         const UniversalTrackerOptions& options) {
  return std::make_unique<DefaultTracker>(setup, options);
}

}  // namespace anneal6d
