// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "appearance.h"
#include "contour_match.h"
#include "twist.h"
#include "view_model.h"
#include "workers.h"

namespace anneal6d {

/// Sharpens a pose that is nearly right: Gauss-Newton on the distances, along the normals, from the
/// object's visible edges to the image's (Drummond and Cipolla, PAMI 2002), located between pixels,
/// chosen with the help of colours, and weighted against outliers. Several threads may refine poses
/// in one picture.
class Refiner {
 public:
  /// `views` and `workers`, which share the work on a frame, outlive the refiner.
  Refiner(const ViewModel& views, const CameraModel& camera, Workers& workers);

  /// The frame, CV_8UC1 or CV_8UC3, distortion removed; only `window` of it is looked at.
  void set_image(const cv::Mat& image, const cv::Rect& window);
  /// The window, blurred; empty if the window is outside the image.
  SmoothPicture picture() const { return {smooth_, origin_}; }

  struct Result {
    Pose camera_from_object;
    double support = 0;  ///< 0..1: share of the visible contour that the image confirms
    double fit = 0;      ///< 0..1: the same, of edges that are where they should be to half a pixel
    /// The two motions that the contour shows least, such as the turn of a cup or the tilt of a
    /// plate, where the pose was refined: twists about the centre (see twist.h) that move the
    /// contour's points by a pixel, root mean square.
    std::array<Twist, 2> weak_motions{Twist::Zero(), Twist::Zero()};
    /// What edges leave of a deviation from the pose, as a map of twists: about the identity along
    /// motions that the contour does not show, about zero along others.
    Eigen::Matrix<double, 6, 6> unseen = Eigen::Matrix<double, 6, 6>::Identity();
    /// Covariance of the pose, as a twist, if edges all over the contour are off by a pixel: large
    /// along motions that the contour shows only a little.
    Eigen::Matrix<double, 6, 6> error_px2 = Eigen::Matrix<double, 6, 6>::Zero();

    /// What tells the right pose from others that the image supports as well.
    double evidence() const { return support + fit; }
  };

  /// `quick`: fewer points and rounds, to tell good poses from bad ones.
  enum class Care { quick, full };

  /// Starts with a search range of `reach_px` and narrows it. What the edges leave open, such as
  /// the turn of a cup whose handle is hidden, is taken from the expected pose.
  Result refine(const Pose& start_camera_from_object, const Pose& expected_camera_from_object,
                double reach_px, const Appearance& appearance, Care care = Care::full) const;

  /// The same, quick, with the contour of `view`, drawn at a pose nearby, instead of those of the
  /// model's views; not examined.
  Pose refine_in(const ModelView& view, const Pose& start_camera_from_object, double reach_px,
                 const Appearance& appearance) const;

  /// Comes nearer to where colours that were learned put the object's outline: from farther than
  /// refine(), which edges of the background lead astray there, but not as close. The same pose if
  /// no colours were learned or too little outline is in sight.
  Pose approach(const Pose& start_camera_from_object, const Appearance& appearance) const;

  /// Points of a contour that polish() looks at, at most.
  static constexpr std::size_t kMostPolished = 360;

  /// Goes on from a refined pose with `view`, the contour as drawn there or a degree or so
  /// beside it. What the edges leave open stays as it is; for `feigned_share` see
  /// ContourMatch::expect. `blur`: the object's motion while the shutter is open.
  Result polish(const Result& refined, const ModelView& view, double feigned_share,
                const Twist& blur, const Appearance& appearance) const;

  /// How well the image confirms a pose.
  Result examine(const Pose& camera_from_object, const Appearance& appearance,
                 Care care = Care::full) const;
  /// The same with a contour that was drawn at the pose or nearby, or the first points of it.
  Result examine_in(const ModelView& view, const Pose& camera_from_object,
                    const Appearance& appearance, std::size_t most_points = kMostPolished) const;

  /// The share of the visible contour that would have an edge near it also where it does not
  /// belong, 0..1: in a cluttered image edges confirm little.
  double chance(const Pose& camera_from_object) const;

  /// How much of the drawing's shading there is, 0..1, see LineJob; first all of it.
  void set_shading_share(double share) { shading_share_ = share; }

  /// What the image says of it at a polished pose; arguments as of polish().
  ShadingEvidence shading_evidence(const Pose& camera_from_object, const ModelView& view,
                                   const Twist& blur, const Appearance& appearance) const;

  /// See ContourMatch::moved_edges.
  std::vector<MovedEdge> moved_edges(const Pose& camera_from_object, const Twist& motion,
                                     const Appearance& appearance) const;

  /// The colours on both sides of the silhouette, as bins of `appearance` to be learned.
  struct Colours {
    std::vector<std::uint16_t> object, beside;
  };
  Colours colours(const Pose& camera_from_object, const Appearance& appearance) const;

  /// Lets `appearance` learn them.
  void teach(const Pose& camera_from_object, Appearance& appearance) const {
    const Colours seen = colours(camera_from_object, appearance);
    appearance.learn(seen.object, seen.beside);
  }

 private:
  Pose to_center(const Pose& camera_from_object) const;
  ContourMatch match() const;
  /// Moves a pose to the edges with the contour of `view`, or, if that is null, of those nearest to
  /// it on its way.
  Pose follow(ContourMatch& contour, const ModelView* view, const Pose& start_camera_from_object,
              double reach_px, const Appearance& appearance, Care care) const;
  Result examine(ContourMatch& contour, const ModelView& view, const Pose& camera_from_object,
                 const Appearance& appearance, std::size_t most_points) const;

  const ViewModel& views_;
  CameraModel camera_;
  Workers& workers_;
  double shading_share_ = 1;
  cv::Mat smooth_;  ///< what is looked at of the frame, blurred; empty if that is nothing
  cv::Point origin_;
};

}  // namespace anneal6d
