// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "motion_model.h"

#include <gtest/gtest.h>

#include "synthetic.h"

namespace anneal6d {
namespace {

constexpr double kSigma_mm = 5, kSigma_rad = 0.035;

Twist steady_motion() {
  Twist motion;
  motion << 0.02, -0.01, 0.015, 4.0, -3.0, 1.0;
  return motion;
}

Twist random_motion(std::uint32_t frame) {
  Twist motion;
  for (std::uint32_t pair = 0; pair < 3; ++pair) {
    const auto normals = random_normals({.seed = 21, .frame = frame}, pair);
    motion[2 * pair] = normals[0];
    motion[2 * pair + 1] = normals[1];
  }
  motion.head<3>() *= kSigma_rad;
  motion.tail<3>() *= kSigma_mm;
  return motion;
}

/// Moves on by a twist and lets the model see it.
void go(MotionModel& model, Pose& pose, const Twist& motion) {
  const Pose next = moved(pose, motion);
  model.observe(pose, next);
  pose = next;
}

TEST(MotionModelAtStart, ExpectsNoMotionWithTheGivenNoise) {
  const MotionModel model(kSigma_mm, kSigma_rad);
  EXPECT_TRUE(model.drift().isZero());
  // The noise is at least what was asked for, and not much more.
  for (int i = 0; i < 3; ++i) {
    EXPECT_GE(model.sigma()[i], kSigma_rad);
    EXPECT_LE(model.sigma()[i], 2 * kSigma_rad);
    EXPECT_GE(model.sigma()[i + 3], kSigma_mm);
    EXPECT_LE(model.sigma()[i + 3], 2 * kSigma_mm);
  }
}

TEST(MotionModelOfSteadyMotion, ExpectsItToGoOnWithLessNoise) {
  MotionModel model(kSigma_mm, kSigma_rad);
  const Twist initial_sigma = model.sigma();
  Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 500}};
  for (int i = 0; i < 40; ++i) go(model, pose, steady_motion());
  EXPECT_LT((model.drift() - steady_motion()).norm(), 0.05 * steady_motion().norm());
  EXPECT_TRUE((model.sigma().array() < initial_sigma.array()).all());
  EXPECT_TRUE((model.sigma().array() > 0).all());
}

TEST(MotionModelOfARandomWalk, ExpectsHardlyAnyOfTheLastMotion) {
  MotionModel model(kSigma_mm, kSigma_rad);
  Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 500}};
  double share[2] = {};
  constexpr std::uint32_t kFrames = 300;
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    const Twist motion = random_motion(frame);
    go(model, pose, motion);
    share[0] += model.drift().head<3>().norm() / motion.head<3>().norm() / kFrames;
    share[1] += model.drift().tail<3>().norm() / motion.tail<3>().norm() / kFrames;
  }
  EXPECT_LT(share[0], 0.2);
  EXPECT_LT(share[1], 0.2);
}

TEST(MotionModelOfARandomWalk, ExpectsNoiseOfItsStep) {
  MotionModel model(kSigma_mm, kSigma_rad);
  Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 500}};
  for (std::uint32_t frame = 0; frame < 100; ++frame) go(model, pose, random_motion(frame));
  EXPECT_GT(model.sigma()[0], 0.7 * kSigma_rad);
  EXPECT_LT(model.sigma()[0], 2.5 * kSigma_rad);
  EXPECT_GT(model.sigma()[5], 0.7 * kSigma_mm);
  EXPECT_LT(model.sigma()[5], 2.5 * kSigma_mm);
}

TEST(MotionModelOfMixedMotion, LearnsRotationAndTranslationApart) {
  MotionModel model(kSigma_mm, kSigma_rad);
  Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 500}};
  double turning = 0;
  for (std::uint32_t frame = 0; frame < 100; ++frame) {
    Twist motion = random_motion(frame);
    motion.tail<3>() = steady_motion().tail<3>();
    go(model, pose, motion);
    turning += model.drift().head<3>().norm() / motion.head<3>().norm() / 100;
  }
  EXPECT_LT((model.drift() - steady_motion()).tail<3>().norm(), 0.3);
  EXPECT_LT(turning, 0.3);
}

TEST(MotionModelReset, ForgetsWhatWasSeen) {
  MotionModel model(kSigma_mm, kSigma_rad);
  Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 500}};
  for (int i = 0; i < 20; ++i) go(model, pose, steady_motion());
  model.reset();
  const MotionModel fresh(kSigma_mm, kSigma_rad);
  EXPECT_EQ(model.drift(), fresh.drift());
  EXPECT_EQ(model.sigma(), fresh.sigma());
}

TEST(MotionModelOfAStillObject, StaysReadyForMotion) {
  MotionModel model(kSigma_mm, kSigma_rad);
  Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 500}};
  for (int i = 0; i < 200; ++i) go(model, pose, Twist::Zero());
  EXPECT_TRUE(model.drift().allFinite());
  EXPECT_LT(model.drift().norm(), 1e-6);
  EXPECT_GT(model.sigma()[0], 0.1 * kSigma_rad);
  EXPECT_GT(model.sigma()[5], 0.1 * kSigma_mm);
}

TEST(MotionSeenLately, HasNeitherMarginNorBounds) {
  MotionModel model(kSigma_mm, kSigma_rad);
  Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 500}};
  for (int i = 0; i < 200; ++i) go(model, pose, Twist::Zero());
  EXPECT_LT(model.seen_sigma()[0], 1e-3 * kSigma_rad) << "it stood still";
  EXPECT_LT(model.seen_sigma()[5], 1e-3 * kSigma_mm);
  // To and fro, so that no motion tells the next.
  Twist leap;
  leap << 0, 0, 0.3, 0, 100, 0;
  for (int i = 0; i < 200; ++i) go(model, pose, i % 2 ? leap : -leap);
  // The mean of three axes of which one is moved along.
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(model.seen_sigma()[i], 0.3 / std::sqrt(3.0), 1e-3);
    EXPECT_NEAR(model.seen_sigma()[i + 3], 100 / std::sqrt(3.0), 0.1);
  }
}

TEST(MotionSeenLately, IsWhatTheMotionIsExpectedToBeButForTheMargin) {
  MotionModel model(kSigma_mm, kSigma_rad);
  Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 500}};
  for (std::uint32_t frame = 0; frame < 100; ++frame) go(model, pose, random_motion(frame));
  const Twist margin = model.sigma().cwiseQuotient(model.seen_sigma());
  for (int i = 0; i < 6; ++i) {
    EXPECT_GT(margin[i], 1.1);
    EXPECT_LT(margin[i], 1.6);
    EXPECT_NEAR(margin[i], margin[0], 1e-9);
  }
}

TEST(Twist, MovesFromOnePoseToAnother) {
  const Pose from{rotation_from_axis_angle({1, 2, 3}, 0.5), {10, 20, 300}};
  const Pose to = moved(from, steady_motion());
  EXPECT_LT((twist_between(from, to) - steady_motion()).norm(), 1e-12);
  const Pose back = moved(from, twist_between(from, to));
  EXPECT_LT(test::angle_deg(back, to), 1e-9);
}

}  // namespace
}  // namespace anneal6d
