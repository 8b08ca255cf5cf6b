// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "contour_kernels.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "anneal6d/framework/pose.h"
#include "instruction_sets.h"
#include "twist.h"

namespace anneal6d {
namespace {

constexpr double kFx = 700, kFy = 690, kCx = 150, kCy = 120;
constexpr double kNear_mm = 10, kLastX = 300, kLastY = 230;
constexpr std::size_t kMost = 75;

/// Numbers of contour points, and the pointers that kernels want.
struct Rows {
  std::array<std::array<float, kMost + LineJob::kPadding>, 22> numbers{};

  ProjectedContour points() {
    auto* row = numbers.data();
    const auto next = [&] { return (row++)->data(); };
    return {next(), next(), next(), next(), next(), next(), next(),
            next(), next(), next(), next(), next(), next()};
  }
  LineCandidates candidates() {
    LineCandidates all;
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      all.offset_px[k] = numbers[13 + 3 * k].data();
      all.weight[k] = numbers[14 + 3 * k].data();
      all.log_score[k] = numbers[15 + 3 * k].data();
    }
    return all;
  }
};

double uniform(double from, double to) {
  static std::mt19937 random(11);
  return std::uniform_real_distribution<double>(from, to)(random);
}

Eigen::Vector3d random_vector(double size) {
  return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
}

std::vector<ContourSample> random_samples() {
  std::vector<ContourSample> samples(kMost);
  for (ContourSample& sample : samples) {
    sample.object_mm = random_vector(80).cast<float>();
    sample.normal = random_vector(1).normalized().cast<float>();
    sample.curve_mm = static_cast<float>(uniform(0, 20));
    sample.inside_mm = static_cast<float>(uniform(0, 20));
    sample.outside_mm = static_cast<float>(uniform(0, 20));
    sample.shift_px = static_cast<float>(uniform(-1, 1));
    sample.trust = static_cast<float>(std::min(1.0, uniform(0, 2)));
    sample.silhouette = uniform(0, 1) < 0.5;
    sample.polarity = static_cast<int>(uniform(0, 3)) - 1;
  }
  return samples;
}

Eigen::Vector2d projected(const Eigen::Vector3d& p) {
  return {kFx * p.x() / p.z() + kCx, kFy * p.y() / p.z() + kCy};
}

ProjectionJob job_of(const Pose& camera_from_object, std::span<const ContourSample> samples) {
  ProjectionJob job{.samples = samples,
                    .rotation = {},
                    .translation_mm = {},
                    .eye_mm = {},
                    .fx = kFx,
                    .fy = kFy,
                    .cx = kCx,
                    .cy = kCy,
                    .near_mm = kNear_mm,
                    .last_x = kLastX,
                    .last_y = kLastY};
  const Eigen::Matrix3d rotation = camera_from_object.rotation.toRotationMatrix();
  const Eigen::Vector3d eye_mm = camera_from_object.inverse().translation_mm;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      job.rotation[static_cast<std::size_t>(3 * i + k)] = static_cast<float>(rotation(i, k));
    }
    job.translation_mm[static_cast<std::size_t>(i)] =
        static_cast<float>(camera_from_object.translation_mm[i]);
    job.eye_mm[static_cast<std::size_t>(i)] = static_cast<float>(eye_mm[i]);
  }
  return job;
}

// Some poses have points outside the picture, or behind the camera.
TEST(ProjectedContour, IsWhatGeometrySays) {
  const std::vector<ContourSample> samples = random_samples();
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(0, 0, 600), Eigen::Vector3d(120, -60, 500), Eigen::Vector3d(5, 5, 75)}) {
    const Pose pose{rotation_from_vector(random_vector(2)), place};
    const Eigen::Vector3d eye_mm = pose.inverse().translation_mm;
    for (const std::int64_t target : test::instruction_sets()) {
      const test::OnInstructionSet on(target);
      SCOPED_TRACE(hwy::TargetName(target));
      Rows rows;
      const ProjectedContour points = rows.points();
      const std::size_t count = project_contour(job_of(pose, samples), points);
      std::size_t seen = 0;
      for (const ContourSample& sample : samples) {
        // The contour of a round surface lies where its normal is square to the line of sight.
        const Eigen::Vector3d normal = sample.normal.cast<double>();
        Eigen::Vector3d object_mm = sample.object_mm.cast<double>();
        const Eigen::Vector3d sight = (object_mm - eye_mm).normalized();
        const Eigen::Vector3d turned = (normal - normal.dot(sight) * sight).normalized();
        object_mm += sample.curve_mm * (turned - normal);
        const Eigen::Vector3d camera_mm = pose * object_mm;
        const Eigen::Vector2d image_px = projected(camera_mm);
        if (camera_mm.z() < kNear_mm || !(image_px.x() > 1 && image_px.x() < kLastX) ||
            !(image_px.y() > 1 && image_px.y() < kLastY)) {
          continue;
        }
        ASSERT_LT(seen, count);
        constexpr double kStep_mm = 1e-4;
        const Eigen::Vector2d across =
            (projected(camera_mm + kStep_mm * (pose.rotation * turned)) - image_px) / kStep_mm;
        const double px_per_mm = across.norm();
        EXPECT_NEAR(points.camera_x[seen], camera_mm.x(), 1e-3);
        EXPECT_NEAR(points.camera_y[seen], camera_mm.y(), 1e-3);
        EXPECT_NEAR(points.camera_z[seen], camera_mm.z(), 1e-3);
        EXPECT_NEAR(points.image_x[seen], image_px.x(), 5e-3);
        EXPECT_NEAR(points.image_y[seen], image_px.y(), 5e-3);
        EXPECT_NEAR(points.normal_x[seen], across.x() / px_per_mm, 1e-3);
        EXPECT_NEAR(points.normal_y[seen], across.y() / px_per_mm, 1e-3);
        const bool shaded = sample.silhouette && sample.trust == 1;
        EXPECT_EQ(points.shift_px[seen], shaded ? 0 : sample.shift_px);
        EXPECT_EQ(points.shading_px[seen], shaded ? sample.shift_px : 0);
        EXPECT_EQ(points.trust[seen], sample.trust);
        EXPECT_EQ(points.polarity[seen], static_cast<float>(sample.polarity));
        if (sample.silhouette) {
          EXPECT_NEAR(points.inside_px[seen] / (sample.inside_mm * px_per_mm), 1, 2e-3);
          EXPECT_NEAR(points.outside_px[seen] / (sample.outside_mm * px_per_mm), 1, 2e-3);
        } else {
          EXPECT_LT(points.inside_px[seen], 0) << "colours say nothing";
        }
        ++seen;
      }
      EXPECT_EQ(seen, count);
      EXPECT_GT(count, 3U);
    }
  }
}

