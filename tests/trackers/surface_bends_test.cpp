// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "surface_bends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "instruction_sets.h"
#include "synthetic.h"

namespace anneal6d {
namespace {

using test::SharedMesh;
using Bends = std::vector<SurfaceBends::Bend>;

/// A step between pixels that is no surface any more, of the diameter.
constexpr double kJump = 0.02;

Bends bends_of(const SharedMesh& mesh, const Pose& pose) {
  const CameraModel camera = test::small_camera();
  const test::Drawing drawing = test::draw(RasterModel(mesh, false), camera, pose);
  return SurfaceBends().find(drawing.depth_mm, {0, 0}, camera, kJump * mesh->diameter_mm());
}

/// The straight part of a rounded edge of a box, between the places where its corners begin.
struct RoundedEdge {
  Eigen::Vector2d from_px, to_px;

  Eigen::Vector2d along() const { return (to_px - from_px).normalized(); }
  Eigen::Vector2d at(double share) const { return from_px + share * (to_px - from_px); }
  double distance_px(const Eigen::Vector2d& p) const {
    const double s =
        std::clamp((p - from_px).dot(to_px - from_px) / (to_px - from_px).squaredNorm(), 0.0, 1.0);
    return (p - at(s)).norm();
  }
};

class BendsOfARoundedBox : public testing::Test {
 protected:
  /// Where the surface has turned by half, on the edges both of whose faces are in sight.
  std::vector<RoundedEdge> visible_edges() const {
    const Eigen::Vector3d camera_mm = pose.inverse().translation_mm;
    const Eigen::Vector3d inner_mm = sides_mm / 2 - Eigen::Vector3d::Constant(radius_mm);
    std::vector<RoundedEdge> edges;
    for (int along = 0; along < 3; ++along) {
      const int u = (along + 1) % 3, v = (along + 2) % 3;
      for (const double su : {-1.0, 1.0}) {
        for (const double sv : {-1.0, 1.0}) {
          if (su * camera_mm[u] < sides_mm[u] / 2 || sv * camera_mm[v] < sides_mm[v] / 2) continue;
          const double out_mm = radius_mm * std::sqrt(0.5);
          Eigen::Vector3d place_mm;
          place_mm[u] = su * (inner_mm[u] + out_mm);
          place_mm[v] = sv * (inner_mm[v] + out_mm);
          RoundedEdge edge;
          place_mm[along] = -inner_mm[along];
          edge.from_px = camera.project(pose * place_mm);
          place_mm[along] = inner_mm[along];
          edge.to_px = camera.project(pose * place_mm);
          edges.push_back(edge);
        }
      }
    }
    return edges;
  }

