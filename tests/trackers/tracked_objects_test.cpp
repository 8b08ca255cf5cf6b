// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tracking.h"

namespace anneal6d {
namespace {

using test::angle_deg;
using test::center_distance_mm;
using test::Sequence;
using test::SharedMesh;

/// A bowl that is shown still, from obliquely above.
const SharedMesh& bowl() {
  static const SharedMesh mesh = test::make_bowl(50);
  return mesh;
}
Sequence still_bowl(int frames) {
  Sequence sequence;
  const RasterModel model(bowl(), false);
  const Pose truth = test::pose_with_center(
      *bowl(), rotation_from_axis_angle(Eigen::Vector3d::UnitX(), 2.4), {0, 0, 320});
  sequence.truth.assign(static_cast<std::size_t>(frames), truth);
  for (int i = 0; i < frames; ++i) {
    sequence.frames.push_back(
        test::frame_of(test::photograph(model, test::small_camera(), truth, 40, 1.5, i), i));
  }
  return sequence;
}
std::vector<TrackResult> track_bowl(const Sequence& sequence, const Eigen::Vector3d& axis) {
  TrackerSetup setup = test::setup_for(bowl(), {{"particles", "60"}, {"layers", "3"}});
  setup.symmetry.axis = axis;
  const auto tracker = make_plugin(tracker_plugins(), "tracker", "universal", setup);
  return test::track(*tracker, sequence);
}

TEST(UniversalTrackerOfABowl, DoesNotTurnItAboutItsAxis) {
  const Sequence sequence = still_bowl(10);
  const auto results = track_bowl(sequence, Eigen::Vector3d::UnitZ());
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_LT(angle_deg(results[i].camera_from_object, sequence.truth[i]), 1.5) << "frame " << i;
  }
}

// It may turn about its axis, and no edge would show it.
TEST(UniversalTrackerOfABowl, IsUnsureOfItsTurnUnlessItIsKnownToBeRound) {
  const Sequence sequence = still_bowl(10);
  const auto round = track_bowl(sequence, Eigen::Vector3d::UnitZ());
  const auto any = track_bowl(sequence, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < round.size(); ++i) {
    EXPECT_GT(round[i].quality, 0.8) << "frame " << i;
    EXPECT_LT(any[i].quality, round[i].quality) << "frame " << i;
    if (i == 0) continue;
    EXPECT_LT(any[i].quality, any[i - 1].quality + 0.05) << "frame " << i;
  }
  EXPECT_LT(any.back().quality, 0.6);
}

TEST(UniversalTrackerOfAnObjectWithSymmetries, TurnsItAboutItsOrigin) {
  // A box beside its origin. That a turn by ten degrees changes nothing is not true of it, but
  // shows where it is turned about.
  const SharedMesh centered = test::make_box(90, 60, 75);
  std::vector<MeshVertex> vertices(centered->vertices().begin(), centered->vertices().end());
  for (MeshVertex& vertex : vertices) vertex.position_mm.x() += 30;
  const auto box = std::make_shared<const TriangleMesh>(
      vertices, std::vector<Triangle>(centered->triangles().begin(), centered->triangles().end()));
  Sequence sequence = test::moving_sequence(box, 2);
  const Eigen::Quaterniond turn =
      rotation_from_axis_angle(Eigen::Vector3d::UnitZ(), 10 * test::kDegree);
  sequence.truth[0].rotation = sequence.truth[1].rotation * turn;  // where it is said to start

  const auto first_pose = [&](std::vector<Eigen::Quaterniond> symmetries) {
    TrackerSetup setup = test::setup_for(box, {});
    setup.symmetry.rotations = std::move(symmetries);
    return test::track(*make_plugin(tracker_plugins(), "tracker", "universal", setup), sequence)[0]
        .camera_from_object;
  };
  const Pose found = first_pose({}), folded = first_pose({turn});
  EXPECT_LT(folded.rotation.angularDistance(found.rotation * turn), 1e-9);
  EXPECT_LT((folded.translation_mm - found.translation_mm).norm(), 1e-9);
}

TEST(UniversalTrackerWithPixelsThatAreNotSquare, LooksAtAllOfTheObject) {
  const SharedMesh box = test::make_box(60, 90, 60);
  CameraModel camera = test::small_camera();
  camera.fx_px = 150;
  camera.fy_px = 600;
  const RasterModel model(box, false);
  for (const char* mode : {"default", "thesis"}) {
    TrackerSetup setup = test::setup_for(box, {{"mode", mode}});
    setup.camera = camera;
    const auto tracker = make_plugin(tracker_plugins(), "tracker", "universal", setup);
    const Pose truth = test::pose_with_center(
        *box, rotation_from_vector(Eigen::Vector3d(0.3, 0.4, 0)), {0, 0, 360});
    const cv::Mat image = test::photograph(model, camera, truth, 40, 1.5);
    tracker->reset(truth);
    const TrackResult result = tracker->track(test::frame_of(image, 0));
    EXPECT_GT(result.quality, 0.8) << mode;
    EXPECT_LT(center_distance_mm(*box, result.camera_from_object, truth), 2) << mode;
  }
}

/// Mean error along the line of sight of the last frames of a moving cylinder, millimetres.
double depth_error_mm(const Shading& light) {
  const SharedMesh cylinder = test::make_cylinder(110, 30, 64);
  const Sequence sequence = test::moving_sequence(cylinder, 16, 40, light);
  const auto tracker =
      make_plugin(tracker_plugins(), "tracker", "universal", test::setup_for(cylinder, {}));
  const auto results = test::track(*tracker, sequence);
  double sum_mm = 0;
  constexpr std::size_t kLearning = 6;
  for (std::size_t i = kLearning; i < results.size(); ++i) {
    sum_mm +=
        results[i].camera_from_object.translation_mm.z() - sequence.truth[i].translation_mm.z();
  }
  return sum_mm / static_cast<double>(results.size() - kLearning);
}

// The drawing is lit from the camera.
TEST(UniversalTrackerOfACylinder, LearnsHowItIsLit) {
  EXPECT_NEAR(depth_error_mm({}), 0, 0.3);
  EXPECT_NEAR(depth_error_mm({.ambient = 0.9F, .diffuse = 0.0F}), 0, 0.2);
}

// A pose that was told by eye is several pixels and degrees off.
TEST(UniversalTrackerOfABox, StartsFromAboutWhereItIs) {
  const test::SharedMesh box = test::make_box(90, 60, 75);
  const test::Sequence sequence = test::moving_sequence(box, 4, 150);
  for (unsigned i = 0; i < 16; ++i) {
    const auto sign = [&](unsigned bit) { return (i >> bit & 1U) != 0 ? 1.0 : -1.0; };
    const Pose about =
        test::beside(*box, sequence.truth[0], {10 * sign(0), 10 * sign(1), 7 * sign(2)},
                     {12 * sign(3), -12 * sign(1), 20 * sign(0)});
    const auto tracker = make_plugin(tracker_plugins(), "tracker", "universal",
                                     test::setup_for(box, {{"seed", std::to_string(i)}}));
    tracker->reset(about, sequence.frames[0]);
    Pose found;
    for (const Frame& frame : sequence.frames) found = tracker->track(frame).camera_from_object;
    EXPECT_LT(test::center_distance_mm(*box, found, sequence.truth.back()), 1.0) << i;
    EXPECT_LT(test::angle_deg(found, sequence.truth.back()), 0.5) << i;
  }
}

class UniversalTrackerOfABlackBox : public testing::TestWithParam<const char*> {};

TEST_P(UniversalTrackerOfABlackBox, FollowsIt) {
  SharedMesh box = test::make_box(90, 60, 75);
  std::vector<MeshVertex> corners(box->vertices().begin(), box->vertices().end());
  for (MeshVertex& corner : corners) corner.albedo_bgr.setZero();
  box = std::make_shared<const TriangleMesh>(
      corners, std::vector<Triangle>(box->triangles().begin(), box->triangles().end()));
  const Sequence sequence = test::moving_sequence(box, 10, 110);
  const auto tracker = make_plugin(
      tracker_plugins(), "tracker", "universal",
      test::setup_for(box, {{"mode", GetParam()}, {"particles", "300"}, {"layers", "4"}}));
  const auto results = test::track(*tracker, sequence);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Pose& pose = results[i].camera_from_object;
    EXPECT_LT(center_distance_mm(*box, pose, sequence.truth[i]), 12) << "frame " << i;
    EXPECT_LT(angle_deg(pose, sequence.truth[i]), 6) << "frame " << i;
    EXPECT_GT(results[i].quality, 0.3) << "frame " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Mode, UniversalTrackerOfABlackBox, testing::Values("default", "thesis"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace anneal6d
