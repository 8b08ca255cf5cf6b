// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "contour.h"

#include <hwy/cache_control.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/shading.h"
#include "mesh_sides.h"
#include "ridge.h"
#include "ridge_kernels.h"

namespace anneal6d {
namespace {

const double kBentCosine = std::cos(8.0 * (std::numbers::pi / 180.0));
constexpr float kVisibleDepth = 0.01F;     // of the diameter: tolerance of the hidden-point test
constexpr float kSilhouetteDepth = 0.02F;  // of the diameter: a silhouette has at least this behind
constexpr float kSilhouetteProbe_px = 0.75F;
constexpr float kClearHeight_mm = 1e-3F;  // of the camera above a triangle, beyond rounding
constexpr std::uint8_t kEitherSide = 3;
// Edges between these distances disturb each other; nearer ones are parts of one zigzag.
constexpr double kCrowdedFrom_px = 1.3;
constexpr double kCrowdedTo_px = 4.0;
constexpr std::size_t kPrefetched = 6;  // mesh edges ahead
constexpr int kBendApart_px = 3;        // from edges of the mesh
constexpr int kTextureGradient = 30;    // Sobel response of a texture edge worth following

/// The farthest of a pixel of the region, not on its border, and its eight neighbours.
float farthest_around(const cv::Mat& depth_mm, int x, int y) {
  float farthest_mm = 0.0F;
  for (int row = y - 1; row <= y + 1; ++row) {
    const auto* const here = depth_mm.ptr<float>(row) + x;
    farthest_mm = std::max({farthest_mm, here[-1], here[0], here[1]});
  }
  return farthest_mm;
}

/// Whether the surface around a pixel ends or bends by more than `tolerance_mm`.
bool near_depth_edge(const cv::Mat& depth_mm, int x, int y, double tolerance_mm) {
  const float here = depth_mm.at<float>(y, x);
  for (const auto& [dx, dy] : {std::pair{2, 0}, {0, 2}, {2, 2}, {2, -2}}) {
    const float before = depth_mm.at<float>(y - dy, x - dx);
    const float after = depth_mm.at<float>(y + dy, x + dx);
    if (here == 0.0F || before == 0.0F || after == 0.0F) return true;
    if (std::abs(before + after - 2 * here) > tolerance_mm) return true;
  }
  return false;
}

bool inside_image(const Eigen::Vector2d& p, const CameraModel& camera) {
  return p.x() >= 1 && p.y() >= 1 && p.x() <= camera.width_px - 2 && p.y() <= camera.height_px - 2;
}

}  // namespace

ContourExtractor::ContourExtractor(const TriangleMesh& mesh)
    : edges_(mesh_edges(mesh)), diameter_mm_(mesh.diameter_mm()) {
  bent_ = std::any_of(edges_.begin(), edges_.end(), [](const MeshEdge& edge) {
    return !edge.border && !edge.crease && edge.normal_a.dot(edge.normal_b) < kBentCosine;
  });
  const auto triangles = mesh.triangles();
  planes_.resize(static_cast<Eigen::Index>(triangles.size()), 4);
  for (Eigen::Index i = 0; i < planes_.rows(); ++i) {
    const Triangle& triangle = triangles[static_cast<std::size_t>(i)];
    const Eigen::Vector3d normal = normal_of(mesh, triangle);
    const Eigen::Vector3d on_it_mm = mesh.vertices()[triangle[0]].position_mm.cast<double>();
    planes_.row(i) << normal.transpose().cast<float>(), static_cast<float>(-normal.dot(on_it_mm));
  }
  const auto count = static_cast<std::uint32_t>(triangles.size());
  sides_.assign(2 * triangles.size() + 1, kEitherSide);
  for (const MeshEdge& edge : edges_) {
    if (edge.border || edge.crease) {
      beside_.push_back({2 * count, 2 * count});
    } else {
      beside_.push_back({edge.triangle_a, edge.triangle_b + (edge.turned ? count : 0)});
    }
  }
}

void ContourExtractor::Cells::clear(const Region& region, double spacing_px) {
  per_px_ = static_cast<float>(1.0 / spacing_px);
  columns_ = static_cast<int>(region.width / spacing_px) + 1;
  rows_ = static_cast<int>(region.height / spacing_px) + 1;
  taken_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
}

std::uint8_t* ContourExtractor::Cells::at(float x, float y) {
  const int column = static_cast<int>(x * per_px_), row = static_cast<int>(y * per_px_);
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return nullptr;
  return &taken_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)];
}

