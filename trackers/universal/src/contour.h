// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "anneal6d/framework/camera_model.h"
#include "anneal6d/framework/pose.h"
#include "anneal6d/framework/triangle_mesh.h"
#include "mesh_edges.h"
#include "rasterizer.h"
#include "surface_bends.h"
#include "workers.h"

namespace anneal6d {

/// A point of the object that looks like an edge from where the camera is.
struct ContourPoint {
  Eigen::Vector3d object_mm;  ///< object frame
  Eigen::Vector2d normal;     ///< unit, across the edge, image
  /// Another edge runs beside this one so closely that the image blurs both together, as at the rim
  /// of a cup: the place of either is uncertain.
  bool crowded = false;
  /// Of the texture: the surface gets brighter along the normal under any light.
  bool texture = false;
  /// Where the surface bends: the image has its edge about here, depending on the light.
  bool bend = false;
};

/// Finds the edges of a mesh that a camera sees under any light: silhouettes and creases, straight
/// from the geometry, so that their place in the image is exact, sharp bends of the surface, and,
/// for objects with a pattern, the edges of the rendered picture. The mesh outlives it.
class ContourExtractor {
 public:
  explicit ContourExtractor(const TriangleMesh& mesh);

  struct View {
    Pose camera_from_object;
    const CameraModel& camera;
    Region region;        ///< of the two pictures
    const cv::Mat& grey;  ///< as of Rasterizer::draw_images
    const cv::Mat& depth_mm;
  };

  /// Picks the edges of the mesh that may be part of the contour at a pose. Needs no picture, so
  /// that it can be done beside drawing; else extract() does it.
  void pick_edges(const Pose& camera_from_object);

  /// Replaces `points` by visible ones, about one in `spacing_px` pixels along each edge.
  /// `texture_edges`: also where the rendered brightness jumps.
  void extract(const View& view, double spacing_px, bool texture_edges, Workers& workers,
               std::vector<ContourPoint>& points);

 private:
  void add_mesh_edges(const View& view, std::vector<ContourPoint>& points);
  void add_mesh_edge(const MeshEdge& edge, const View& view, const Eigen::Matrix3f& rotation,
                     const Eigen::Vector3f& camera_in_object_mm, std::vector<ContourPoint>& points);
  /// Places `point` where the surface, `z_mm` away, appears at `image_px`, unless another point is
  /// near.
  void add_surface_point(const View& view, const Eigen::Vector2d& image_px, double z_mm,
                         ContourPoint point, std::vector<ContourPoint>& points);
  void add_bends(const View& view, const std::vector<SurfaceBends::Bend>& bends,
                 std::vector<ContourPoint>& points);
  /// Takes the gradients of the view's brightness.
  void add_texture_edges(const View& view, std::vector<ContourPoint>& points);
  bool is_crowded(const ContourPoint& point, const View& view) const;

  /// Where points were placed already: squares of the region as wide as the points' spacing.
  class Cells {
   public:
    void clear(const Region& region, double spacing_px);
    /// Of a place, pixels from the region's first; null if there is none.
    std::uint8_t* at(float x, float y);
    /// Whether a point may be placed there, and no other from now on.
    bool claim(float x, float y);

   private:
    float per_px_ = 1;
    int columns_ = 0, rows_ = 0;
    std::vector<std::uint8_t> taken_;
  };

  std::vector<MeshEdge> edges_;
  /// The planes of the triangles: products with a point in homogeneous coordinates are its heights
  /// above them, mm.
  Eigen::Matrix<float, Eigen::Dynamic, 4> planes_;
  /// Of each edge the entries of `sides_` on both sides of it.
  std::vector<std::array<std::uint32_t, 2>> beside_;
  std::optional<Pose> picked_at_;  ///< camera_from_object
  Pose object_from_camera_;        ///< there
  Eigen::VectorXf heights_;        ///< of the camera
  /// On which sides of the triangles the camera may be: 1 before it, 2 behind it, 3 either. Then
  /// the same of triangles wound the other way, and last, for creases and borders, which are seen
  /// from anywhere, 3.
  std::vector<std::uint8_t> sides_;
  std::vector<std::uint32_t> picked_;  ///< edges that may be part of the contour
  double diameter_mm_;
  bool bent_ = false;  ///< the surface has bends that are no creases
  Cells cells_;
  cv::Mat drawn_;              ///< pixels of the region that visible edges of the mesh cross
  cv::Mat along_x_, along_y_;  ///< gradients of the brightness
  cv::Mat squared_;            ///< and their squared lengths
  std::vector<std::uint32_t> places_;  ///< see RidgeJob
  SurfaceBends bends_;
};

}  // namespace anneal6d
