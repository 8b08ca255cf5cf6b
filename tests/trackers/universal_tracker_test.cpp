// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/trackers/universal_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "anneal6d/framework/error.h"
#include "anneal6d/trackers/plugins.h"
#include "tracking.h"

namespace anneal6d {
namespace {

using test::angle_deg;
using test::beside;
using test::center_distance_mm;
using test::frame_of;
using test::Sequence;
using test::setup_for;
using test::SharedMesh;
using test::track;
using test::Values;

const SharedMesh& tracked_box() {
  static const SharedMesh mesh = test::make_box(90, 60, 75);
  return mesh;
}

std::unique_ptr<RigidObjectTracker> make_tracker(const Values& values = {},
                                                 const SharedMesh& mesh = tracked_box()) {
  return make_plugin(tracker_plugins(), "tracker", "universal", setup_for(mesh, values));
}

Sequence moving_sequence(int frames) { return test::moving_sequence(tracked_box(), frames); }

struct Mode {
  const char* name;
  const char* particles;
  const char* layers;
  /// Quality on pure noise. The default mode trusts whatever edges are near, until it knows
  /// colours: 1 asks for a probability only.
  double most_by_chance;
  double reach_mm, reach_deg;  ///< what half of the errors on `moving_sequence` must not exceed

  friend std::ostream& operator<<(std::ostream& stream, const Mode& mode) {
    return stream << mode.name;
  }
};

class UniversalTracking : public testing::TestWithParam<Mode> {
 protected:
  std::unique_ptr<RigidObjectTracker> make(const char* threads = "0",
                                           const char* seed = "1") const {
    return make_tracker({{"mode", GetParam().name},
                         {"particles", GetParam().particles},
                         {"layers", GetParam().layers},
                         {"threads", threads},
                         {"seed", seed}});
  }
};

TEST_P(UniversalTracking, FollowsAMovingObject) {
  const Sequence sequence = moving_sequence(16);
  const auto tracker = make();
  const auto results = track(*tracker, sequence);
  std::vector<double> errors_mm, errors_deg;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Pose& pose = results[i].camera_from_object;
    errors_mm.push_back(center_distance_mm(*tracked_box(), pose, sequence.truth[i]));
    errors_deg.push_back(angle_deg(pose, sequence.truth[i]));
    // Single frames may be worse where a face and the background look alike.
    EXPECT_LT(errors_mm.back(), 5 + GetParam().reach_mm) << "frame " << i;
    EXPECT_LT(errors_deg.back(), 3 + GetParam().reach_deg) << "frame " << i;
    EXPECT_LT(
        center_distance_mm(*tracked_box(), results[i].best_camera_from_object, sequence.truth[i]),
        3 * GetParam().reach_mm + 5)
        << "frame " << i;
    EXPECT_EQ(results[i].status, TrackStatus::tracking) << "frame " << i;
    EXPECT_GT(results[i].quality, 0.5) << "frame " << i;
    EXPECT_LE(results[i].quality, 1.0) << "frame " << i;
  }
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  EXPECT_LT(median(errors_mm), GetParam().reach_mm);
  EXPECT_LT(median(errors_deg), GetParam().reach_deg);
}

TEST_P(UniversalTracking, GivesIdenticalPosesOnAnyNumberOfThreads) {
  const Sequence sequence = moving_sequence(4);
  const auto one = track(*make("1"), sequence);
  for (const char* threads : {"1", "2", "3"}) {
    const auto others = track(*make(threads), sequence);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].camera_from_object.translation_mm,
                others[i].camera_from_object.translation_mm)
          << "frame " << i << " on " << threads;
      EXPECT_EQ(one[i].camera_from_object.rotation.coeffs(),
                others[i].camera_from_object.rotation.coeffs())
          << "frame " << i << " on " << threads;
      EXPECT_EQ(one[i].best_camera_from_object.translation_mm,
                others[i].best_camera_from_object.translation_mm)
          << "frame " << i << " on " << threads;
      EXPECT_EQ(one[i].quality, others[i].quality) << "frame " << i << " on " << threads;
    }
  }
}

TEST_P(UniversalTracking, StartsAnewAfterAReset) {
  const Sequence sequence = moving_sequence(3);
  const Sequence end{{sequence.frames.back()}, {sequence.truth.back()}};
  const auto used = make();
  track(*used, sequence);
  const TrackResult again = track(*used, end).front();
  const TrackResult fresh = track(*make(), end).front();
  EXPECT_EQ(again.camera_from_object.translation_mm, fresh.camera_from_object.translation_mm);
  EXPECT_EQ(again.camera_from_object.rotation.coeffs(), fresh.camera_from_object.rotation.coeffs());
  EXPECT_EQ(again.quality, fresh.quality);
}

