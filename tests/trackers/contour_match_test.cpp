// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "contour_match.h"

#include <gtest/gtest.h>

#include <cmath>

#include "refiner.h"
#include "synthetic.h"
#include "view_painter.h"

namespace anneal6d {
namespace {

/// A cylinder that lies obliquely before the camera.
const Pose& oblique() {
  static const Pose pose{rotation_from_axis_angle(Eigen::Vector3d::UnitZ(), 0.4) *
                             rotation_from_axis_angle(Eigen::Vector3d::UnitX(), 0.9),
                         {0, 0, 320}};
  return pose;
}

/// The cylinder refined from beside its pose.
const Refiner::Result& refined_cylinder() {
  static const Refiner::Result result = [] {
    const RasterModel model(test::make_cylinder(110, 30, 64), false);
    const CameraModel camera = test::small_camera();
    const ViewModel views = test::views_near(model, oblique());
    const cv::Mat image = test::photograph(model, camera, oblique(), 20, 1.0);
    Refiner refiner(views, camera, test::workers());
    refiner.set_image(image, {0, 0, image.cols, image.rows});
    const Pose start = test::beside(*model.mesh, oblique(), {0.5, -0.5, 0}, {0.5, -0.5, 2});
    return refiner.refine(start, start, 8, Appearance(1));
  }();
  return result;
}

Eigen::Vector3d axis() { return oblique().rotation * Eigen::Vector3d::UnitZ(); }
/// Square to the axis, along the image.
Eigen::Vector3d across() { return axis().cross(Eigen::Vector3d::UnitZ()).normalized(); }

Twist turn_about(const Eigen::Vector3d& direction) {
  Twist twist = Twist::Zero();
  twist.head<3>() = 0.01 * direction;
  return twist;
}
Twist shift_along(const Eigen::Vector3d& direction) {
  Twist twist = Twist::Zero();
  twist.tail<3>() = direction;
  return twist;
}
/// How far a twist moves points of the cylinder, about.
double size_mm(const Twist& twist) {
  constexpr double kArm_mm = 40;
  return std::hypot(kArm_mm * twist.head<3>().norm(), twist.tail<3>().norm());
}

TEST(WhatEdgesOfACylinderLeaveOpen, IsTheTurnAboutItsAxis) {
  const Twist turn = turn_about(axis());
  EXPECT_LT(size_mm(refined_cylinder().unseen * turn - turn), 0.15 * size_mm(turn));
}

TEST(WhatEdgesOfACylinderLeaveOpen, IsNoShift) {
  const Eigen::Vector3d sight = Eigen::Vector3d::UnitZ();
  for (const Eigen::Vector3d& direction :
       {across(), Eigen::Vector3d(across().cross(sight)), sight}) {
    const Twist shift = shift_along(direction);
    EXPECT_LT(size_mm(refined_cylinder().unseen * shift), 0.03 * size_mm(shift))
        << direction.transpose();
  }
}

TEST(WhatEdgesOfACylinderLeaveOpen, IsNoTurnToTheCamera) {
  const Twist turn = turn_about(across());
  EXPECT_LT(size_mm(refined_cylinder().unseen * turn), 0.03 * size_mm(turn));
}

// A turn about any other direction may be seen as the part that is not about the axis.
TEST(WhatEdgesOfACylinderLeaveOpen, IsOfAnyMotionNothingButATurnAboutItsAxis) {
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)}) {
    for (const Twist& twist : {turn_about(direction), shift_along(direction)}) {
      Twist left = refined_cylinder().unseen * twist;
      left.head<3>() -= left.head<3>().dot(axis()) * axis();
      EXPECT_LT(size_mm(left), 0.06 * size_mm(twist)) << twist.transpose();
    }
  }
}

TEST(WhatEdgesOfACylinderLeaveOpen, IsTheFirstOfTheWeakMotions) {
  const Eigen::Vector3d turn = refined_cylinder().weak_motions[0].head<3>();
  EXPECT_GT(std::abs(turn.normalized().dot(axis())), 0.99);
}

/// Standard deviation along a direction, if edges are off by a pixel.
double error_along(const Eigen::Vector3d& direction) {
  const Eigen::Matrix3d shift = refined_cylinder().error_px2.bottomRightCorner<3, 3>();
  return std::sqrt(direction.dot(shift * direction));
}

TEST(ErrorsOfACylindersEdges, ShiftItByAsMuchAndMuchMoreInDepth) {
  const double mm_per_px = 320.0 / test::small_camera().fx_px;
  EXPECT_NEAR(error_along(across()) / mm_per_px, 1.0, 0.5);
  EXPECT_GT(error_along(Eigen::Vector3d::UnitZ()), 3 * mm_per_px);
}

