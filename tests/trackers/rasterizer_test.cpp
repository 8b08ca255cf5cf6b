// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "rasterizer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "instruction_sets.h"
#include "special_numbers.h"
#include "synthetic.h"

namespace anneal6d {
namespace {

using test::draw;
using test::Drawing;
using test::SharedMesh;
using test::small_camera;

Pose at_depth(double z_mm) { return {Eigen::Quaterniond::Identity(), {0, 0, z_mm}}; }

Pose tilted(double x_deg, double y_deg, double z_mm) {
  return {rotation_from_axis_angle(Eigen::Vector3d::UnitX(), x_deg * test::kDegree) *
              rotation_from_axis_angle(Eigen::Vector3d::UnitY(), y_deg * test::kDegree),
          {0, 0, z_mm}};
}

/// A rectangle in the object's x-y plane; the texture's (0, 0) is at (-x, -y).
SharedMesh make_plate(float width_mm, float height_mm, cv::Mat texture = {}) {
  std::vector<MeshVertex> corners;
  for (const auto& [u, v] : {std::pair{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}) {
    MeshVertex corner = test::vertex_at((u - 0.5F) * width_mm, (v - 0.5F) * height_mm, 0);
    corner.normal = {0, 0, -1};
    corner.uv = {u, v};
    corners.push_back(corner);
  }
  return std::make_shared<const TriangleMesh>(corners, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}},
                                              std::move(texture));
}

/// Where the ray of a pixel meets the object's x-y plane: object coordinates and camera depth.
struct Hit {
  Eigen::Vector3d object_mm;
  double z_mm;
};
Hit hit_plane(const CameraModel& camera, const Pose& pose, int x, int y) {
  const Eigen::Vector3d ray((x - camera.cx_px) / camera.fx_px, (y - camera.cy_px) / camera.fy_px,
                            1);
  const Eigen::Vector3d normal = pose.rotation * Eigen::Vector3d::UnitZ();
  const double z_mm = normal.dot(pose.translation_mm) / normal.dot(ray);
  return {pose.inverse() * (z_mm * ray), z_mm};
}

TEST(RasterizedDepth, IsExactOnASlantedPlane) {
  const RasterModel model(make_plate(120, 90), false);
  for (const Pose& pose : {tilted(0, 0, 300), tilted(50, 20, 300), tilted(-30, 65, 250)}) {
    const Drawing drawing = draw(model, small_camera(), pose);
    int pixels = 0;
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 320; ++x) {
        const float depth_mm = drawing.depth_mm.at<float>(y, x);
        const Hit hit = hit_plane(small_camera(), pose, x, y);
        const double inside_mm =
            std::min(60 - std::abs(hit.object_mm.x()), 45 - std::abs(hit.object_mm.y()));
        if (inside_mm > 0.01) {
          ASSERT_NEAR(depth_mm, hit.z_mm, 1e-3) << x << ", " << y;
          ++pixels;
        } else if (inside_mm < -0.01) {
          ASSERT_EQ(depth_mm, 0) << x << ", " << y;
        }
      }
    }
    EXPECT_GT(pixels, 1000);
  }
}

TEST(RasterizedDepth, IsExactWhereThePlaneCrossesTheNearPlane) {
  // The floor below the camera, from behind it to far before it.
  const Pose pose{rotation_from_axis_angle(Eigen::Vector3d::UnitX(), 90 * test::kDegree),
                  {0, 40, 0}};
  const Drawing drawing = draw(RasterModel(make_plate(1000, 1000), false), small_camera(), pose);
  int pixels = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const float depth_mm = drawing.depth_mm.at<float>(y, x);
      const Hit hit = hit_plane(small_camera(), pose, x, y);
      if (depth_mm > 0) {
        ASSERT_GE(depth_mm, kNearPlane_mm * 0.999) << x << ", " << y;
        ASSERT_NEAR(depth_mm, hit.z_mm, 2e-3 * hit.z_mm) << x << ", " << y;
        ++pixels;
      } else if (hit.z_mm > 60 && hit.z_mm < 490 && std::abs(hit.object_mm.x()) < 499) {
        ADD_FAILURE() << "hole at " << x << ", " << y;
      }
    }
  }
  EXPECT_GT(pixels, 10000);
}

