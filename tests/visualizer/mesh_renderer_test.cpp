// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/mesh_renderer.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "anneal6d/framework/error.h"
#include "opengl_test.h"
#include "test_meshes.h"

namespace anneal6d {
namespace {

using test::at;
using test::make_rectangle;
using test::make_torus;
using test::vga_camera;

constexpr double kQuarterTurn = std::numbers::pi / 2;

struct Picture {
  cv::Mat color;
  cv::Mat depth_mm;

  cv::Mat mask() const { return depth_mm > 0; }
  cv::Rect box() const { return cv::boundingRect(mask()); }
  cv::Vec3b color_at(double x, double y) const {
    return color.at<cv::Vec3b>(cvRound(y), cvRound(x));
  }
};

Picture draw(std::shared_ptr<const TriangleMesh> mesh, const Pose& pose,
             const Shading& shading = {}, bool textured = true) {
  MeshRenderer renderer(std::move(mesh), vga_camera(), textured);
  Picture picture;
  renderer.render(pose, shading, picture.color, picture.depth_mm);
  return picture;
}

Pose turned(Pose pose, double angle_rad, const Eigen::Vector3d& axis) {
  pose.rotation = Eigen::AngleAxisd(angle_rad, axis.normalized());
  return pose;
}

/// Unshaded: colours are the albedo.
Shading flat() {
  Shading shading;
  shading.ambient = 1;
  shading.diffuse = 0;
  return shading;
}

bool is_black(const Picture& picture) {
  return cv::countNonZero(picture.color.reshape(1)) == 0 && cv::countNonZero(picture.depth_mm) == 0;
}

using MeshRendererTest = test::OpenGlTest;

TEST_F(MeshRendererTest, CoversExactlyThePixelsWhoseCentresLieInside) {
  // One pixel a millimetre; the borders run between pixels: columns 271..370, rows 211..270.
  const Picture picture = draw(make_rectangle(100, 60), at(0.5, 0.5, 500));
  EXPECT_EQ(picture.color.type(), CV_8UC3);
  EXPECT_EQ(picture.color.size(), cv::Size(640, 480));
  EXPECT_EQ(picture.box(), cv::Rect(271, 211, 100, 60));
  EXPECT_EQ(cv::countNonZero(picture.mask()), 100 * 60);
}

TEST_F(MeshRendererTest, PutsPixelCentresAtIntegerCoordinates) {
  const Pose pose = turned(at(12.3, -37.7, 430), 0.3, {0, 0, 1});
  const Picture picture = draw(make_rectangle(200, 150), pose);
  const cv::Moments moments = cv::moments(picture.mask(), true);
  const Eigen::Vector2d center_px = vga_camera().project(pose.translation_mm);
  EXPECT_NEAR(moments.m10 / moments.m00, center_px.x(), 0.05);
  EXPECT_NEAR(moments.m01 / moments.m00, center_px.y(), 0.05);
}

TEST_F(MeshRendererTest, DrawsWhatIsBelowTheAxisIntoLowerRows) {
  EXPECT_EQ(draw(make_rectangle(20, 20), at(50.5, 100.5, 500)).box(), cv::Rect(361, 331, 20, 20));
}

TEST_F(MeshRendererTest, ReportsTheDepthOfATiltedPlane) {
  const Pose pose = turned(at(20, -10, 600), 1.0, {1, 2, 0.5});
  const Picture picture = draw(make_rectangle(300, 300), pose);
  const Eigen::Vector3d normal = pose.rotation * Eigen::Vector3d::UnitZ();
  const CameraModel camera = vga_camera();
  int pixels = 0;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const float depth_mm = picture.depth_mm.at<float>(y, x);
      if (depth_mm == 0) continue;
      const Eigen::Vector3d ray((x - camera.cx_px) / camera.fx_px,
                                (y - camera.cy_px) / camera.fy_px, 1);
      EXPECT_NEAR(depth_mm, normal.dot(pose.translation_mm) / normal.dot(ray), 0.02);
      ++pixels;
    }
  }
  EXPECT_GT(pixels, 10000);
}

TEST_F(MeshRendererTest, DrawsThePartInsideTheImage) {
  const Picture picture = draw(make_rectangle(100, 60), at(-319.5, 0.5, 500));
  EXPECT_EQ(picture.box(), cv::Rect(0, 211, 51, 60));
}

TEST_F(MeshRendererTest, GivesBlackForWhatCannotBeSeen) {
  const auto mesh = make_torus();
  EXPECT_TRUE(is_black(draw(mesh, at(0, 0, -300)))) << "behind the camera";
  EXPECT_TRUE(is_black(draw(mesh, at(3000, 0, 300)))) << "beside the image";
  EXPECT_TRUE(is_black(draw(mesh, at(1e30, 0, 1e300)))) << "beyond single precision";
  EXPECT_TRUE(is_black(draw(mesh, at(0, std::numeric_limits<double>::quiet_NaN(), 300))));
  EXPECT_TRUE(is_black(draw(mesh, at(0, 0, std::numeric_limits<double>::infinity()))));
}

