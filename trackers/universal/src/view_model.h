// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "anneal6d/framework/edge_detector.h"
#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/shading.h"
#include "raster_model.h"
#include "vector_width.h"

namespace anneal6d {

/// A point where the object looks like an edge from one viewpoint.
struct ContourSample {
  Eigen::Vector3f object_mm;  ///< object frame
  /// Unit, object frame, square to the line of sight: across the edge; at silhouettes out of the
  /// object.
  Eigen::Vector3f normal;
  /// Of the surface along the line of sight: from a direction a little beside the viewpoint's the
  /// contour lies elsewhere on a round surface; 0 on sharp edges.
  float curve_mm = 0;
  /// How far, from the contour, there is nothing but object on the one side and nothing but
  /// background on the other. Of silhouettes; 0 elsewhere.
  float inside_mm = 0, outside_mm = 0;
  /// Where the edge appears in a blurred picture of the object before a black background, counted
  /// along the normal in pixels of that picture: edges beside it and shading shift it. Of
  /// silhouettes with none beside it: what shading does alone, without the steps of the pixels.
  float shift_px = 0;
  float trust = 1;  ///< 0..1: of its place
  bool silhouette = false;
  /// Of the texture's edges: 1 if the surface is brighter behind it, along the normal, -1 if it is
  /// darker; 0 where that depends on light or background.
  int polarity = 0;
};

/// What the object shows to one viewpoint. Both lists are shuffled: any first few entries are
/// spread over the whole object.
struct ModelView {
  static constexpr std::size_t kPadding = kLongestVector;  ///< floats

  std::vector<ContourSample> contour;
  /// Pixels of the edge image that the exact renderer makes of this view, as points of the object's
  /// frame, millimetres; padded with NaN to a multiple of kPadding.
  std::vector<float> edge_x, edge_y, edge_z;
  int edges = 0;      ///< points, without the padding
  float edge_px = 0;  ///< edge pixels that they stand for

  /// Pads the points that there are.
  void pad_edges() {
    edges = static_cast<int>(edge_x.size());
    const std::size_t padded = (edge_x.size() + kPadding - 1) / kPadding * kPadding;
    for (auto* values : {&edge_x, &edge_y, &edge_z}) {
      values->resize(padded, std::numeric_limits<float>::quiet_NaN());
    }
  }
};

/// The object from viewpoints all around it, made once: what is visible from where, so that nothing
/// needs to be drawn while tracking.
class ViewModel {
 public:
  static constexpr int kViews = 1500;          ///< about 5 degrees apart
  static constexpr double kDistance = 8.0;     ///< of the viewpoints, in radii of the object
  static constexpr double kRadius_px = 110.0;  ///< of the object in the pictures

  /// Draws all views with `threads` threads (0: all). `progress` is told the share done (0..1),
  /// from any thread, one call at a time; may be empty.
  ViewModel(const RasterModel& model, const EdgeOptions& edges, const Shading& shading, int threads,
            const std::function<void(double)>& progress);

  /// Takes views that were made before, kViews of them.
  ViewModel(const Eigen::Vector3d& center_mm, std::vector<ModelView> views);

  const std::vector<ModelView>& views() const { return views_; }
  /// Centre of the object's box, object frame.
  const Eigen::Vector3d& center_mm() const { return center_mm_; }
  /// Pixels a millimetre in the pictures, at the object's centre.
  static double px_per_mm(double radius_mm) { return kRadius_px / radius_mm; }

  /// The view whose direction is nearest to the one in which the camera is.
  const ModelView& seen_from(const Pose& camera_from_object) const;

  /// Unit vector, object frame, from the object to viewpoint `index`: a Fibonacci lattice.
  static Eigen::Vector3d direction(int index);

 private:
  void index_directions();

  static constexpr int kCells = 32;  ///< along the side of a face of the cube of directions
  Eigen::Vector3d center_mm_;
  std::vector<ModelView> views_;
  std::array<std::uint16_t, 6 * kCells * kCells> nearest_;
};

}  // namespace anneal6d