TEST(RasterizedDepth, IsThereInRowsOfEveryLength) {
  // Short rows are filled several at a time, long ones in pieces.
  for (const std::int64_t target : test::instruction_sets()) {
    const test::OnInstructionSet on(target);
    for (float width_mm = 0.5F; width_mm < 36; width_mm += 0.5F) {
      const RasterModel model(make_plate(width_mm, 30), false);
      const Pose pose = tilted(0, 10, 300);
      const Drawing drawing = draw(model, small_camera(), pose);
      for (int y = 100; y < 140; ++y) {
        for (int x = 140; x < 180; ++x) {
          const Hit hit = hit_plane(small_camera(), pose, x, y);
          const double inside_mm = std::min(0.5 * width_mm - std::abs(hit.object_mm.x()),
                                            15 - std::abs(hit.object_mm.y()));
          if (std::abs(inside_mm) < 0.01) continue;
          ASSERT_EQ(drawing.depth_mm.at<float>(y, x) > 0, inside_mm > 0)
              << hwy::TargetName(target) << ", " << width_mm << " wide, at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(RasterizedDepth, HasNoHolesWherePlanksCrossTheNearPlane) {
  // A floor of planks from behind the camera to far before it: some pixels wide, but cut where they
  // are thousands of pixels below the image.
  std::vector<MeshVertex> vertices;
  std::vector<Triangle> triangles;
  constexpr std::uint32_t kPlanks = 250;
  for (std::uint32_t i = 0; i <= kPlanks; ++i) {
    const float x_mm = -500 + 1000 * static_cast<float>(i) / kPlanks;
    for (const float y_mm : {-500.0F, 500.0F}) {
      vertices.push_back(test::vertex_at(x_mm, y_mm, 0));
      vertices.back().normal = {0, 0, -1};
    }
    if (i == kPlanks) break;
    triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
    triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
  }
  const RasterModel model(std::make_shared<const TriangleMesh>(vertices, triangles), false);
  const Pose pose{rotation_from_axis_angle(Eigen::Vector3d::UnitX(), 90 * test::kDegree),
                  {0, 40, 0}};
  const Drawing drawing = draw(model, small_camera(), pose);
  int pixels = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const Hit hit = hit_plane(small_camera(), pose, x, y);
      if (!(hit.z_mm > 60 && hit.z_mm < 490 && std::abs(hit.object_mm.x()) < 499)) continue;
      ASSERT_GT(drawing.depth_mm.at<float>(y, x), 0) << x << ", " << y;
      ++pixels;
    }
  }
  EXPECT_GT(pixels, 10000);
}

TEST(RasterizedDepth, IsThatOfTheNearestSurface) {
  const auto mesh = test::make_torus(50, 20);
  const RasterModel model(mesh, false);
  const Pose pose = tilted(70, 0, 300);  // seen nearly from the side: the ring hides itself
  const Drawing drawing = draw(model, small_camera(), pose);
  const double nearest_mm = 300 - std::sin(70 * test::kDegree) * 50 - 20;
  double least, most;
  cv::minMaxLoc(drawing.depth_mm, &least, &most, nullptr, nullptr, drawing.depth_mm > 0);
  EXPECT_NEAR(least, nearest_mm, 1.0);
  const auto middle =
      drawing.depth_mm.at<float>(static_cast<int>(std::lround(small_camera().cy_px)),
                                 static_cast<int>(std::lround(small_camera().cx_px)));
  EXPECT_LT(middle, 300) << "the far side of the ring shines through";
}

TEST(RasterizedBrightness, IsAlbedoTimesLight) {
  const Drawing drawing =
      draw(RasterModel(make_plate(80, 80), false), small_camera(), at_depth(300));
  const Shading shading;
  const double light = shading.ambient + shading.diffuse * std::abs(shading.to_light.z());
  EXPECT_EQ(drawing.grey.at<std::uint8_t>(118, 161), std::lround(255 * 0.8 * light));
}

TEST(RasterizedBrightness, IsTheSameOnBothSidesOfASurface) {
  const RasterModel model(make_plate(80, 80), false);
  const Pose back{rotation_from_axis_angle(Eigen::Vector3d::UnitY(), 180 * test::kDegree),
                  {0, 0, 300}};
  const Drawing from_front = draw(model, small_camera(), at_depth(300));
  const Drawing from_back = draw(model, small_camera(), back);
  EXPECT_GT(cv::countNonZero(from_front.grey), 1000);
  EXPECT_EQ(cv::countNonZero(from_front.grey != from_back.grey), 0);
}

TEST(RasterizedBrightness, StaysBetweenThatOfTheCornersInNeedles) {
  // So thin that the slopes of the brightness across them are nothing but roundings.
  std::vector<MeshVertex> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 40000; ++i) {
    const RandomKey key{.seed = 11, .particle = i};
    const double x = test::random_between(key, 0, -150, 150), y = -110;
    const double tip_x = test::random_between(key, 1, -150, 150), tip_y = 110;
    const double off = std::pow(10.0, test::random_between(key, 2, -5.5, -4));
    const auto corner = [&](double at_x, double at_y, float albedo) {
      MeshVertex vertex = test::vertex_at(static_cast<float>(at_x), static_cast<float>(at_y), 0);
      vertex.normal = {0, 0, -1};
      vertex.albedo_bgr.setConstant(albedo);
      vertices.push_back(vertex);
    };
    corner(x, y, 0.1F);
    corner(tip_x, tip_y, 0.2F);
    corner(0.5 * (x + tip_x) + off, 0.5 * (y + tip_y), 0.3F);
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const auto mesh = std::make_shared<const TriangleMesh>(vertices, triangles);
  const Drawing drawing = draw(RasterModel(mesh, false), small_camera(), at_depth(300));
  const cv::Mat drawn = drawing.depth_mm > 0;
  EXPECT_GT(cv::countNonZero(drawn), 100);
  double least, most;
  cv::minMaxLoc(drawing.grey, &least, &most, nullptr, nullptr, drawn);
  const Shading shading;
  const double light = 255 * (shading.ambient + shading.diffuse * std::abs(shading.to_light.z()));
  EXPECT_GE(least, std::floor(0.1 * light));
  EXPECT_LE(most, std::ceil(0.3 * light));
}

TEST(RasterizedTexture, IsSampledBilinearlyWithPerspective) {
  cv::Mat texture(16, 24, CV_8UC3);
  cv::RNG random(4);
  for (int row = 0; row < texture.rows; ++row) {
    for (int column = 0; column < texture.cols; ++column) {
      texture.at<cv::Vec3b>(row, column) =
          cv::Vec3b::all(static_cast<std::uint8_t>(random.uniform(40, 250)));
    }
  }
  const RasterModel model(make_plate(120, 80, texture), true);
  const Pose pose = tilted(40, 35, 260);
  const Drawing drawing = draw(model, small_camera(), pose);
  const Shading shading;
  const double light =
      0.8 * (shading.ambient + shading.diffuse * std::abs(shading.to_light.cast<double>().dot(
                                                     pose.rotation * Eigen::Vector3d::UnitZ())));
  int pixels = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const Hit hit = hit_plane(small_camera(), pose, x, y);
      // Away from the border, where the texture's other side begins by repetition.
      if (std::abs(hit.object_mm.x()) > 54 || std::abs(hit.object_mm.y()) > 34) continue;
      const double column = (hit.object_mm.x() / 120 + 0.5) * 24 - 0.5;
      const double row = (hit.object_mm.y() / 80 + 0.5) * 16 - 0.5;
      const int c = static_cast<int>(column), r = static_cast<int>(row);
      const auto texel = [&](int i, int k) { return texture.at<cv::Vec3b>(r + i, c + k)[0]; };
      const double fx = column - c, fy = row - r;
      const double expected = (1 - fy) * ((1 - fx) * texel(0, 0) + fx * texel(0, 1)) +
                              fy * ((1 - fx) * texel(1, 0) + fx * texel(1, 1));
      ASSERT_NEAR(drawing.grey.at<std::uint8_t>(y, x), light * expected, 1.5) << x << ", " << y;
      ++pixels;
    }
  }
  EXPECT_GT(pixels, 1000);
}