TEST(StepOfAContour, SumsTheNormalEquationsOfTheBestCandidates) {
  const std::vector<ContourSample> samples = random_samples();
  const Pose pose{rotation_from_vector({0.3, -0.4, 1.2}), {10, -5, 600}};
  Rows rows;
  StepJob job{.points = rows.points(),
              .candidates = rows.candidates(),
              .count = 0,
              .center_mm = {10, -5, 600},
              .motion = {0.01F, -0.005F, 0.008F, 1.0F, -0.5F, 2.0F},
              .fx = kFx,
              .fy = kFy,
              .cutoff_px = 6};
  job.count = project_contour(job_of(pose, samples), job.points);
  ASSERT_GT(job.count, 40U);
  Twist motion;
  for (int i = 0; i < 6; ++i) motion[i] = job.motion[static_cast<std::size_t>(i)];
  for (std::size_t i = 0; i < job.count; ++i) {
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      job.candidates.offset_px[k][i] = static_cast<float>(uniform(-9, 9));
      job.candidates.weight[k][i] = static_cast<float>(uniform(0, 1));
      job.candidates.log_score[k][i] = static_cast<float>(uniform(-2, 0));
    }
  }

  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Twist right = Twist::Zero(), sweep = Twist::Zero();
  double whole = 0;
  for (std::size_t i = 0; i < job.count; ++i) {
    const Eigen::Vector3d p(job.points.camera_x[i], job.points.camera_y[i], job.points.camera_z[i]);
    const Eigen::Vector2d across(job.points.normal_x[i], job.points.normal_y[i]);
    // How each entry of a twist about the centre moves the point in the image.
    Eigen::Matrix<double, 2, 6> ways;
    for (int k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-5;
      const Pose center{Eigen::Quaterniond::Identity(), pose.translation_mm};
      const Eigen::Vector3d there = moved(center, kStep * Twist::Unit(k)) * (center.inverse() * p);
      ways.col(k) = (projected(there) - projected(p)) / kStep;
    }
    const Twist jacobian = ways.transpose() * across;
    double best = -1e9, residual_px = 0, weight = 0;
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      const double distance_px = job.candidates.offset_px[k][i] - jacobian.dot(motion);
      const double score =
          job.candidates.log_score[k][i] - std::pow(distance_px / job.cutoff_px, 2);
      if (score <= best) continue;
      best = score;
      residual_px = distance_px;
      weight = job.candidates.weight[k][i];
    }
    if (std::abs(residual_px) >= job.cutoff_px) continue;
    weight *= job.points.trust[i] * std::pow(1 - std::pow(residual_px / job.cutoff_px, 2), 2);
    normal += weight * jacobian * jacobian.transpose();
    right += weight * residual_px * jacobian;
    sweep += weight * ways.colwise().squaredNorm().transpose();
    whole += weight;
  }
  ASSERT_GT(whole, 3);

  for (const std::int64_t target : test::instruction_sets()) {
    const test::OnInstructionSet on(target);
    SCOPED_TRACE(hwy::TargetName(target));
    const StepSums sums = sum_step(job);
    std::size_t entry = 0;
    for (int k = 0; k < 6; ++k) {
      const auto place = static_cast<std::size_t>(k);
      for (int j = k; j < 6; ++j, ++entry) {
        EXPECT_NEAR(sums.normal[entry], normal(k, j), 1e-3 * std::sqrt(normal(k, k) * normal(j, j)))
            << k << ", " << j;
      }
      EXPECT_NEAR(sums.right[place], right[k], 2e-3 * std::sqrt(normal(k, k) * whole) * 6) << k;
      EXPECT_NEAR(sums.sweep[place], sweep[k], 1e-3 * sweep[k]) << k;
    }
    EXPECT_NEAR(sums.weight, whole, 1e-3 * whole);
  }
}

}  // namespace
}  // namespace anneal6d
