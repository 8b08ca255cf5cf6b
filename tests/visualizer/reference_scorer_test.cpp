// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/reference_scorer.h"

#include <gtest/gtest.h>

#include <limits>

#include "anneal6d/framework/error.h"
#include "opengl_test.h"
#include "test_meshes.h"

namespace anneal6d {
namespace {

using test::at;

using ReferenceScorerTest = test::OpenGlTest;

ScorerSetup rectangle_setup(cv::Mat texture_bgr = {}) {
  ScorerSetup setup;
  setup.mesh = test::make_rectangle(100, 60, std::move(texture_bgr));
  setup.camera = test::vga_camera();
  setup.edges.threshold = 40;
  return setup;
}

EdgeMatch score(ReferenceScorer& scorer, const Pose& pose) {
  EdgeMatch match;
  scorer.score({&pose, 1}, {&match, 1});
  return match;
}

// A rectangle of w x h pixels has Sobel edges on both sides of its border.
constexpr int border_pixels(int w, int h) { return (w + 2) * (h + 2) - (w - 2) * (h - 2); }

TEST_F(ReferenceScorerTest, CountsEdgesAndThoseTheFrameHas) {
  ReferenceScorer scorer(rectangle_setup());
  EdgeImage upper_half{cv::Mat::zeros(480, 640, CV_8UC1)};
  upper_half.binary.rowRange(0, 241).setTo(255);  // 211..240 are half of the rows 211..270
  scorer.set_edges(upper_half);
  const EdgeMatch match = score(scorer, at(0.5, 0.5, 500));
  EXPECT_EQ(match.rendered, border_pixels(100, 60));
  EXPECT_EQ(match.matched, border_pixels(100, 60) / 2);
}

TEST_F(ReferenceScorerTest, WidensTheRenderedEdges) {
  ScorerSetup setup = rectangle_setup();
  setup.edges.dilation_px = 1;
  ReferenceScorer scorer(setup);
  EXPECT_EQ(score(scorer, at(0.5, 0.5, 500)).rendered, 104 * 64 - 96 * 56);
}

TEST_F(ReferenceScorerTest, GivesZeroForWhatCannotBeSeen) {
  ReferenceScorer scorer(rectangle_setup());
  scorer.set_edges({cv::Mat(480, 640, CV_8UC1, cv::Scalar(255))});
  for (const Pose& pose :
       {at(0, 0, -500), at(5000, 0, 500), at(0, std::numeric_limits<double>::quiet_NaN(), 500)}) {
    const EdgeMatch match = score(scorer, pose);
    EXPECT_EQ(match.rendered, 0);
    EXPECT_EQ(match.matched, 0);
  }
}

TEST_F(ReferenceScorerTest, SeesTheTextureUnlessToldNotTo) {
  cv::Mat halves(64, 64, CV_8UC3, cv::Scalar::all(255));
  halves.colRange(0, 32).setTo(cv::Scalar::all(60));
  ScorerSetup setup = rectangle_setup(halves);
  ReferenceScorer textured(setup);
  setup.textured = false;
  ReferenceScorer plain(setup);
  EXPECT_GT(score(textured, at(0.5, 0.5, 500)).rendered, border_pixels(100, 60) + 50);
  EXPECT_EQ(score(plain, at(0.5, 0.5, 500)).rendered, border_pixels(100, 60));
}

TEST_F(ReferenceScorerTest, ScoresABatchAsOneByOne) {
  ReferenceScorer scorer(rectangle_setup());
  scorer.set_edges({cv::Mat(480, 640, CV_8UC1, cv::Scalar(255))});
  const std::vector<Pose> poses = {at(0.5, 0.5, 500), at(0, 0, -1), at(-319.5, 0.5, 500)};
  std::vector<EdgeMatch> matches(poses.size());
  scorer.score(poses, matches);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(matches[i].rendered, score(scorer, poses[i]).rendered);
  }
}

TEST_F(ReferenceScorerTest, RefusesEdgesOfAnotherSizeOrType) {
  ReferenceScorer scorer(rectangle_setup());
  EXPECT_THROW(scorer.set_edges({cv::Mat::zeros(240, 320, CV_8UC1)}), ConfigError);
  EXPECT_THROW(scorer.set_edges({cv::Mat::zeros(480, 640, CV_8UC3)}), ConfigError);
  EXPECT_THROW(scorer.set_edges({}), ConfigError);
}

TEST_F(ReferenceScorerTest, IsMadeByItsName) {
  const ScorerTable table = visualizer::scorer_plugins();
  EXPECT_NE(make_plugin(table, "scorer", "reference", rectangle_setup()), nullptr);
  ScorerSetup automatic = rectangle_setup();
  automatic.edges.threshold.reset();
  EXPECT_THROW(make_plugin(table, "scorer", "reference", automatic), ConfigError);
}

}  // namespace
}  // namespace anneal6d