TEST(ErrorsOfACylindersEdges, DoNotTurnItAboutItsAxisWhichTheyDoNotShow) {
  const Eigen::Matrix3d turn = refined_cylinder().error_px2.topLeftCorner<3, 3>();
  EXPECT_LT(axis().dot(turn * axis()), 0.1 * turn.trace());
}

TEST(EdgesOfAMovedCylinder, MoveAcrossThemselvesAsItsPointsDo) {
  const RasterModel model(test::make_cylinder(110, 30, 64), false);
  const CameraModel camera = test::small_camera();
  const ViewModel views = test::views_near(model, oblique());
  const cv::Mat image = test::photograph(model, camera, oblique(), 20, 1.0);
  ContourMatch match({image, {}}, camera, views.center_mm(), 1);
  ASSERT_GT(match.project(oblique(), views.seen_from(oblique()), 200), 50U);
  Twist motion;
  motion << 0.004, -0.006, 0.01, 0.5, 0.8, -1.0;
  const std::vector<MovedEdge> edges = match.moved_edges(motion, Appearance(1));
  const Pose before{Eigen::Quaterniond::Identity(), oblique() * views.center_mm()};
  const Pose after = moved(before, motion);
  const ProjectedContour& points = match.points();
  std::size_t outlines = 0;
  for (std::size_t i = 0; i < match.size(); ++i) {
    const Eigen::Vector3d at(points.camera_x[i], points.camera_y[i], points.camera_z[i]);
    const Eigen::Vector3d then = after * (before.inverse() * at);
    const Eigen::Vector2d way_px = camera.project(then) - camera.project(at);
    const double across_px = way_px.dot(Eigen::Vector2d(points.normal_x[i], points.normal_y[i]));
    if (points.inside_px[i] < 0 || points.trust[i] < 1) continue;
    ASSERT_LT(outlines, edges.size());
    EXPECT_NEAR(edges[outlines].moved_px, std::abs(across_px), 0.03) << at.transpose();
    EXPECT_GT(edges[outlines++].sharpness, 0);
  }
  EXPECT_EQ(outlines, edges.size());
  EXPECT_GT(outlines, 20U);
}

/// How much shading edges say there is more than `located_with`, at a pose beside the true one.
double more_shading(const Shading& light, double located_with, const Twist& beside) {
  const RasterModel model(test::make_cylinder(110, 30, 64), false);
  const CameraModel camera = test::small_camera().scaled(2);
  const cv::Mat image = test::photograph(model, camera, oblique(), 20, 0, 0, light);
  const Pose pose = moved(oblique(), beside);
  ViewPainter painter(model, {.threshold = 40}, Shading{}, camera);
  const ModelView view = painter.paint_contour(pose, 360, 0, test::workers());
  ContourMatch match({image, {}}, camera, model.mesh->center_mm().cast<double>(), located_with);
  EXPECT_GT(match.project(pose, view, 360), 100U);
  const ShadingEvidence evidence = match.shading_evidence(1, Appearance(1));
  EXPECT_GT(evidence.information_px2, 0.01);
  return evidence.left_px2 / evidence.information_px2;
}

TEST(WhatEdgesSayOfShading, DependsOnTheLight) {
  const double from_camera = more_shading({}, 0, Twist::Zero());
  const double from_all_around = more_shading({.ambient = 0.9F, .diffuse = 0}, 0, Twist::Zero());
  EXPECT_NEAR(from_all_around, 0, 0.3);
  EXPECT_GT(from_camera, from_all_around + 0.5);
}

TEST(WhatEdgesSayOfShading, IsWhatWasNotAllowedFor) {
  EXPECT_NEAR(more_shading({}, 0.6, Twist::Zero()), more_shading({}, 0, Twist::Zero()) - 0.6, 0.1);
}

TEST(WhatEdgesSayOfShading, IsNotWhatAMotionOfTheObjectExplains) {
  Twist beside;
  beside << 0.001, -0.001, 0.001, 0.1, -0.1, 0.6;
  EXPECT_NEAR(more_shading({}, 0.2, beside), more_shading({}, 0.2, Twist::Zero()), 0.15);
}

// As where the object is outside the image.
TEST(AMatchWithoutASingleStep, LeavesEverythingOpen) {
  const cv::Mat nothing;
  const CameraModel camera = test::small_camera();
  const ContourMatch match({nothing, {}}, camera, Eigen::Vector3d::Zero(), 1);
  const Eigen::Matrix<double, 6, 6> unseen = match.unseen();
  EXPECT_TRUE(unseen.isIdentity(1e-9)) << unseen;
  EXPECT_TRUE(match.error_px2().isZero());
}

}  // namespace
}  // namespace anneal6d