  const CameraModel camera = test::small_camera();
  const Eigen::Vector3d sides_mm{80, 50, 65};
  const double radius_mm = 3;  // and as many pixels
  const Pose pose = test::corner_view();
  const SharedMesh mesh = test::make_rounded_box(sides_mm, radius_mm);
};

TEST_F(BendsOfARoundedBox, RunAlongItsEdges) {
  const auto edges = visible_edges();
  ASSERT_EQ(edges.size(), 3U);
  constexpr int kParts = 8;
  // Not at its ends, where the surface turns elsewhere or out of sight.
  constexpr double kFrom = 0.1, kTo = 0.8;
  for (const std::int64_t target : test::instruction_sets()) {
    const test::OnInstructionSet on(target);
    const Bends bends = bends_of(mesh, pose);
    for (const RoundedEdge& edge : edges) {
      for (int part = 0; part < kParts; ++part) {
        const Eigen::Vector2d middle_px = edge.at(kFrom + (kTo - kFrom) * (part + 0.5) / kParts);
        const double half_px = 0.5 * (kTo - kFrom) * (edge.to_px - edge.from_px).norm() / kParts;
        const bool covered = std::any_of(bends.begin(), bends.end(), [&](const auto& bend) {
          const Eigen::Vector2d offset = bend.place_px - middle_px;
          return std::abs(offset.dot(edge.along())) < half_px &&
                 edge.distance_px(bend.place_px) < 2;
        });
        EXPECT_TRUE(covered) << "part " << part << " of " << edge.from_px.transpose() << " to "
                             << edge.to_px.transpose() << " on " << hwy::TargetName(target);
      }
    }
  }
}

TEST_F(BendsOfARoundedBox, LieWhereTheSurfaceHasTurnedByHalf) {
  const auto edges = visible_edges();
  for (const auto& bend : bends_of(mesh, pose)) {
    double nearest_px = 1e9;
    for (const RoundedEdge& edge : edges) {
      nearest_px = std::min(nearest_px, edge.distance_px(bend.place_px));
    }
    EXPECT_LT(nearest_px, 1.5) << bend.place_px.transpose();
  }
}

TEST_F(BendsOfARoundedBox, PointAcrossItsEdges) {
  const auto edges = visible_edges();
  for (const auto& bend : bends_of(mesh, pose)) {
    EXPECT_NEAR(bend.across.norm(), 1, 1e-9);
    const auto& edge = *std::min_element(edges.begin(), edges.end(), [&](auto& a, auto& b) {
      return a.distance_px(bend.place_px) < b.distance_px(bend.place_px);
    });
    // In its corner three edges run together.
    if ((bend.place_px - edge.from_px).norm() < 8 || (bend.place_px - edge.to_px).norm() < 8) {
      continue;
    }
    EXPECT_LT(std::abs(bend.across.dot(edge.along())), 0.2) << bend.place_px.transpose();
  }
}

TEST_F(BendsOfARoundedBox, AreNoneWhereThereIsAHole) {
  const test::Drawing drawing = test::draw(RasterModel(mesh, false), camera, pose);
  const auto bends_in = [&](const cv::Mat& depth_mm) {
    return SurfaceBends().find(depth_mm, {0, 0}, camera, kJump * mesh->diameter_mm());
  };
  const Bends bends = bends_in(drawing.depth_mm);
  ASSERT_GT(bends.size(), 50U);
  for (const auto& bend : bends) {
    const cv::Point hole(cvRound(bend.place_px.x()), cvRound(bend.place_px.y()));
    cv::Mat holed = drawing.depth_mm.clone();
    holed.at<float>(hole) = 0;
    for (const auto& other : bends_in(holed)) {
      EXPECT_NE(cv::Point(cvRound(other.place_px.x()), cvRound(other.place_px.y())), hole);
    }
  }
}

TEST_F(BendsOfARoundedBox, AreNoneWhereItIsRoundedWidely) {
  EXPECT_EQ(bends_of(test::make_rounded_box(sides_mm, 12), pose).size(), 0U);
}

TEST_F(BendsOfARoundedBox, AreFoundInAPartOfTheImage) {
  const test::Drawing drawing = test::draw(RasterModel(mesh, false), camera, pose);
  const cv::Rect part(drawing.region.x, drawing.region.y, drawing.region.width,
                      drawing.region.height);
  const Bends whole = bends_of(mesh, pose);
  SurfaceBends finder;
  const Bends& found =
      finder.find(drawing.depth_mm(part), part.tl(), camera, kJump * mesh->diameter_mm());
  ASSERT_EQ(found.size(), whole.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::Vector2d place_px = found[i].place_px + Eigen::Vector2d(part.x, part.y);
    EXPECT_LT((place_px - whole[i].place_px).norm(), 1e-3);
  }
}

/// From many sides, near and far.
std::vector<Pose> poses_around(const TriangleMesh& mesh) {
  std::vector<Pose> poses;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const RandomKey key{.seed = 12, .particle = i};
    poses.push_back(test::pose_with_center(mesh, test::random_rotation(key),
                                           {0, 0, test::random_between(key, 0, 200, 700)}));
  }
  return poses;
}

TEST(BendsOfASurface, AreNowhereOnAFlatPlate) {
  const auto plate = test::make_box(120, 90, 0.5);
  for (const Pose& pose : poses_around(*plate)) {
    EXPECT_EQ(bends_of(plate, pose).size(), 0U) << pose.translation_mm.transpose();
  }
}

TEST(BendsOfASurface, AreNowhereOnASphere) {
  const auto sphere = test::make_coloured_sphere(50);
  for (const Pose& pose : poses_around(*sphere)) {
    EXPECT_EQ(bends_of(sphere, pose).size(), 0U) << pose.translation_mm.transpose();
  }
}

TEST(BendsOfASurface, AreNowhereOnTheSideOfACylinder) {
  const auto cylinder = test::make_cylinder(120, 25, 64);
  for (const Pose& pose : poses_around(*cylinder)) {
    const CameraModel camera = test::small_camera();
    for (const auto& bend : bends_of(cylinder, pose)) {
      // Its rims are bends: the surface turns by a right angle there.
      double nearest_px = 1e9;
      for (int degrees = 0; degrees < 360; ++degrees) {
        const double angle = degrees * test::kDegree;
        for (const double z_mm : {-60, 60}) {
          const Eigen::Vector3d rim_mm(25 * std::cos(angle), 25 * std::sin(angle), z_mm);
          nearest_px = std::min(nearest_px, (camera.project(pose * rim_mm) - bend.place_px).norm());
        }
      }
      EXPECT_LT(nearest_px, 2) << bend.place_px.transpose() << " at "
                               << pose.translation_mm.transpose();
    }
  }
}

TEST(BendsOfASurface, AreNowhereAtAStepFromOneSurfaceToAnother) {
  // A round plate before another, both tilted.
  constexpr float kStep_mm = 20;
  cv::Mat depth_mm(240, 320, CV_32FC1);
  for (int y = 0; y < depth_mm.rows; ++y) {
    for (int x = 0; x < depth_mm.cols; ++x) {
      const bool front = std::hypot(x - 170, y - 110) < 70;
      depth_mm.at<float>(y, x) = 300.0F + 0.3F * static_cast<float>(x) +
                                 0.2F * static_cast<float>(y) + (front ? 0.0F : kStep_mm);
    }
  }
  SurfaceBends finder;
  EXPECT_EQ(finder.find(depth_mm, {0, 0}, test::small_camera(), 0.5 * kStep_mm).size(), 0U);
  EXPECT_GT(finder.find(depth_mm, {0, 0}, test::small_camera(), 2 * kStep_mm).size(), 100U)
      << "the step is taken for a steep surface";
}

TEST(FindingBends, ForgetsThoseOfTheDepthImageBefore) {
  const auto box = test::make_rounded_box({80, 50, 65}, 3);
  const CameraModel camera = test::small_camera();
  const test::Drawing drawing = test::draw(RasterModel(box, false), camera, test::corner_view());
  const cv::Mat flat(drawing.depth_mm.size(), CV_32FC1, cv::Scalar(320));
  SurfaceBends finder;
  EXPECT_GT(finder.find(drawing.depth_mm, {0, 0}, camera, 2).size(), 0U);
  EXPECT_EQ(finder.find(flat, {0, 0}, camera, 2).size(), 0U);
}

}  // namespace
}  // namespace anneal6d