TEST(RasterizedTexture, IsLeftOutIfNotWanted) {
  const cv::Mat dark(8, 8, CV_8UC3, cv::Scalar(20, 20, 20));
  const auto mesh = make_plate(80, 80, dark);
  const auto brightness = [&](bool textured) {
    return draw(RasterModel(mesh, textured), small_camera(), at_depth(300))
        .grey.at<std::uint8_t>(118, 161);
  };
  EXPECT_NEAR(brightness(true), brightness(false) * 20 / 255.0, 1);
}

TEST(RasterizedObject, DoesNotDependOnTheWinding) {
  const auto torus = test::make_torus(50, 20);
  std::vector<Triangle> inward(torus->triangles().begin(), torus->triangles().end());
  for (Triangle& triangle : inward) std::swap(triangle[0], triangle[1]);
  std::vector<Triangle> mixed = inward;
  for (std::size_t i = 0; i < mixed.size(); i += 3) std::swap(mixed[i][0], mixed[i][1]);
  const auto drawn = [&](const std::vector<Triangle>& triangles) {
    const std::vector<MeshVertex> vertices(torus->vertices().begin(), torus->vertices().end());
    const auto mesh = std::make_shared<const TriangleMesh>(vertices, triangles);
    return draw(RasterModel(mesh, false), small_camera(), tilted(50, 10, 300)).grey;
  };
  const cv::Mat outward = draw(RasterModel(torus, false), small_camera(), tilted(50, 10, 300)).grey;
  EXPECT_GT(cv::countNonZero(outward), 5000);
  EXPECT_EQ(cv::countNonZero(outward != drawn(inward)), 0);
  // The far side, no longer skipped, meets the near one at the silhouette only.
  EXPECT_LE(cv::countNonZero(outward != drawn(mixed)), 20);
}

