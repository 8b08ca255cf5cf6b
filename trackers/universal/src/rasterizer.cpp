// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "rasterizer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "raster_kernels.h"

namespace anneal6d {
namespace {

/// A pixel coordinate as a whole number within a range that no image leaves.
int whole(float pixels) { return static_cast<int>(std::clamp(pixels, -1e6F, 1e6F)); }

/// Entries of a row of brightness with its margins: whole cache lines.
int row_stride_of(int width) {
  constexpr int kLine = LineArray<std::uint16_t>::kEntriesOfALine;
  return (width + kLine - 1) / kLine * kLine + 2 * kRowMargin;
}

}  // namespace

Rasterizer::Rasterizer(const RasterModel& model, const CameraModel& camera, const Shading& shading)
    : model_(model), camera_(camera), shading_(shading) {
  vertices_.resize(model.x.size());
  texture_points_.resize(model.u.size());
  camera_z_.resize(model.x.size());
  const auto width = static_cast<std::size_t>(camera.width_px);
  const auto height = static_cast<std::size_t>(camera.height_px);
  pixels_.resize((width + 15 + kPixelMargin) * (height + 1));  // a row may be filled with its next
  const auto row = static_cast<std::size_t>(row_stride_of(camera.width_px));
  rows_.resize(kBrightnessRows * row);
  gradients_.resize(3 * kGradientRows * row);
  bits_.resize((width / 64 + 2) * (height + 1));
  candidates_.resize(bits_.size());
}

Region Rasterizer::draw(const Pose& camera_from_object, int margin_px) {
  if (const auto job = set_up(camera_from_object, margin_px)) draw_triangles(*job);
  return region_;
}

std::optional<TriangleJob> Rasterizer::set_up(const Pose& camera_from_object, int margin_px) {
  region_ = {};
  if (!camera_from_object.is_finite()) return {};
  const Pose& pose = camera_from_object;
  const double center_z = (pose * model_.mesh->center_mm().cast<double>()).z();
  const double far_mm = 1.001 * (center_z + model_.mesh->radius_mm());
  if (!(far_mm > kNearPlane_mm) || far_mm > 1e7) return {};
  const double nearest_mm = 0.999 * (center_z - model_.mesh->radius_mm());
  const bool clip = nearest_mm < kNearPlane_mm;
  const double near_mm = clip ? kNearPlane_mm : nearest_mm;
  const auto inv_far = static_cast<float>(1.0 / far_mm);
  const auto depth_scale =
      static_cast<float>((kNearDepth - kFarDepth) / (1.0 / near_mm - 1.0 / far_mm));

  const Eigen::Vector3f to_light = pose.rotation.conjugate().cast<float>() * shading_.to_light;
  const Eigen::Vector3f eye_mm = pose.inverse().translation_mm.cast<float>();
  VertexJob vertices{.model = &model_,
                     .rotation = {},
                     .translation_mm = {},
                     .fx = static_cast<float>(camera_.fx_px),
                     .fy = static_cast<float>(camera_.fy_px),
                     .cx = static_cast<float>(camera_.cx_px),
                     .cy = static_cast<float>(camera_.cy_px),
                     .to_light = {to_light[0], to_light[1], to_light[2]},
                     .ambient = shading_.ambient,
                     .diffuse = shading_.diffuse,
                     .inv_far = inv_far,
                     .depth_scale = depth_scale,
                     .vertices = vertices_.data(),
                     .texture_points = texture_points_.data(),
                     .camera_z = camera_z_.data(),
                     .min_x = 0,
                     .max_x = 0,
                     .min_y = 0,
                     .max_y = 0};
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  for (int i = 0; i < 9; ++i) vertices.rotation[i] = static_cast<float>(rotation(i / 3, i % 3));
  for (int i = 0; i < 3; ++i)
    vertices.translation_mm[i] = static_cast<float>(pose.translation_mm[i]);
  project_vertices(vertices);

  // Where the object crosses the near plane, projected vertices bound nothing.
  int x0 = 0, y0 = 0, x1 = camera_.width_px, y1 = camera_.height_px;
  if (!clip) {
    x0 = std::max(x0, whole(std::floor(vertices.min_x)) - margin_px);
    y0 = std::max(y0, whole(std::floor(vertices.min_y)) - margin_px);
    x1 = std::min(x1, whole(std::ceil(vertices.max_x)) + 1 + margin_px);
    y1 = std::min(y1, whole(std::ceil(vertices.max_y)) + 1 + margin_px);
    if (x0 >= x1 || y0 >= y1) return {};
  }
  x0 &= ~7;  // edge bits are read by bytes
  region_ = {x0, y0, x1 - x0, y1 - y0};
  stride_ = (region_.width + 15) / 16 * 16 + kPixelMargin;

  const QuadTexture* texture = nullptr;
  if (!model_.textures.empty()) {
    texture = &model_.textures[static_cast<std::size_t>(
        model_.mesh->texture_level_for(camera_.fx_px / std::max(center_z, kNearPlane_mm)))];
  }
  return TriangleJob{.model = &model_,
                     .vertices = vertices_.data(),
                     .texture_points = texture_points_.data(),
                     .camera_z = camera_z_.data(),
                     .eye_mm = {eye_mm[0], eye_mm[1], eye_mm[2]},
                     .inv_far = inv_far,
                     .depth_scale = depth_scale,
                     .cx = vertices.cx,
                     .cy = vertices.cy,
                     .clip = clip,
                     .texture = texture,
                     .x0 = x0,
                     .y0 = y0,
                     .x1 = x1,
                     .y1 = y1,
                     .pixels = pixels_.data(),
                     .stride = stride_};
}

EdgeMatch Rasterizer::count_edges(const PackedEdges& frame_edges, const EdgeOptions& options) {
  const int width = region_.width, height = region_.height;
  const int words = (width + 63) / 64;
  const int radius = options.dilation_px;

  // Outside the image the border is repeated; outside the region there is background on both sides
  // of its border.
  const DrawnPicture picture{.pixels = pixels_.data(),
                             .stride = stride_,
                             .width = width,
                             .height = height,
                             .rows = rows_.data(),
                             .row_stride = row_stride_of(width)};
  if (options.op == EdgeOperator::canny) {
    find_canny_candidates({.picture = picture,
                           .low = *options.low_threshold,
                           .high = *options.threshold,
                           .gradients = gradients_.data(),
                           .candidates = candidates_.data(),
                           .strong = bits_.data()});
    grow_bits(bits_, candidates_, height, words);
  } else {
    find_edges({.picture = picture,
                .sobel = options.op == EdgeOperator::sobel,
                .threshold = *options.threshold,
                .bits = bits_.data()});
  }
  if (radius > 0) dilate_bits(bits_, widened_, width, height, words, radius);

  return count_edge_bits({.bits = bits_.data(),
                          .words = words,
                          .height = height,
                          .frame = frame_edges.row(region_.y) + region_.x / 8,
                          .frame_stride = 4 * frame_edges.words_a_row()});
}

Region Rasterizer::draw_images(const Pose& camera_from_object, int margin_px, cv::Mat& grey,
                               cv::Mat* depth_mm) {
  const auto job = set_up(camera_from_object, margin_px);
  if (!job) return region_;
  grey.create(region_.height, region_.width, CV_8UC1);
  draw_triangles(*job);
  PictureJob picture{.pixels = pixels_.data(),
                     .stride = stride_,
                     .width = region_.width,
                     .height = region_.height,
                     .inv_far = job->inv_far,
                     .depth_scale = job->depth_scale,
                     .grey = grey.ptr<std::uint8_t>(),
                     .grey_stride = static_cast<std::ptrdiff_t>(grey.step1()),
                     .depth_mm = nullptr,
                     .depth_stride = 0};
  if (depth_mm) {
    depth_mm->create(region_.height, region_.width, CV_32FC1);
    picture.depth_mm = depth_mm->ptr<float>();
    picture.depth_stride = static_cast<std::ptrdiff_t>(depth_mm->step1());
  }
  take_pictures(picture);
  return region_;
}

}  // namespace anneal6d