TEST_F(MeshRendererTest, ForgetsThePictureBefore) {
  MeshRenderer renderer(make_torus(), vga_camera());
  Picture picture;
  renderer.render(at(0, 0, 300), {}, picture.color, picture.depth_mm);
  EXPECT_FALSE(is_black(picture));
  renderer.render(at(0, 0, -300), {}, picture.color, picture.depth_mm);
  EXPECT_TRUE(is_black(picture));
}

TEST_F(MeshRendererTest, ClipsAtTheNearPlane) {
  const auto mesh = make_rectangle(100, 100);
  EXPECT_TRUE(is_black(draw(mesh, at(0, 0, kNearPlane_mm - 0.1))));
  EXPECT_EQ(cv::countNonZero(draw(mesh, at(0, 0, kNearPlane_mm + 0.1)).mask()), 640 * 480);

  // A floor 3.003 mm below the camera from far behind to far before it: it is cut where it comes
  // nearer than 10 mm, which is 150.15 px below the axis.
  const Picture floor =
      draw(make_rectangle(4000, 1000), turned(at(0, 3.003, 0), kQuarterTurn, {1, 0, 0}));
  EXPECT_EQ(floor.box(), cv::Rect(0, 244, 640, 390 - 244 + 1));
  EXPECT_NEAR(floor.depth_mm.at<float>(390, 320), 500 * 3.003 / 150, 1e-3);
}