bool ContourExtractor::Cells::claim(float x, float y) {
  std::uint8_t* const cell = at(x, y);
  if (!cell || *cell) return false;
  *cell = 1;
  return true;
}

void ContourExtractor::extract(const View& view, double spacing_px, bool texture_edges,
                               Workers& workers, std::vector<ContourPoint>& points) {
  points.clear();
  cells_.clear(view.region, spacing_px);
  const Pose& pose = view.camera_from_object;
  if (!picked_at_ || picked_at_->rotation.coeffs() != pose.rotation.coeffs() ||
      picked_at_->translation_mm != pose.translation_mm) {
    pick_edges(pose);
  }
  const std::vector<SurfaceBends::Bend>* bends = nullptr;
  workers.each(3, 1, [&](std::size_t part) {
    if (part == 0) {
      add_mesh_edges(view, points);
    } else if (part == 1 && bent_) {
      bends = &bends_.find(view.depth_mm, {view.region.x, view.region.y}, view.camera,
                           kSilhouetteDepth * diameter_mm_);
    } else if (part == 2 && texture_edges) {
      cv::Sobel(view.grey, along_x_, CV_16S, 1, 0);
      cv::Sobel(view.grey, along_y_, CV_16S, 0, 1);
    }
  });
  // Where edges are of several kinds, the first to come counts.
  if (texture_edges) add_texture_edges(view, points);
  if (bends) add_bends(view, *bends, points);
}

void ContourExtractor::pick_edges(const Pose& camera_from_object) {
  picked_at_ = camera_from_object;
  object_from_camera_ = camera_from_object.inverse();
  const Eigen::Vector4f camera = object_from_camera_.translation_mm.homogeneous().cast<float>();
  heights_.noalias() = planes_ * camera;
  const auto count = static_cast<std::size_t>(heights_.size());
  for (std::size_t i = 0; i < count; ++i) {
    const float height = heights_[static_cast<Eigen::Index>(i)];
    const int may_be_before = height > -kClearHeight_mm, may_be_behind = height < kClearHeight_mm;
    sides_[i] = static_cast<std::uint8_t>(may_be_before | may_be_behind << 1);
    sides_[count + i] = static_cast<std::uint8_t>(may_be_behind | may_be_before << 1);
  }
  // Most edges lie between triangles that are both in front of the camera, or both turned away. No
  // branches, which would be mispredicted.
  picked_.resize(edges_.size());
  std::size_t picked = 0;
  for (std::size_t i = 0; i < beside_.size(); ++i) {
    picked_[picked] = static_cast<std::uint32_t>(i);
    picked += (sides_[beside_[i][0]] | sides_[beside_[i][1]]) == kEitherSide;
  }
  picked_.resize(picked);
}

void ContourExtractor::add_mesh_edges(const View& view, std::vector<ContourPoint>& points) {
  drawn_.create(view.region.height, view.region.width, CV_8UC1);
  drawn_.setTo(0);
  const Eigen::Matrix3f rotation =
      view.camera_from_object.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f camera_in_object_mm = object_from_camera_.translation_mm.cast<float>();
  for (std::size_t i = 0; i < picked_.size(); ++i) {
    // They lie so far apart in memory that the processor does not foresee them.
    hwy::Prefetch(&edges_[picked_[std::min(i + kPrefetched, picked_.size() - 1)]]);
    add_mesh_edge(edges_[picked_[i]], view, rotation, camera_in_object_mm, points);
  }
  for (ContourPoint& point : points) point.crowded = is_crowded(point, view);
}

bool ContourExtractor::is_crowded(const ContourPoint& point, const View& view) const {
  const Eigen::Vector2d image_px = view.camera.project(view.camera_from_object * point.object_mm) -
                                   Eigen::Vector2d(view.region.x, view.region.y);
  for (double distance = kCrowdedFrom_px; distance <= kCrowdedTo_px; distance += 0.45) {
    for (const double side : {-distance, distance}) {
      const Eigen::Vector2d p = image_px + side * point.normal;
      const int x = cvRound(p.x()), y = cvRound(p.y());
      if (x < 0 || y < 0 || x >= drawn_.cols || y >= drawn_.rows) continue;
      if (drawn_.at<std::uint8_t>(y, x)) return true;
    }
  }
  return false;
}

