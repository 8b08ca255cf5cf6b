// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "appearance.h"
#include "edge_line.h"
#include "twist.h"
#include "view_model.h"

namespace anneal6d {

/// Sharpens a pose that is nearly right: Gauss-Newton on the distances, along the normals, from the
/// object's visible edges to the image's (Drummond and Cipolla, PAMI 2002), located between pixels,
/// chosen with the help of colours, and weighted against outliers.
class Refiner {
 public:
  /// `views` outlive the refiner.
  Refiner(const ViewModel& views, const CameraModel& camera);

  /// The frame, CV_8UC1 or CV_8UC3, distortion removed; only `window` of it is looked at.
  void set_image(const cv::Mat& image, const cv::Rect& window);
  /// The window, blurred; empty if the window is outside the image.
  SmoothPicture picture() const { return {smooth_, window_.tl()}; }

  struct Result {
    Pose camera_from_object;
    double support = 0;  ///< 0..1: share of the visible contour that the image confirms
    double fit = 0;      ///< 0..1: the same, of edges that are where they should be to half a pixel

    /// What tells the right pose from others that the image supports as well.
    double evidence() const { return support + fit; }
  };

  /// `quick`: fewer points and rounds, to tell good poses from bad ones.
  enum class Care { quick, full };

  /// Starts with a search range of `reach_px` and narrows it. What the edges leave open, such as
  /// the turn of a cup whose handle is hidden, is taken from the expected pose.
  Result refine(const Pose& start_camera_from_object, const Pose& expected_camera_from_object,
                double reach_px, const Appearance& appearance, Care care = Care::full);

  /// Goes on from a refined pose with `view`, the contour exactly as at that pose.
  Pose polish(const Pose& refined_camera_from_object, const Pose& expected_camera_from_object,
              const ModelView& view, const Appearance& appearance);

  /// The two motions that the contour shows least, such as the turn of a cup or the tilt of a
  /// plate, at the last refined pose: twists about the centre (see twist.h) that move the contour's
  /// points by a pixel, root mean square.
  const std::array<Twist, 2>& weak_motions() const { return weak_motions_; }

  /// How well the image confirms a pose.
  Result examine(const Pose& camera_from_object, const Appearance& appearance,
                 Care care = Care::full);

  /// The share of the visible contour that would have an edge near it also where it does not
  /// belong, 0..1: in a cluttered image edges confirm little.
  double chance(const Pose& camera_from_object);

  /// Teaches the colours on both sides of the silhouette.
  void teach(const Pose& camera_from_object, Appearance& appearance);

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  static constexpr int kCandidates = 3;
  /// A visible contour point and what the image shows around it.
  struct Target {
    Eigen::Vector3d object_mm;
    Eigen::Vector2d image_px, normal;
    double shift_px, trust;
    float inside_px, outside_px;
    bool silhouette;
    int polarity;
    std::array<EdgeLine::Edge, kCandidates> edges;
    int edge_count = 0;
  };

  void project(const Pose& camera_from_object, const ModelView& view, std::size_t most_points);
  void observe(int reach_px, const Appearance& appearance);
  /// One Gauss-Newton step on the observations.
  void step(Pose& camera_from_object, double reach_px);

  /// The step from `here`, with what the edges cannot see left to the expected pose.
  Twist solve(const Pose& here, const Matrix6& normal_matrix, const Twist& right_side,
              const Twist& whole_motion, double whole_weight);

  Pose to_center(const Pose& camera_from_object) const;

  const ViewModel& views_;
  CameraModel camera_;
  cv::Mat smooth_;  ///< the frame in `window_`, blurred
  cv::Rect window_;
  std::vector<Target> targets_;
  std::array<Twist, 2> weak_motions_{Twist::Zero(), Twist::Zero()};
  std::vector<std::uint16_t> object_bins_, beside_bins_;
  Pose expected_center_;  ///< camera_from_center
};

}  // namespace anneal6d