TEST_F(MeshRendererTest, KeepsColoursInRangeWhereATriangleIsClipped) {
  const auto corner = [](float x, float z, float albedo) {
    return MeshVertex{{x, 30, z}, {0, -1, 0}, {0, 0}, {albedo, albedo, albedo}};
  };
  const auto mesh = std::make_shared<TriangleMesh>(
      std::vector<MeshVertex>{corner(-900, -500, 0.4F), corner(900, -500, 0.6F),
                              corner(900, 800, 0.4F), corner(-900, 800, 0.6F)},
      std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  const Picture picture = draw(mesh, at(0, 0, 0), flat());
  double low = 0;
  double high = 0;
  cv::Mat grey;
  cv::extractChannel(picture.color, grey, 0);
  cv::minMaxLoc(grey, &low, &high, nullptr, nullptr, picture.mask());
  EXPECT_GT(cv::countNonZero(picture.mask()), 50000);
  EXPECT_GE(low, 0.4 * 255 - 1);
  EXPECT_LE(high, 0.6 * 255 + 1);
}

TEST_F(MeshRendererTest, LightsBothSidesAlike) {
  Shading shading;
  shading.to_light = Eigen::Vector3f(0, 0.6F, -0.8F);
  shading.ambient = 0.25F;
  shading.diffuse = 0.5F;
  const auto mesh = make_rectangle(100, 60, {}, {0.2F, 0.4F, 0.8F});
  const cv::Vec3b expected(cvRound(255 * 0.2 * 0.65), cvRound(255 * 0.4 * 0.65),
                           cvRound(255 * 0.8 * 0.65));
  EXPECT_EQ(draw(mesh, at(0, 0, 500), shading).color_at(320, 240), expected);
  const Pose from_behind = turned(at(0, 0, 500), 2 * kQuarterTurn, {0, 1, 0});
  EXPECT_EQ(draw(mesh, from_behind, shading).color_at(320, 240), expected);
}

TEST_F(MeshRendererTest, InterpolatesColoursLinearlyInTheImage) {
  const auto corner = [](float x, float y, float albedo) {
    return MeshVertex{{x, y, 0}, {0, 0, -1}, {0, 0}, {albedo, albedo, albedo}};
  };
  const auto mesh = std::make_shared<TriangleMesh>(
      std::vector<MeshVertex>{corner(-100, -100, 0.2F), corner(100, -100, 0.5F),
                              corner(100, 100, 0.8F), corner(-100, 100, 0.5F)},
      std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  const Pose pose = turned(at(0, 0, 400), 1.0, {0, 1, 0});
  const CameraModel camera = vga_camera();
  const Eigen::Vector2d halfway = 0.5 * (camera.project(pose * Eigen::Vector3d(-100, -100, 0)) +
                                         camera.project(pose * Eigen::Vector3d(100, 100, 0)));
  // Interpolated in space instead, the colour would be 0.2 + 0.6 * 0.71.
  EXPECT_NEAR(draw(mesh, pose, flat()).color_at(halfway.x(), halfway.y())[0], 0.5 * 255, 2);
}

TEST_F(MeshRendererTest, HidesWhatLiesBehind) {
  const auto square = [](float z, float albedo) {
    std::vector<MeshVertex> corners;
    for (const auto& [x, y] : {std::pair{-50.F, -50.F}, {50.F, -50.F}, {50.F, 50.F}}) {
      corners.push_back({{x, y, z}, {0, 0, -1}, {0, 0}, {albedo, albedo, albedo}});
    }
    return corners;
  };
  for (const bool near_first : {true, false}) {
    std::vector<MeshVertex> vertices = square(near_first ? -1.F : 1.F, near_first ? 1.F : 0.2F);
    const auto other = square(near_first ? 1.F : -1.F, near_first ? 0.2F : 1.F);
    vertices.insert(vertices.end(), other.begin(), other.end());
    const auto mesh =
        std::make_shared<TriangleMesh>(vertices, std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(draw(mesh, at(0, 0, 500), flat()).color_at(330, 230), cv::Vec3b(255, 255, 255));
  }
}

cv::Mat noise(int side_px) {
  cv::Mat image(side_px, side_px, CV_8UC3);
  cv::RNG generator(7);
  generator.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

TEST_F(MeshRendererTest, ShowsTheTextureTheRightWayUp) {
  // One texel a pixel and centre on centre: the picture is the texture.
  const auto mesh = make_rectangle(128, 128, noise(128));
  const Picture picture = draw(mesh, at(0.5, 0.5, 500), flat());
  const cv::Rect box(257, 177, 128, 128);
  ASSERT_EQ(picture.box(), box);
  EXPECT_EQ(cv::norm(picture.color(box), mesh->texture_levels()[0], cv::NORM_INF), 0);
}

TEST_F(MeshRendererTest, TakesTheTextureLevelOfTheObjectsDistance) {
  const auto mesh = make_rectangle(128, 128, noise(256));
  const Picture picture = draw(mesh, at(0.5, 0.5, 500), flat());
  EXPECT_EQ(cv::norm(picture.color(picture.box()), mesh->texture_levels()[1], cv::NORM_INF), 0);
}

TEST_F(MeshRendererTest, MultipliesTextureAlbedoAndLight) {
  const auto mesh =
      make_rectangle(100, 100, cv::Mat(8, 8, CV_8UC3, cv::Scalar(200, 100, 50)), {0.8F, 1, 1});
  Shading shading = flat();
  shading.ambient = 0.6F;
  EXPECT_EQ(draw(mesh, at(0, 0, 500), shading).color_at(320, 240), cv::Vec3b(96, 60, 30));
  EXPECT_EQ(draw(mesh, at(0, 0, 500), shading, false).color_at(320, 240), cv::Vec3b(122, 153, 153))
      << "without texture";
}

TEST_F(MeshRendererTest, DrawsTheSameColoursWithoutDepth) {
  MeshRenderer renderer(make_torus(), vga_camera());
  const Pose pose = turned(at(10, 5, 300), 0.8, {1, 0.5, 0});
  Picture picture;
  renderer.render(pose, {}, picture.color, picture.depth_mm);
  cv::Mat color;
  renderer.render_color(pose, {}, color);
  EXPECT_EQ(cv::norm(color, picture.color, cv::NORM_INF), 0);
}

TEST_F(MeshRendererTest, WorksOnSeveralThreadsAtOnce) {
  const auto mesh = make_torus();
  const auto draw_many = [&](std::vector<cv::Mat>& pictures) {
    MeshRenderer renderer(mesh, vga_camera());
    cv::Mat depth_mm;
    for (cv::Mat& picture : pictures) {
      const auto turn = static_cast<double>(&picture - pictures.data());
      renderer.render(turned(at(0, 0, 300), 0.3 * turn, {1, 1, 0}), {}, picture, depth_mm);
    }
  };
  std::vector<cv::Mat> alone(10), first(10), second(10);
  draw_many(alone);
  std::thread thread([&] { draw_many(first); });
  draw_many(second);
  thread.join();
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(cv::norm(alone[i], first[i], cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(alone[i], second[i], cv::NORM_INF), 0);
  }
}

TEST_F(MeshRendererTest, MovesFromThreadToThread) {
  MeshRenderer renderer(make_torus(), vga_camera());
  cv::Mat here;
  renderer.render_color(at(0, 0, 300), {}, here);
  cv::Mat there;
  std::thread([&] { renderer.render_color(at(0, 0, 300), {}, there); }).join();
  EXPECT_EQ(cv::norm(here, there, cv::NORM_INF), 0);
}

TEST_F(MeshRendererTest, RefusesAMissingMeshAndAnAbsurdCamera) {
  EXPECT_THROW(MeshRenderer(nullptr, vga_camera()), ConfigError);
  CameraModel camera = vga_camera();
  camera.fx_px = 0;
  EXPECT_THROW(MeshRenderer(make_torus(), camera), ConfigError);
}

}  // namespace
}  // namespace anneal6d
