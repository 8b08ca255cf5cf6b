// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "anneal6d/capture/simulation_source.h"
#include "capture_test_support.h"
#include "flat_renderer.h"

namespace anneal6d {
namespace {

using test::contains;
using test::make_box;
using test::message_of;

const CameraModel kCamera{640, 480, 650, 650, 319.5, 239.5, {}};

// The true poses of a simulation, without drawing it.
std::vector<Pose> trajectory(const SimulationOptions& options,
                             const std::shared_ptr<const TriangleMesh>& mesh) {
  SimulationSource source(mesh, kCamera, options, test::make_flat_renderer);
  std::vector<Pose> poses;
  while (source.skip(1) == 1) poses.push_back(*source.ground_truth());
  return poses;
}

struct StepStatistics {
  Eigen::Vector3d mean_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d rms_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_deg = Eigen::Vector3d::Zero();
  Eigen::Vector3d rms_deg = Eigen::Vector3d::Zero();
};

// Of the translation and of the rotation applied from the left, in the camera frame.
StepStatistics statistics_of(const std::vector<Pose>& poses) {
  StepStatistics result;
  const auto count = static_cast<double>(poses.size() - 1);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Vector3d step = poses[i].translation_mm - poses[i - 1].translation_mm;
    const Eigen::Vector3d turn =
        rotation_vector_from(poses[i].rotation * poses[i - 1].rotation.conjugate()) * 180 /
        std::numbers::pi;
    result.mean_mm += step / count;
    result.rms_mm += step.cwiseAbs2() / count;
    result.mean_deg += turn / count;
    result.rms_deg += turn.cwiseAbs2() / count;
  }
  result.rms_mm = result.rms_mm.cwiseSqrt();
  result.rms_deg = result.rms_deg.cwiseSqrt();
  return result;
}

TEST(SimulatedRandomWalk, StepsByTheSigmasAskedForOnEveryAxis) {
  SimulationOptions options;
  options.frames = 4000;
  const StepStatistics steps = statistics_of(trajectory(options, make_box({60, 90, 60})));
  for (int axis = 0; axis < 3; ++axis) {
    // Six standard deviations of the estimates.
    EXPECT_NEAR(steps.rms_mm[axis], 5, 6 * 5 / std::sqrt(2.0 * 4000));
    EXPECT_NEAR(steps.rms_deg[axis], 2, 6 * 2 / std::sqrt(2.0 * 4000));
    EXPECT_NEAR(steps.mean_mm[axis], 0, 6 * 5 / std::sqrt(4000.0));
    EXPECT_NEAR(steps.mean_deg[axis], 0, 6 * 2 / std::sqrt(4000.0));
  }
}

TEST(SimulatedRandomWalk, StartsAtTheStartPose) {
  SimulationOptions options;
  options.start = Pose{rotation_from_axis_angle({1, 2, 3}, 0.5), {10, -20, 600}};
  const std::vector<Pose> poses = trajectory(options, make_box({60, 90, 60}));
  ASSERT_EQ(poses.size(), 100U);
  EXPECT_EQ(poses[0].translation_mm, options.start->translation_mm);
  EXPECT_EQ(poses[0].rotation.coeffs(), options.start->rotation.coeffs());
}

class SimulatedMotionOf : public testing::TestWithParam<SimulatedMotion> {};

TEST_P(SimulatedMotionOf, KeepsTheObjectInView) {
  const auto box = make_box({60, 90, 60}, {200, 0, 0});  // far from the model's origin
  SimulationOptions options;
  options.motion = GetParam();
  options.frames = 5000;
  options.sigma_mm = 12;
  const std::vector<Pose> poses = trajectory(options, box);
  const Eigen::Vector3d center = box->center_mm().cast<double>();
  const double start_z = (poses[0] * center).z();
  for (const Pose& pose : poses) {
    const Eigen::Vector3d at = pose * center;
    // A turn about a distant origin may carry the centre a little outside before a step leads back.
    EXPECT_GT(at.z(), 0.6 * start_z);
    EXPECT_LT(at.z(), 1.55 * start_z);
    const Eigen::Vector2d pixel = kCamera.project(at);
    EXPECT_GT(pixel.x(), 20);
    EXPECT_LT(pixel.x(), 620);
    EXPECT_GT(pixel.y(), 20);
    EXPECT_LT(pixel.y(), 460);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryMotion, SimulatedMotionOf,
                         testing::Values(SimulatedMotion::random_walk,
                                         SimulatedMotion::manipulation),
                         [](const auto& motion) {
                           return motion.param == SimulatedMotion::random_walk
                                      ? std::string("RandomWalk")
                                      : std::string("Manipulation");
                         });

TEST(SimulatedManipulation, IsSmooth) {
  SimulationOptions options;
  options.motion = SimulatedMotion::manipulation;
  options.frames = 600;
  const std::vector<Pose> poses = trajectory(options, make_box({60, 90, 60}));
  for (std::size_t i = 2; i < poses.size(); ++i) {
    const Eigen::Vector3d bend =
        poses[i].translation_mm - 2 * poses[i - 1].translation_mm + poses[i - 2].translation_mm;
    // Minimum jerk: at most 5.8 distance / duration^2, of which a quarter is taken as the limit of
    // what is drawn (three sigma over the shortest reach).
    EXPECT_LT(bend.norm(), 3 * options.sigma_mm) << "frame " << i;
  }
}

TEST(SimulatedManipulation, MovesAsFastAsTheSigmasSay) {
  SimulationOptions options;
  options.motion = SimulatedMotion::manipulation;
  options.frames = 4000;
  options.sigma_mm = 2;  // little enough to stay clear of the limits most of the time
  const StepStatistics steps = statistics_of(trajectory(options, make_box({60, 90, 60})));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(steps.rms_mm[axis], 2, 0.5);
    EXPECT_NEAR(steps.rms_deg[axis], 2, 0.5);
  }
}

TEST(SimulationOptions, AreReadFromSettingsAndWrittenBack) {
  Settings settings;
  settings.set("motion", "manipulation");
  settings.set("sigma-mm", "0.1");
  settings.set("frames", "7");
  settings.set("seed", "42");
  settings.set("occluder", "on");
  settings.set("light", "moving");
  settings.set("init", "1 2 300 1 0 0 0");
  settings.set("unknown", "is ignored");
  const SimulationOptions options = SimulationOptions::from(settings);
  EXPECT_EQ(options.motion, SimulatedMotion::manipulation);
  EXPECT_DOUBLE_EQ(options.sigma_mm, 0.1);
  EXPECT_EQ(options.frames, 7);
  EXPECT_EQ(options.seed, 42U);
  EXPECT_TRUE(options.occluder);
  EXPECT_EQ(options.light, SimulatedLight::moving);
  EXPECT_DOUBLE_EQ(options.start->translation_mm.z(), 300);

  const Settings written = options.to_settings();
  EXPECT_EQ(*written.text("sigma-mm"), "0.1");
  EXPECT_EQ(SimulationOptions::from(written).to_settings().text("init"), written.text("init"));
  EXPECT_EQ(SimulationOptions::from(written).motion, SimulatedMotion::manipulation);
}

TEST(SimulationOptions, NameTheFieldThatIsBad) {
  SimulationOptions options;
  options.sigma_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contains(message_of<ConfigError>([&] { options.validate(); }), "sigma-deg"));
  options = {};
  options.supersampling = 9;
  EXPECT_TRUE(contains(message_of<ConfigError>([&] { options.validate(); }), "supersampling"));
  options = {};
  options.frames = 0;
  EXPECT_TRUE(contains(message_of<ConfigError>([&] { options.validate(); }), "frames"));
  Settings settings;
  settings.set("motion", "teleport");
  EXPECT_TRUE(
      contains(message_of<ConfigError>([&] { SimulationOptions::from(settings); }), "random-walk"));
}

}  // namespace
}  // namespace anneal6d
