// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/capture/simulation_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "anneal6d/framework/srgb.h"
#include "capture_test_support.h"
#include "flat_renderer.h"

namespace anneal6d {
namespace {

using test::contains;
using test::make_box;
using test::make_flat_renderer;
using test::message_of;

CameraModel small_camera() { return {160, 120, 160, 160, 79.5, 59.5, {}}; }

SimulationSource simulate(const SimulationOptions& options,
                          const CameraModel& camera = small_camera(),
                          std::shared_ptr<const TriangleMesh> mesh = make_box({80, 80, 80})) {
  return {std::move(mesh), camera, options, make_flat_renderer};
}

double light_of(int grey) { return decoded_srgb(grey / 255.0); }

// Share of each pixel that the object covers, from a picture of FlatRenderer's grey on black: light
// is mixed, not grey levels.
cv::Mat coverage(const cv::Mat& image) {
  cv::Mat channel, result;
  cv::extractChannel(image, channel, 0);
  cv::Mat table(1, 256, CV_64FC1);
  for (int grey = 0; grey < 256; ++grey) {
    table.at<double>(grey) = light_of(grey) / light_of(test::FlatRenderer::kGrey);
  }
  cv::LUT(channel, table, result);
  return result;
}

Eigen::Vector2d centroid(const cv::Mat& weights) {
  double sum = 0, x_sum = 0, y_sum = 0;
  for (int y = 0; y < weights.rows; ++y) {
    for (int x = 0; x < weights.cols; ++x) {
      const double w = weights.at<double>(y, x);
      sum += w;
      x_sum += w * x;
      y_sum += w * y;
    }
  }
  return {x_sum / sum, y_sum / sum};
}

bool same_pixels(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

TEST(SimulationSource, ShowsAFlatSquareWithItsCentreWhereTheTruthProjects) {
  const auto plate = make_box({90, 60, 0.01F});
  for (const Eigen::Vector3d& offset :
       {Eigen::Vector3d(0, 0, 300), Eigen::Vector3d(31.3, -17.7, 390),
        Eigen::Vector3d(-44.1, 20.9, 277)}) {
    SimulationOptions options;
    options.supersampling = 8;
    options.start = Pose{Eigen::Quaterniond::Identity(), offset};
    SimulationSource source = simulate(options, small_camera(), plate);
    const Frame frame = *source.next();
    const Eigen::Vector2d expected = small_camera().project(source.ground_truth()->translation_mm);
    // Both edges of the square may be rounded to the dense grid in the same direction.
    const double rounding_px = 0.5 / options.supersampling;
    EXPECT_LT((centroid(coverage(frame.image)) - expected).lpNorm<Eigen::Infinity>(),
              rounding_px + 0.005);
  }
}

TEST(SimulationSource, ShowsTheSilhouetteThatTheTruthGivesInEveryFrame) {
  SimulationOptions options;
  options.frames = 12;
  options.sigma_deg = 10;
  const CameraModel camera = small_camera();
  const auto box = make_box({80, 50, 30}, {10, 20, -5});
  SimulationSource source = simulate(options, camera, box);
  constexpr int density = 16;
  const auto dense = make_flat_renderer(box, camera.scaled(density));
  while (const auto frame = source.next()) {
    cv::Mat color, depth;
    dense->render(*source.ground_truth(), {}, color, depth);
    cv::Mat silhouette;
    cv::Mat(depth > 0).convertTo(silhouette, CV_64F, 1.0 / 255);
    const Eigen::Vector2d expected =
        ((centroid(silhouette).array() + 0.5) / density - 0.5).matrix();
    const cv::Mat shown = coverage(frame->image);
    EXPECT_LT((centroid(shown) - expected).norm(), 0.05) << "frame " << frame->index;
    EXPECT_NEAR(cv::sum(shown)[0], cv::sum(silhouette)[0] / (density * density),
                0.01 * cv::sum(shown)[0]);
  }
}

TEST(SimulationSource, DistortsThePictureAsTheCameraDoes) {
  CameraModel camera = small_camera();
  camera.distortion = {-0.5, 0.2, 0.001, -0.002, 0};
  SimulationOptions options;
  const Eigen::Vector3d corner(90, 60, 300);
  options.start = Pose{Eigen::Quaterniond::Identity(), corner};
  SimulationSource source = simulate(options, camera, make_box({16, 16, 0.01F}));
  const Frame frame = *source.next();
  std::vector<cv::Point2d> projected;
  cv::projectPoints(std::vector<cv::Point3d>{{corner.x(), corner.y(), corner.z()}},
                    cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), camera.matrix(), camera.distortion,
                    projected);
  const Eigen::Vector2d expected(projected[0].x, projected[0].y);
  EXPECT_GT((camera.project(corner) - expected).norm(), 3);  // the distortion matters here
  EXPECT_LT((centroid(coverage(frame.image)) - expected).norm(), 0.1);
}

TEST(SimulationSource, GivesTheSamePixelsForTheSameSeedAndOthersForAnother) {
  SimulationOptions options;
  options.frames = 4;
  options.background = "clutter";
  options.noise = 4;
  options.occluder = true;
  SimulationSource first = simulate(options);
  SimulationSource second = simulate(options);
  options.seed = 2;
  SimulationSource other = simulate(options);
  while (const auto frame = first.next()) {
    EXPECT_TRUE(same_pixels(frame->image, second.next()->image));
    EXPECT_FALSE(same_pixels(frame->image, other.next()->image));
  }
}

TEST(SimulationSource, SkipsToTheFrameThatReadingThemAllWouldGive) {
  SimulationOptions options;
  options.frames = 10;
  options.noise = 2;
  options.occluder = true;
  SimulationSource all = simulate(options);
  SimulationSource skipping = simulate(options);
  for (int i = 0; i < 6; ++i) all.next();
  EXPECT_EQ(skipping.skip(6), 6);
  const Frame expected = *all.next();
  const Frame skipped = *skipping.next();
  EXPECT_EQ(skipped.index, 6);
  EXPECT_TRUE(same_pixels(skipped.image, expected.image));
  EXPECT_EQ(skipping.ground_truth()->translation_mm, all.ground_truth()->translation_mm);
  EXPECT_EQ(skipping.skip(10), 3);
  EXPECT_FALSE(skipping.next());
}

TEST(SimulationSource, AddsNoiseOfTheStrengthAskedFor) {
  SimulationOptions options;
  options.start = Pose{Eigen::Quaterniond::Identity(), {0, 0, 400}};
  const Frame clean = *simulate(options).next();
  cv::Mat clean_grey, grey;
  cv::extractChannel(clean.image, clean_grey, 0);
  // On the object: before black, half of the noise is cut off.
  const cv::Mat object = clean_grey == test::FlatRenderer::kGrey;
  for (const double sigma : {2.0, 7.5}) {
    options.noise = sigma;
    SimulationSource source = simulate(options);
    cv::Mat difference;
    cv::extractChannel(source.next()->image, grey, 0);
    cv::subtract(grey, clean_grey, difference, cv::noArray(), CV_64F);
    cv::Scalar mean, deviation;
    cv::meanStdDev(difference, mean, deviation, object);
    const double standard_error = sigma / std::sqrt(cv::countNonZero(object));
    EXPECT_NEAR(mean[0], 0, 4 * standard_error);
    EXPECT_NEAR(deviation[0], sigma, 0.03 * sigma);
  }
}

TEST(SimulationSource, CoversTheObjectByTheOccluderAtSomeTimeAndNotAtAnother) {
  SimulationOptions options;
  options.frames = 100;
  options.sigma_mm = options.sigma_deg = 0;
  SimulationSource without = simulate(options);
  const cv::Mat object = coverage(without.next()->image) > 0.99;
  options.occluder = true;
  SimulationSource with = simulate(options);
  double least = 1, most = 0;
  while (const auto frame = with.next()) {
    cv::Mat channel;
    cv::extractChannel(frame->image, channel, 0);
    cv::Mat seen = (channel == test::FlatRenderer::kGrey) & object;
    const double hidden =
        1 - static_cast<double>(cv::countNonZero(seen)) / cv::countNonZero(object);
    least = std::min(least, hidden);
    most = std::max(most, hidden);
  }
  EXPECT_EQ(least, 0);
  EXPECT_GT(most, 0.3);
  EXPECT_LT(most, 0.8);
}

TEST(SimulationSource, SwingsTheBrightnessIfTheLightChanges) {
  SimulationOptions options;
  options.frames = 60;
  options.light = SimulatedLight::changing;
  SimulationSource source = simulate(options);
  const auto brightest = [&] {
    double grey = 0;
    cv::minMaxLoc(source.next()->image.reshape(1), nullptr, &grey);
    return light_of(static_cast<int>(grey));
  };
  const double first = brightest();
  source.skip(14);
  EXPECT_NEAR(brightest() / first, 4.0 / 3, 0.02);
}

TEST(SimulationSource, BlursTheObjectAlongItsMotionAboutTheTrueCentre) {
  SimulationOptions options;
  options.frames = 40;
  options.motion = SimulatedMotion::manipulation;
  options.sigma_mm = 15;
  options.sigma_deg = 0;
  options.start = Pose{Eigen::Quaterniond::Identity(), {0, 0, 400}};
  const auto plate = make_box({60, 60, 0.01F});
  SimulationSource sharp = simulate(options, small_camera(), plate);
  options.blur = 1;
  SimulationSource blurred = simulate(options, small_camera(), plate);
  sharp.skip(10);
  blurred.skip(10);
  const cv::Mat a = coverage(sharp.next()->image);
  const cv::Mat b = coverage(blurred.next()->image);
  const auto partly = [](const cv::Mat& shares) {
    return cv::countNonZero((shares > 0.05) & (shares < 0.95));
  };
  EXPECT_GT(partly(b), 2 * partly(a));
  EXPECT_LT((centroid(a) - centroid(b)).norm(), 0.3);
}

TEST(SimulationSource, FillsTheFrameWithTheBackgroundImage) {
  test::TemporaryFolder folder;
  cv::Mat picture(50, 200, CV_8UC3, cv::Scalar(10, 20, 30));
  picture.colRange(100, 200).setTo(cv::Scalar(200, 210, 220));
  cv::imwrite((folder / "wall.png").string(), picture);
  SimulationOptions options;
  options.background = (folder / "wall.png").string();
  const cv::Mat image = simulate(options).next()->image;
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(image.at<cv::Vec3b>(119, 159), cv::Vec3b(200, 210, 220));
  options.background = (folder / "none.png").string();
  EXPECT_TRUE(contains(message_of<FileError>([&] { simulate(options); }), "none.png"));
}

TEST(SimulationSource, StartsWithTheObjectInTheMiddleAtFortyPercentOfTheHeight) {
  const auto box = make_box({30, 140, 60}, {100, -50, 20});
  const CameraModel camera = default_simulation_camera();
  const Pose start = default_start_pose(*box, camera);
  const Eigen::Vector3d center = start * box->center_mm().cast<double>();
  EXPECT_NEAR(camera.project(center).x(), camera.cx_px, 1e-3);
  EXPECT_NEAR(camera.project(center).y(), camera.cy_px, 1e-3);
  EXPECT_NEAR(camera.fy_px * box->diameter_mm() / center.z(), 0.4 * camera.height_px, 1e-2);
  const Eigen::Vector3d up = start.rotation * Eigen::Vector3d::UnitY();
  EXPECT_LT(up.y(), -0.8);  // upright
  EXPECT_LT(up.z(), -0.3);  // seen from above
}

TEST(SimulationSource, RefusesToRunWithoutModelOrRendererOrBehindTheCamera) {
  EXPECT_THROW(SimulationSource(nullptr, small_camera(), {}, make_flat_renderer), ConfigError);
  EXPECT_THROW(SimulationSource(make_box({9, 9, 9}), small_camera(), {}, {}), ConfigError);
  SimulationOptions options;
  options.start = Pose{Eigen::Quaterniond::Identity(), {0, 0, -400}};
  EXPECT_TRUE(contains(message_of<ConfigError>([&] { simulate(options); }), "behind"));
}

}  // namespace
}  // namespace anneal6d