void ContourExtractor::add_mesh_edge(const MeshEdge& edge, const View& view,
                                     const Eigen::Matrix3f& rotation,
                                     const Eigen::Vector3f& camera_in_object_mm,
                                     std::vector<ContourPoint>& points) {
  const Eigen::Vector3f to_camera = camera_in_object_mm - edge.from_mm;
  const float facing_a = edge.normal_a.dot(to_camera), facing_b = edge.normal_b.dot(to_camera);
  const bool silhouette = edge.border || facing_a * facing_b <= 0;
  if (!silhouette && !edge.crease) return;

  const Eigen::Vector3f t = view.camera_from_object.translation_mm.cast<float>();
  const Eigen::Vector3f from = rotation * edge.from_mm + t, to = rotation * edge.to_mm + t;
  if (from.z() < kNearPlane_mm || to.z() < kNearPlane_mm) return;
  // From here on in pixels from the region's first.
  const auto fx = static_cast<float>(view.camera.fx_px), fy = static_cast<float>(view.camera.fy_px);
  const Eigen::Vector2f center(static_cast<float>(view.camera.cx_px - view.region.x),
                               static_cast<float>(view.camera.cy_px - view.region.y));
  const float from_inverse = 1 / from.z(), to_inverse = 1 / to.z();
  const Eigen::Vector2f from_px = {from.x() * fx * from_inverse, from.y() * fy * from_inverse};
  const Eigen::Vector2f to_px = {to.x() * fx * to_inverse, to.y() * fy * to_inverse};
  const Eigen::Vector2f along_px = to_px - from_px;

  Eigen::Vector2f normal(-along_px.y(), along_px.x());
  const float length_px = normal.norm();
  if (edge.smooth && silhouette) {
    // The contour of a smooth surface: its tangent plane holds the camera's centre, and the edge of
    // the mesh zigzags around it. A plane with normal n through the centre is the image line K^-T
    // n.
    const Eigen::Vector3f n =
        rotation * (std::abs(facing_b) * edge.normal_a + std::abs(facing_a) * edge.normal_b);
    normal = {n.x() / fx, n.y() / fy};
  }
  if (!(normal.squaredNorm() > 1e-24F)) return;
  normal.normalize();

  const bool round = silhouette && !edge.crease && !edge.border;
  const auto diameter_mm = static_cast<float>(diameter_mm_);
  // Beside the contour of a round surface the surface falls towards the camera: a sphere of radius
  // r by sqrt(2 r d) at a distance d.
  const float mm_per_px = std::max(from.z(), to.z()) / fx;
  const float fall_mm = round ? std::sqrt(diameter_mm * kSilhouetteProbe_px * mm_per_px) : 0.0F;
  const float in_front_mm = std::max(kVisibleDepth * diameter_mm, fall_mm);
  const float behind_mm = kSilhouetteDepth * diameter_mm;
  const int steps = std::max(1, cvRound(length_px));
  if (steps > 4 * (view.camera.width_px + view.camera.height_px)) return;  // touches the camera
  const float step = 1 / static_cast<float>(steps);
  for (int i = 0; i < steps; ++i) {
    // Even steps in the image are uneven in space: interpolate by inverse depth.
    const float s = (static_cast<float>(i) + 0.5F) * step;
    const float weight_from = (1 - s) * from_inverse, weight_to = s * to_inverse;
    const float z_mm = 1 / (weight_from + weight_to);
    const Eigen::Vector2f at_px = center + from_px + s * along_px;
    const int x = cvRound(at_px.x()), y = cvRound(at_px.y());
    if (x < 1 || y < 1 || x > view.region.width - 2 || y > view.region.height - 2) continue;
    // Without branches, which could not be foreseen.
    const bool hidden = farthest_around(view.depth_mm, x, y) < z_mm - in_front_mm;
    bool stands_out = !round;
    for (const float side : {-kSilhouetteProbe_px, kSilhouetteProbe_px}) {
      const Eigen::Vector2f probe = at_px + side * normal;  // not outside the picture
      const float there_mm = view.depth_mm.at<float>(cvRound(probe.y()), cvRound(probe.x()));
      stands_out |= (there_mm == 0.0F) | (there_mm > z_mm + behind_mm);
    }
    if (hidden | !stands_out) continue;
    drawn_.at<std::uint8_t>(y, x) = 1;
    if (!cells_.claim(at_px.x(), at_px.y())) continue;
    const Eigen::Vector3f place_mm = (weight_from * edge.from_mm + weight_to * edge.to_mm) * z_mm;
    points.push_back({place_mm.cast<double>(), normal.cast<double>().normalized(), false});
  }
}