TEST_P(UniversalTracking, DrawsOtherParticlesForAnotherSeed) {
  // From so far aside that the particles have to look for the object.
  Sequence sequence = moving_sequence(1);
  sequence.truth[0] = beside(*tracked_box(), sequence.truth[0], {6, 0, 0}, {20, 0, 0});
  EXPECT_NE(track(*make("0", "1"), sequence)[0].best_camera_from_object.translation_mm,
            track(*make("0", "2"), sequence)[0].best_camera_from_object.translation_mm);
}

TEST_P(UniversalTracking, StaysOnAStillImage) {
  Sequence still = moving_sequence(1);
  still.frames.resize(10, still.frames[0]);
  const auto tracker = make();
  for (const TrackResult& result : track(*tracker, still)) {
    EXPECT_LT(center_distance_mm(*tracked_box(), result.camera_from_object, still.truth[0]),
              GetParam().reach_mm);
    EXPECT_LT(angle_deg(result.camera_from_object, still.truth[0]), GetParam().reach_deg);
  }
}

TEST_P(UniversalTracking, SaysWhenTheObjectIsGone) {
  Sequence sequence = moving_sequence(3);
  cv::Mat empty(240, 320, CV_8UC1);
  cv::RNG random(9);
  for (int i = 0; i < 6; ++i) {
    random.fill(empty, cv::RNG::NORMAL, 40, 1.5);
    sequence.frames.push_back(frame_of(empty.clone(), 3 + i));
  }
  const auto tracker = make();
  const auto results = track(*tracker, sequence);
  EXPECT_EQ(results[2].status, TrackStatus::tracking);
  EXPECT_EQ(results.back().status, TrackStatus::lost);
  EXPECT_LT(results.back().quality, 0.25);
  for (const TrackResult& result : results) {
    EXPECT_TRUE(result.camera_from_object.is_finite());
    EXPECT_TRUE(result.best_camera_from_object.is_finite());
  }
}

TEST_P(UniversalTracking, SurvivesImagesThatAreFullOfEdges) {
  Sequence sequence = moving_sequence(1);
  cv::Mat noise(240, 320, CV_8UC1);
  cv::RNG random(10);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  const Frame start = sequence.frames[0];
  sequence.frames.assign(5, frame_of(noise, 0));
  const auto tracker = make();
  for (const TrackResult& result : track(*tracker, sequence)) {
    EXPECT_TRUE(result.camera_from_object.is_finite());
    EXPECT_GE(result.quality, 0);
    EXPECT_LE(result.quality, GetParam().most_by_chance);
  }
  tracker->reset(sequence.truth[0], start);
  EXPECT_LT(tracker->track(sequence.frames[0]).quality, 0.7) << "the colours are others";
}

TEST_P(UniversalTracking, TakesColourFrames) {
  Sequence sequence = moving_sequence(3);
  for (Frame& frame : sequence.frames) {
    cv::Mat colour;
    cv::cvtColor(frame.image, colour, cv::COLOR_GRAY2BGR);
    frame.image = colour;
  }
  const auto tracker = make();
  const auto results = track(*tracker, sequence);
  EXPECT_LT(
      center_distance_mm(*tracked_box(), results.back().camera_from_object, sequence.truth.back()),
      GetParam().reach_mm);
}

TEST_P(UniversalTracking, LeavesTheFrameAsItIs) {
  const Sequence sequence = moving_sequence(1);
  const cv::Mat before = sequence.frames[0].image.clone();
  track(*make(), sequence);
  EXPECT_EQ(cv::countNonZero(before != sequence.frames[0].image), 0);
}

/// Like a `moving_sequence`, but out of sight from frame `gone` to before frame `back`, where the
/// motion goes on near where it stopped.
Sequence interrupted_sequence(int gone, int back, int frames) {
  Sequence sequence = moving_sequence(frames - (back - gone));
  for (int i = gone; i < back; ++i) {
    cv::Mat empty(240, 320, CV_8UC1);
    cv::RNG random(static_cast<std::uint64_t>(i) + 1);
    random.fill(empty, cv::RNG::NORMAL, 40, 1.5);
    sequence.frames.insert(sequence.frames.begin() + i, frame_of(empty, i));
    sequence.truth.insert(sequence.truth.begin() + i, sequence.truth[gone - 1]);
  }
  return sequence;
}

