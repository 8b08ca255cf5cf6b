// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "view_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "synthetic.h"

namespace anneal6d {
namespace {

constexpr double kRadius_mm = 50;

/// Of many faces: its silhouette is round to a hundredth of a millimetre or two.
const test::SharedMesh& sphere() {
  static const auto mesh =
      test::make_grid(160, 2 * EIGEN_PI, 80, -EIGEN_PI / 2, EIGEN_PI / 2, [](double u, double v) {
        const Eigen::Vector3d direction(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v),
                                        std::sin(v));
        MeshVertex vertex;
        vertex.normal = direction.cast<float>();
        vertex.position_mm = static_cast<float>(kRadius_mm) * vertex.normal;
        return vertex;
      });
  return mesh;
}

struct Told {
  int calls = 0;
  double last = 0;
  bool rising = true;
};
Told told;

const ViewModel& views() {
  static const RasterModel model(sphere(), false);
  static const ViewModel made(model, {.threshold = 40}, Shading{}, 2, [](double share) {
    ++told.calls;
    told.rising = told.rising && share > told.last;
    told.last = share;
  });
  return made;
}

Pose random_pose(std::uint32_t index) {
  const RandomKey key{.seed = 3, .particle = index};
  return {test::random_rotation(key),
          {test::random_between(key, 0, -80, 80), test::random_between(key, 1, -60, 60),
           test::random_between(key, 2, 150, 900)}};
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) / test::kDegree;
}

TEST(ViewsOfAModel, LieEvenlyAroundIt) {
  for (int i = 0; i < ViewModel::kViews; ++i) {
    EXPECT_NEAR(ViewModel::direction(i).norm(), 1, 1e-12);
    double nearest_deg = 180;
    for (int k = 0; k < ViewModel::kViews; ++k) {
      if (k == i) continue;
      nearest_deg =
          std::min(nearest_deg, degrees_between(ViewModel::direction(i), ViewModel::direction(k)));
    }
    EXPECT_GT(nearest_deg, 3.5) << "view " << i;
    EXPECT_LT(nearest_deg, 6.5) << "view " << i;
  }
}

TEST(ViewsOfAModel, AreChosenByTheCamerasDirectionOrAlmost) {
  double worst_deg = 0, sum_deg = 0;
  constexpr std::uint32_t kPoses = 5000;
  for (std::uint32_t i = 0; i < kPoses; ++i) {
    const Pose pose = random_pose(i);
    const Eigen::Vector3d to_camera =
        pose.inverse().translation_mm - sphere()->center_mm().cast<double>();
    const auto chosen = &views().seen_from(pose) - views().views().data();
    const double chosen_deg =
        degrees_between(ViewModel::direction(static_cast<int>(chosen)), to_camera);
    double best_deg = 180;
    for (int k = 0; k < ViewModel::kViews; ++k) {
      best_deg = std::min(best_deg, degrees_between(ViewModel::direction(k), to_camera));
    }
    worst_deg = std::max(worst_deg, chosen_deg - best_deg);
    sum_deg += chosen_deg - best_deg;
  }
  // 3.7 at worst, between two cells of directions that meet at a view's border; 0.21 on average.
  EXPECT_LT(worst_deg, 4.2);
  EXPECT_LT(sum_deg / kPoses, 0.3);
}

TEST(ViewsOfAModel, TellTheirProgress) {
  views();
  EXPECT_GT(told.calls, 10);
  EXPECT_TRUE(told.rising);
  EXPECT_EQ(told.last, 1);
}

TEST(ViewsOfAModel, SurviveACameraInTheMiddle) {
  const Pose inside{Eigen::Quaterniond::Identity(), {0, 0, 0}};
  EXPECT_EQ(&views().seen_from(inside), &views().views().front());
}

TEST(ViewsOfASphere, HaveItsOutlineAllAround) {
  for (const ModelView& view : views().views()) {
    ASSERT_GT(view.contour.size(), 80U);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const ContourSample& sample : view.contour) {
      EXPECT_TRUE(sample.silhouette);
      EXPECT_NEAR(sample.normal.norm(), 1, 1e-5);
      EXPECT_GT(sample.normal.dot(sample.object_mm), 0) << "out of the object";
      sum += sample.normal.cast<double>();
    }
    EXPECT_LT(sum.norm() / static_cast<double>(view.contour.size()), 0.2) << "none is left out";
  }
}

// The outline of a sphere is a circle, from everywhere: where a camera between two viewpoints
// expects contour points is known.
TEST(ViewsOfASphere, SlideTheOutlineToWhereTheCameraSeesIt) {
  constexpr double kDistance_mm = 300;  // much nearer than where the views are seen from
  const CameraModel camera = test::small_camera();
  double worst_px = 0, sum_px = 0, worst_unslid_px = 0;
  int points = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    Pose pose = random_pose(i);
    pose.translation_mm = {0, 0, kDistance_mm};
    const Eigen::Vector3d camera_mm = pose.inverse().translation_mm;
    // The cone from the camera that touches the sphere.
    const double tangent =
        kRadius_mm / std::sqrt(kDistance_mm * kDistance_mm - kRadius_mm * kRadius_mm);
    const auto off_px = [&](const Eigen::Vector3d& object_mm) {
      const Eigen::Vector3d p = pose * object_mm;
      return std::abs(p.head<2>().norm() / p.z() - tangent) * camera.fx_px;
    };
    for (const ContourSample& sample : views().seen_from(pose).contour) {
      const Eigen::Vector3d place = sample.object_mm.cast<double>();
      const Eigen::Vector3d normal = sample.normal.cast<double>();
      const Eigen::Vector3d sight = (place - camera_mm).normalized();
      const Eigen::Vector3d turned = (normal - normal.dot(sight) * sight).normalized();
      const double left_px = off_px(place + sample.curve_mm * (turned - normal));
      worst_px = std::max(worst_px, left_px);
      worst_unslid_px = std::max(worst_unslid_px, off_px(place));
      sum_px += left_px;
      ++points;
    }
  }
  EXPECT_GT(worst_unslid_px, 0.4) << "without sliding there would be nothing to test";
  EXPECT_LT(worst_px, 0.2);
  EXPECT_LT(sum_px / points, 0.05);
}

TEST(ViewsOfASphere, HaveEdgePointsOnItsSurface) {
  for (const ModelView& view : views().views()) {
    ASSERT_GT(view.edges, 100);
    ASSERT_EQ(view.edge_x.size() % ModelView::kPadding, 0U);
    ASSERT_GE(view.edge_x.size(), static_cast<std::size_t>(view.edges));
    EXPECT_GE(view.edge_px, static_cast<float>(view.edges));
    for (std::size_t i = 0; i < static_cast<std::size_t>(view.edges); ++i) {
      // Edge pixels beside the object keep the depth of the pixel next to them.
      EXPECT_NEAR(Eigen::Vector3f(view.edge_x[i], view.edge_y[i], view.edge_z[i]).norm(),
                  kRadius_mm, 2.0);
    }
  }
}

}  // namespace
}  // namespace anneal6d