void ContourExtractor::add_surface_point(const View& view, const Eigen::Vector2d& image_px,
                                         double z_mm, ContourPoint point,
                                         std::vector<ContourPoint>& points) {
  if (!inside_image(image_px, view.camera)) return;
  if (!cells_.claim(static_cast<float>(image_px.x() - view.region.x),
                    static_cast<float>(image_px.y() - view.region.y))) {
    return;
  }
  const CameraModel& camera = view.camera;
  const Eigen::Vector3d camera_mm((image_px.x() - camera.cx_px) / camera.fx_px * z_mm,
                                  (image_px.y() - camera.cy_px) / camera.fy_px * z_mm, z_mm);
  point.object_mm = object_from_camera_ * camera_mm;
  points.push_back(point);
}

void ContourExtractor::add_bends(const View& view, const std::vector<SurfaceBends::Bend>& bends,
                                 std::vector<ContourPoint>& points) {
  for (const SurfaceBends::Bend& bend : bends) {
    const int x = cvRound(bend.place_px.x());
    const int y = cvRound(bend.place_px.y());
    const cv::Rect around(x - kBendApart_px, y - kBendApart_px, 2 * kBendApart_px + 1,
                          2 * kBendApart_px + 1);
    // A crease of the mesh is there already.
    if (cv::countNonZero(drawn_(around & cv::Rect({}, drawn_.size()))) > 0) continue;
    add_surface_point(view, bend.place_px + Eigen::Vector2d(view.region.x, view.region.y),
                      view.depth_mm.at<float>(y, x),
                      {.object_mm = {}, .normal = bend.across, .bend = true}, points);
  }
}

void ContourExtractor::add_texture_edges(const View& view, std::vector<ContourPoint>& points) {
  squared_.create(along_x_.size(), CV_32SC1);
  places_.resize(along_x_.total());
  const auto stride = static_cast<std::ptrdiff_t>(squared_.step1());
  const std::size_t count = find_ridges({.along_x = along_x_.ptr<short>(),
                                         .along_y = along_y_.ptr<short>(),
                                         .stride = stride,
                                         .columns = along_x_.cols,
                                         .rows = along_x_.rows,
                                         .margin = 2,
                                         .least = kTextureGradient * kTextureGradient,
                                         .squared = squared_.ptr<int>(),
                                         .places = places_.data()});
  for (std::size_t i = 0; i < count; ++i) {
    const auto columns = static_cast<std::uint32_t>(along_x_.cols);
    const int x = static_cast<int>(places_[i] % columns);
    const int y = static_cast<int>(places_[i] / columns);
    const std::uint8_t* const cell = cells_.at(static_cast<float>(x), static_cast<float>(y));
    if (cell && *cell) continue;
    // Next to a depth edge the picture shows the silhouette, which the mesh gives better.
    if (near_depth_edge(view.depth_mm, x, y, kSilhouetteDepth * diameter_mm_)) continue;
    const Eigen::Vector2d gradient(along_x_.at<short>(y, x), along_y_.at<short>(y, x));
    // The ridge along the stronger axis, and its place between pixels.
    const int sx = std::abs(gradient.x()) >= std::abs(gradient.y()) ? 1 : 0, sy = 1 - sx;
    const int* const squared = squared_.ptr<int>(y) + x;
    const std::ptrdiff_t next = sx ? 1 : stride;
    const double before = std::sqrt(squared[-next]), after = std::sqrt(squared[next]);
    const double here = std::sqrt(*squared);
    const double offset = ridge_offset(before, here, after);
    const Eigen::Vector2d image_px(view.region.x + x + sx * offset,
                                   view.region.y + y + sy * offset);
    add_surface_point(view, image_px, view.depth_mm.at<float>(y, x),
                      {.object_mm = {}, .normal = gradient / here, .texture = true}, points);
  }
}

}  // namespace anneal6d
