// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "evaluation.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

Pose pose(double x, double y, double z, double degrees_about_z = 0) {
  return {rotation_from_vector({0, 0, degrees_about_z * kRadiansPerDegree}), {x, y, z}};
}

JudgedFrame judged(double x, double degrees, double milliseconds = 1) {
  return {{{x, 0, 0}, degrees}, milliseconds};
}

TEST(PoseError, IsTheDifferenceAlongTheCamerasAxesAndTheAngleBetween) {
  const PoseError error = pose_error(pose(11, 18, 505, 33), pose(10, 20, 500, 30), {});
  EXPECT_TRUE(error.translation_mm.isApprox(Eigen::Vector3d(1, -2, 5)));
  EXPECT_NEAR(error.rotation_deg, 3, 1e-9);
}

TEST(PoseError, IgnoresTurnsAboutTheAxisOfAnObjectOfRevolution) {
  Symmetry symmetry;
  symmetry.axis = Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(pose_error(pose(0, 0, 500, 130), pose(0, 0, 500, 0), symmetry).rotation_deg, 0, 1e-6);
}

TEST(PoseError, TakesTheClosestOfDiscreteSymmetries) {
  Symmetry symmetry;
  symmetry.rotations = {rotation_from_vector({0, 0, std::numbers::pi})};
  EXPECT_NEAR(pose_error(pose(0, 0, 500, 176), pose(0, 0, 500, 0), symmetry).rotation_deg, 4, 1e-6);
}

TEST(PoseError, SucceedsOnlyBelowBothLimits) {
  EXPECT_TRUE((PoseError{{49, 0, 0}, 4.9}).is_within(kSuccess_mm, kSuccess_deg));
  EXPECT_FALSE((PoseError{{30, 30, 30}, 0}).is_within(kSuccess_mm, kSuccess_deg));
  EXPECT_FALSE((PoseError{{0, 0, 0}, 5}).is_within(kSuccess_mm, kSuccess_deg));
}

TEST(Spread, OfAnEvenCountHasTheMeanOfTheMiddleTwoAsMedian) {
  const Spread spread = spread_of({10, 1, 2, 3});
  EXPECT_DOUBLE_EQ(spread.mean, 4);
  EXPECT_DOUBLE_EQ(spread.median, 2.5);
  EXPECT_DOUBLE_EQ(spread.max, 10);
}

TEST(Spread, OfAnOddCountHasTheMiddleAsMedian) { EXPECT_DOUBLE_EQ(spread_of({9, 1, 2}).median, 2); }

TEST(Quantile, IsTheNearestRank) {
  std::vector<double> values(20);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(20 - i);
  EXPECT_DOUBLE_EQ(quantile(values, 0.95), 19);
  EXPECT_DOUBLE_EQ(quantile(values, 1), 20);
  EXPECT_DOUBLE_EQ(quantile(values, 0), 1);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.95), 7);
}

TEST(Summary, CountsBothKindsOfSuccess) {
  const JudgedFrame frames[] = {judged(1, 1), judged(20, 1), judged(1, 4), judged(60, 0)};
  const Summary summary = summarise("cup", frames);
  EXPECT_DOUBLE_EQ(summary.frames, 4);
  EXPECT_DOUBLE_EQ(summary.success_share, 0.75);
  EXPECT_DOUBLE_EQ(summary.precise_share, 0.25);
}

TEST(Summary, TakesErrorsByMagnitudeSoThatSignsDoNotCancel) {
  const JudgedFrame frames[] = {judged(-3, 1), judged(3, 3)};
  const Summary summary = summarise("cup", frames);
  EXPECT_DOUBLE_EQ(summary.translation_mm[0].mean, 3);
  EXPECT_DOUBLE_EQ(summary.translation_mm[1].mean, 0);
  EXPECT_DOUBLE_EQ(summary.rotation_deg.mean, 2);
}

TEST(Summary, OfNoJudgedFrameIsRefused) { EXPECT_THROW(summarise("cup", {}), Error); }

TEST(Summary, MeanCountsEverySequenceAlike) {
  const JudgedFrame good[] = {judged(1, 1, 10), judged(1, 1, 10), judged(1, 1, 10)};
  const JudgedFrame bad[] = {judged(99, 9, 30)};
  const Summary summaries[] = {summarise("good", good), summarise("bad", bad)};
  const Summary mean = mean_of(summaries);
  EXPECT_DOUBLE_EQ(mean.success_share, 0.5);
  EXPECT_DOUBLE_EQ(mean.translation_mm[0].mean, 50);
  EXPECT_DOUBLE_EQ(mean.rotation_deg.max, 5);
  EXPECT_DOUBLE_EQ(mean.median_ms, 20);
  EXPECT_DOUBLE_EQ(mean.frames, 2);
}

TEST(Summary, WritesEveryNumberOfTheContract) {
  const JudgedFrame frames[] = {judged(2, 1, 10), judged(4, 2, 20)};
  Summary summary = summarise("cup", frames);
  summary.restarts = 1;
  const auto json = to_json(summary);
  EXPECT_EQ(json.at("name"), "cup");
  EXPECT_EQ(json.at("frames").dump(), "2");  // a whole number, not 2.0
  EXPECT_EQ(json.at("restarts"), 1);
  EXPECT_EQ(json.at("broken_frames"), 0);
  EXPECT_EQ(json.at("success_50mm_5deg"), 1.0);
  EXPECT_EQ(json.at("success_10mm_2deg"), 0.5);
  EXPECT_EQ(json.at("translation_error_mm").at("x").at("mean"), 3.0);
  EXPECT_EQ(json.at("translation_error_mm").at("z").at("max"), 0.0);
  EXPECT_EQ(json.at("rotation_error_deg").at("median"), 1.5);
  EXPECT_EQ(json.at("milliseconds").at("median"), 15.0);
  EXPECT_EQ(json.at("milliseconds").at("p95"), 20.0);
}

TEST(SummaryTable, HasALineForEachSequenceAndTheirMean) {
  const JudgedFrame frames[] = {judged(2, 1)};
  const Summary one[] = {summarise("cup", frames)};
  EXPECT_EQ(to_table(one).find("\nmean "), std::string::npos);
  const Summary two[] = {one[0], summarise("a_sequence_with_a_long_name", frames)};
  const std::string table = to_table(two);
  EXPECT_NE(table.find("\ncup "), std::string::npos);
  EXPECT_NE(table.find("\na_sequence_with_a_long_name "), std::string::npos);
  EXPECT_NE(table.find("\nmean "), std::string::npos);
}

}  // namespace
}  // namespace anneal6d
