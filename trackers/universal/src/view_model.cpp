// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "view_model.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "view_painter.h"

namespace anneal6d {
namespace {

constexpr std::size_t kViewsPerTask = 8;

}  // namespace

ViewModel::ViewModel(const RasterModel& model, const EdgeOptions& edges, const Shading& shading,
                     int threads, const std::function<void(double)>& progress)
    : center_mm_(model.mesh->center_mm().cast<double>()), views_(kViews) {
  const ViewPainter prototype(model, edges, shading, view_camera());
  tbb::enumerable_thread_specific<ViewPainter> painters([&] { return prototype; });
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  std::mutex reporting;
  std::size_t done = 0;
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, views_.size(), kViewsPerTask), [&](const auto& range) {
          ViewPainter& painter = painters.local();
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            views_[i] =
                painter.paint(direction(static_cast<int>(i)), static_cast<std::uint32_t>(i));
          }
          const std::scoped_lock lock(reporting);
          done += range.end() - range.begin();
          if (progress) progress(static_cast<double>(done) / static_cast<double>(views_.size()));
        });
  });
  index_directions();
}

ViewModel::ViewModel(const Eigen::Vector3d& center_mm, std::vector<ModelView> views)
    : center_mm_(center_mm), views_(std::move(views)) {
  index_directions();
}

Eigen::Vector3d ViewModel::direction(int index) {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double z = 1.0 - (2.0 * index + 1.0) / kViews;
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(golden_angle * index), radius * std::sin(golden_angle * index), z};
}

void ViewModel::index_directions() {
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < kViews; ++i) directions.push_back(direction(i));
  std::size_t cell = 0;
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < kCells; ++row) {
      for (int column = 0; column < kCells; ++column) {
        const int axis = face / 2;
        Eigen::Vector3d middle;
        middle[axis] = face % 2 ? -1.0 : 1.0;
        middle[(axis + 1) % 3] = (2.0 * column + 1.0) / kCells - 1.0;
        middle[(axis + 2) % 3] = (2.0 * row + 1.0) / kCells - 1.0;
        const auto nearest = std::max_element(
            directions.begin(), directions.end(),
            [&](const auto& a, const auto& b) { return a.dot(middle) < b.dot(middle); });
        nearest_[cell++] = static_cast<std::uint16_t>(nearest - directions.begin());
      }
    }
  }
}

const ModelView& ViewModel::seen_from(const Pose& camera_from_object) const {
  const Eigen::Vector3d to_camera =
      camera_from_object.rotation.conjugate() * -(camera_from_object * center_mm_);
  int axis = 0;
  const double longest = to_camera.cwiseAbs().maxCoeff(&axis);
  if (!(longest > 0)) return views_.front();  // the camera is in the object's centre
  const auto cell_of = [&](int coordinate) {
    const double place = 0.5 * (to_camera[coordinate] / longest + 1.0) * kCells;
    return std::clamp(static_cast<int>(place), 0, kCells - 1);
  };
  const int face = 2 * axis + (to_camera[axis] < 0 ? 1 : 0);
  const int cell = (face * kCells + cell_of((axis + 2) % 3)) * kCells + cell_of((axis + 1) % 3);
  return views_[nearest_[static_cast<std::size_t>(cell)]];
}

}  // namespace anneal6d