TEST(UniversalTrackerOfABoxThatIsGoneForAWhile, SaysSoAndFindsItAgain) {
  constexpr std::size_t kGone = 6, kBack = 14, kFrames = 20;
  for (const bool shown : {false, true}) {
    const Sequence sequence = interrupted_sequence(kGone, kBack, kFrames);
    const auto tracker = make_tracker();
    if (shown) {
      tracker->reset(sequence.truth[0], sequence.frames[0]);
    } else {
      tracker->reset(sequence.truth[0]);
    }
    for (std::size_t i = 0; i < kFrames; ++i) {
      SCOPED_TRACE("frame " + std::to_string(i));
      const TrackResult result = tracker->track(sequence.frames[i]);
      if (i < kGone) {
        EXPECT_EQ(result.status, TrackStatus::tracking);
      } else if (i >= kGone + 2 && i < kBack) {
        EXPECT_EQ(result.status, TrackStatus::lost) << "the third frame without it, or later";
        EXPECT_LT(result.quality, 0.25);
      } else if (i > kBack) {
        EXPECT_EQ(result.status, TrackStatus::tracking);
        EXPECT_GT(result.quality, 0.5);
        EXPECT_LT(center_distance_mm(*tracked_box(), result.camera_from_object, sequence.truth[i]),
                  2);
        EXPECT_LT(angle_deg(result.camera_from_object, sequence.truth[i]), 1);
      }
    }
  }
}

TEST(UniversalTrackerOfABoxThatIsGoneForAWhile, FindsItAgainElsewhere) {
  constexpr std::size_t kGone = 6, kBack = 14, kFrames = 18;
  Sequence sequence = interrupted_sequence(kGone, kBack, kBack);
  const RasterModel model(tracked_box(), false);
  const Pose elsewhere =
      test::beside(*tracked_box(), sequence.truth[kGone - 1], {4, -10, 5}, {75, 25, -20});
  for (std::size_t i = kBack; i < kFrames; ++i) {
    const int index = static_cast<int>(i);
    sequence.truth.push_back(elsewhere);
    sequence.frames.push_back(
        frame_of(test::photograph(model, test::small_camera(), elsewhere, 40, 1.5, index), index));
  }
  for (const char* const seed : {"1", "2", "3", "4"}) {
    SCOPED_TRACE(seed);
    const auto tracker = make_tracker({{"seed", seed}});
    tracker->reset(sequence.truth[0], sequence.frames[0]);
    TrackResult last;
    for (const Frame& frame : sequence.frames) last = tracker->track(frame);
    EXPECT_EQ(last.status, TrackStatus::tracking);
    EXPECT_LT(center_distance_mm(*tracked_box(), last.camera_from_object, elsewhere), 2);
    EXPECT_LT(angle_deg(last.camera_from_object, elsewhere), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Mode, UniversalTracking,
                         testing::Values(Mode{"default", "200", "4", 1.0, 1.0, 0.5},
                                         Mode{"thesis", "300", "4", 0.7, 12, 6}),
                         [](const auto& test) {
                           return std::string(test.param.name) == "thesis" ? "Thesis" : "Default";
                         });

TEST(MakingAUniversalTracker, RefusesWrongSettings) {
  EXPECT_THROW(make_tracker({{"particles", "0"}}), ConfigError);
  EXPECT_THROW(make_tracker({{"mode", "fast"}}), ConfigError);
}

TEST(MakingAUniversalTracker, ListsTheScorersForAnUnknownOne) {
  try {
    make_tracker({{"scorer", "gpu"}});
    FAIL() << "was made";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("unknown scorer 'gpu'; there are: cpu"),
              std::string::npos)
        << error.what();
  }
}

TEST(MakingAUniversalTracker, NeedsAMeshACameraAndAScorer) {
  EXPECT_THROW(make_universal_tracker(setup_for(nullptr, {})), ConfigError);
  TrackerSetup setup = setup_for(tracked_box(), {});
  setup.camera.fx_px = -1;
  EXPECT_THROW(make_universal_tracker(setup), ConfigError);
  setup = setup_for(tracked_box(), {});
  setup.scorers.clear();
  EXPECT_THROW(make_universal_tracker(setup), ConfigError);
}

TEST(UniversalTrackerTable, HasTheTrackerByItsName) {
  const TrackerTable table = tracker_plugins();
  ASSERT_EQ(table.size(), 1U);
  EXPECT_EQ(table[0].name, "universal");
  EXPECT_FALSE(table[0].summary.empty());
  EXPECT_EQ(table[0].why_unavailable(), "");
}

}  // namespace
}  // namespace anneal6d