TEST(RasterizedRegion, HoldsTheObjectAndItsMargin) {
  const auto mesh = test::make_box(80, 60, 40);
  const RasterModel model(mesh, false);
  for (std::uint32_t i = 0; i < 60; ++i) {
    const RandomKey key{.seed = 6, .particle = i};
    const Pose pose{
        test::random_rotation(key),
        {test::random_between(key, 0, -200, 200), test::random_between(key, 1, -150, 150),
         test::random_between(key, 2, 150, 600)}};
    const int margin_px = static_cast<int>(i % 12);
    const Drawing drawing = draw(model, small_camera(), pose, margin_px);
    const Region& region = drawing.region;
    if (region.empty()) continue;
    EXPECT_EQ(region.x % 8, 0);
    EXPECT_GE(region.x, 0);
    EXPECT_GE(region.y, 0);
    EXPECT_LE(region.x + region.width, 320);
    EXPECT_LE(region.y + region.height, 240);
    std::vector<cv::Point> covered;
    cv::findNonZero(drawing.depth_mm > 0, covered);
    if (covered.empty()) continue;
    const cv::Rect box = cv::boundingRect(covered);
    EXPECT_LE(region.x, std::max(0, box.x - margin_px)) << "pose " << i;
    EXPECT_LE(region.y, std::max(0, box.y - margin_px)) << "pose " << i;
    EXPECT_GE(region.x + region.width, std::min(320, box.br().x + margin_px)) << "pose " << i;
    EXPECT_GE(region.y + region.height, std::min(240, box.br().y + margin_px)) << "pose " << i;
  }
}

TEST(RasterizedRegion, IsEmptyForWhatCannotBeSeen) {
  const RasterModel model(test::make_box(80, 60, 40), false);
  Rasterizer rasterizer(model, small_camera(), Shading{});
  for (const Pose& pose : {at_depth(-300), at_depth(test::kNaN), at_depth(1e12),
                           Pose{Eigen::Quaterniond::Identity(), {2000, 0, 300}},
                           Pose{Eigen::Quaterniond::Identity(), {0, -1e9, 300}}}) {
    EXPECT_TRUE(rasterizer.draw(pose, 3).empty()) << pose.translation_mm.transpose();
  }
}

TEST(Rasterizing, LeavesNoTraceOfDrawingsBefore) {
  const RasterModel model(test::make_torus(50, 20), false);
  Rasterizer rasterizer(model, small_camera(), Shading{});
  const Pose pose = tilted(50, 10, 300);
  const auto draw_again = [&] {
    cv::Mat grey;
    rasterizer.draw_images(pose, 2, grey);
    return grey;
  };
  const cv::Mat first = draw_again();
  PackedEdges edges;
  edges.assign(cv::Mat(240, 320, CV_8UC1, cv::Scalar(255)));
  for (const double z_mm : {40.0, 120.0, 900.0}) {
    if (!rasterizer.draw(at_depth(z_mm), 2).empty()) {
      rasterizer.count_edges(edges, {.threshold = 40});
    }
    EXPECT_EQ(cv::countNonZero(first != draw_again()), 0) << z_mm;
  }
}

}  // namespace
}  // namespace anneal6d
