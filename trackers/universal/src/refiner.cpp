// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "refiner.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "blur_kernels.h"
#include "contour_match.h"

namespace anneal6d {
namespace {

constexpr std::size_t kFewPoints = 100;
constexpr std::size_t kAllPoints = 240;
constexpr int kCoarseRounds = 2;  // with few points; quick refinements have no others
constexpr int kRounds = 3;
constexpr int kStepsPerRound = 3;
constexpr double kFinestReach_px = 2.5;
constexpr std::array kApproachReaches_px = {16.0, 10.0};
constexpr int kApproachSteps = 2;
constexpr std::size_t kFewestSilhouettes = 20;
// Polishing comes near with some of the points and ends with all of them, so narrow that edges
// which are off, as silhouettes are by shading, lose their say.
struct PolishingRound {
  std::size_t most_points;
  int observed_px;
  std::array<double, 2> reaches_px;
};
constexpr std::array kPolishing = {PolishingRound{kAllPoints, 2, {1.5, 0.75}},
                                   PolishingRound{Refiner::kMostPolished, 1, {0.75, 0.25}}};
// See ContourMatch::expect; contours of views are those of poses a few degrees away.
constexpr double kFeigned = 0.005;
constexpr double kSupport_px = 2.0;
constexpr double kFit_px = 0.5;
constexpr int kAside_px = 8, kAsideReach_px = 2;  // where edges are no edges of the contour
constexpr int kShadingReach_px = 1;
constexpr std::size_t kFewestPoints = 8;
constexpr int kColourGap_px = 2;  // blurred edges are of neither colour
constexpr int kColourReach_px = 12;

std::size_t points_of(Refiner::Care care) {
  return care == Refiner::Care::quick ? kFewPoints : kAllPoints;
}

}  // namespace

Refiner::Refiner(const ViewModel& views, const CameraModel& camera, Workers& workers)
    : views_(views), camera_(camera), workers_(workers) {}

void Refiner::set_image(const cv::Mat& image, const cv::Rect& window) {
  const cv::Rect seen = window & cv::Rect(0, 0, image.cols, image.rows);
  if (seen.width < 4 || seen.height < 4) {
    smooth_.release();
    return;
  }
  origin_ = seen.tl();
  smooth_.create(seen.size(), image.type());
  constexpr int kStrips = 2;
  workers_.each(kStrips, 1, [&](std::size_t strip) {
    const int from = seen.height * static_cast<int>(strip) / kStrips;
    const int to = seen.height * static_cast<int>(strip + 1) / kStrips;
    blur_rows(image, seen, from, to, smooth_);
  });
}

Pose Refiner::to_center(const Pose& camera_from_object) const {
  return with_origin_at(views_.center_mm(), camera_from_object);
}

ContourMatch Refiner::match() const {
  return {picture(), camera_, views_.center_mm(), shading_share_};
}

Pose Refiner::follow(ContourMatch& contour, const ModelView* view,
                     const Pose& start_camera_from_object, double reach_px,
                     const Appearance& appearance, Care care) const {
  Pose pose = start_camera_from_object;
  double reach = reach_px;
  const int rounds = care == Care::quick ? kCoarseRounds : kRounds;
  for (int round = 0; round < rounds && !smooth_.empty(); ++round) {
    const std::size_t seen = contour.project(pose, view ? *view : views_.seen_from(pose),
                                             round < kCoarseRounds ? kFewPoints : kAllPoints);
    if (seen < kFewestPoints) break;
    contour.observe(std::clamp(static_cast<int>(std::ceil(reach)), 2, LineJob::kMaxReach_px),
                    appearance);
    for (int i = 0; i < kStepsPerRound; ++i) contour.step(reach);
    pose = contour.camera_from_object();
    reach = std::max(kFinestReach_px, 0.5 * reach);
  }
  return pose;
}

Refiner::Result Refiner::refine(const Pose& start_camera_from_object,
                                const Pose& expected_camera_from_object, double reach_px,
                                const Appearance& appearance, Care care) const {
  ContourMatch contour = match();
  contour.expect(to_center(expected_camera_from_object), kFeigned);
  const Pose pose = follow(contour, nullptr, start_camera_from_object, reach_px, appearance, care);
  Result result = examine(contour, views_.seen_from(pose), pose, appearance, points_of(care));
  result.weak_motions = contour.weak_motions();
  result.unseen = contour.unseen();
  result.error_px2 = contour.error_px2();
  return result;
}

Pose Refiner::refine_in(const ModelView& view, const Pose& start_camera_from_object,
                        double reach_px, const Appearance& appearance) const {
  ContourMatch contour = match();
  contour.expect(to_center(start_camera_from_object), kFeigned);
  return follow(contour, &view, start_camera_from_object, reach_px, appearance, Care::quick);
}

Pose Refiner::approach(const Pose& start_camera_from_object, const Appearance& appearance) const {
  Pose pose = start_camera_from_object;
  if (smooth_.empty() || !appearance.learned()) return pose;
  ContourMatch contour = match();
  contour.expect(to_center(start_camera_from_object), kFeigned);
  for (const double reach_px : kApproachReaches_px) {
    contour.project(pose, views_.seen_from(pose), kFewPoints);
    if (contour.silhouettes() < kFewestSilhouettes) break;
    contour.observe_colours(static_cast<int>(reach_px), appearance);
    for (int i = 0; i < kApproachSteps; ++i) contour.step(reach_px);
    pose = contour.camera_from_object();
  }
  return pose;
}

Refiner::Result Refiner::polish(const Result& refined, const ModelView& view, double feigned_share,
                                const Twist& blur, const Appearance& appearance) const {
  if (smooth_.empty()) return refined;
  ContourMatch contour = match();
  contour.expect(to_center(refined.camera_from_object), feigned_share);
  Result polished = refined;
  for (const PolishingRound& round : kPolishing) {
    if (contour.project(polished.camera_from_object, view, round.most_points) < kFewestPoints) {
      return refined;
    }
    if (!blur.isZero()) contour.blur(blur);
    contour.observe(round.observed_px, appearance);
    for (const double reach_px : round.reaches_px) {
      for (int i = 0; i < kStepsPerRound; ++i) contour.step(reach_px);
    }
    polished.camera_from_object = contour.camera_from_object();
  }
  polished.unseen = contour.unseen();
  polished.error_px2 = contour.error_px2();
  return polished;
}

Refiner::Result Refiner::examine(const Pose& camera_from_object, const Appearance& appearance,
                                 Care care) const {
  ContourMatch contour = match();
  return examine(contour, views_.seen_from(camera_from_object), camera_from_object, appearance,
                 points_of(care));
}

Refiner::Result Refiner::examine_in(const ModelView& view, const Pose& camera_from_object,
                                    const Appearance& appearance, std::size_t most_points) const {
  ContourMatch contour = match();
  return examine(contour, view, camera_from_object, appearance, most_points);
}

Refiner::Result Refiner::examine(ContourMatch& contour, const ModelView& view,
                                 const Pose& camera_from_object, const Appearance& appearance,
                                 std::size_t most_points) const {
  Result result{.camera_from_object = camera_from_object};
  if (smooth_.empty()) return result;
  if (contour.project(camera_from_object, view, most_points) < kFewestPoints) return result;
  const ContourMatch::Confirmation confirmed = contour.confirm(kSupport_px, kFit_px, appearance);
  result.support = confirmed.support;
  result.fit = confirmed.fit;
  return result;
}

double Refiner::chance(const Pose& camera_from_object) const {
  if (smooth_.empty()) return 0;
  ContourMatch contour = match();
  contour.project(camera_from_object, views_.seen_from(camera_from_object), kAllPoints);
  return contour.edges_beside(kAside_px - kAsideReach_px, kAside_px + kAsideReach_px);
}

ShadingEvidence Refiner::shading_evidence(const Pose& camera_from_object, const ModelView& view,
                                          const Twist& blur, const Appearance& appearance) const {
  if (smooth_.empty()) return {};
  ContourMatch contour = match();
  if (contour.project(camera_from_object, view, kMostPolished) < kFewestPoints) return {};
  if (!blur.isZero()) contour.blur(blur);
  return contour.shading_evidence(kShadingReach_px, appearance);
}

std::vector<MovedEdge> Refiner::moved_edges(const Pose& camera_from_object, const Twist& motion,
                                            const Appearance& appearance) const {
  if (smooth_.empty()) return {};
  ContourMatch contour = match();
  contour.project(camera_from_object, views_.seen_from(camera_from_object), kFewPoints);
  return contour.moved_edges(motion, appearance);
}

Refiner::Colours Refiner::colours(const Pose& camera_from_object,
                                  const Appearance& appearance) const {
  Colours colours;
  if (smooth_.empty()) return colours;
  ContourMatch contour = match();
  contour.project(camera_from_object, views_.seen_from(camera_from_object), kAllPoints);
  const ProjectedContour& points = contour.points();
  const auto collect = [&](std::size_t i, int from, int to, std::vector<std::uint16_t>& bins) {
    for (int along = from; along <= to; ++along) {
      const auto distance = static_cast<float>(along);
      const int x = cvRound(points.image_x[i] + distance * points.normal_x[i]);
      const int y = cvRound(points.image_y[i] + distance * points.normal_y[i]);
      if (x < 0 || y < 0 || x >= smooth_.cols || y >= smooth_.rows) continue;
      bins.push_back(appearance.bin(smooth_.ptr<std::uint8_t>(y) + x * smooth_.channels()));
    }
  };
  for (std::size_t i = 0; i < contour.size(); ++i) {
    if (points.inside_px[i] < 0) continue;  // no silhouette
    const int inside = std::min(static_cast<int>(points.inside_px[i]), kColourReach_px);
    const int outside = std::min(static_cast<int>(points.outside_px[i]), kColourReach_px);
    collect(i, -inside, -kColourGap_px, colours.object);
    collect(i, kColourGap_px, outside, colours.beside);
  }
  return colours;
}

}  // namespace anneal6d
