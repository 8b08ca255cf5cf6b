// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "html_report.h"

#include <gmock/gmock.h>

#include "report_plots.h"

namespace anneal6d {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

JudgedFrame frame_with(double error_mm, double quality, std::int64_t frame = 0) {
  JudgedFrame made;
  made.error.translation_mm.x() = error_mm;
  made.quality = quality;
  made.frame = frame;
  made.milliseconds = 2;
  return made;
}

/// Frame 0 given, then one for each error.
SequenceEvaluation evaluation_of(const std::string& name, const std::vector<double>& errors_mm) {
  SequenceEvaluation evaluation;
  evaluation.rows.resize(errors_mm.size() + 1);
  evaluation.rows.front().reset = true;
  for (std::size_t i = 0; i < errors_mm.size(); ++i) {
    const auto frame = static_cast<std::int64_t>(i + 1);
    evaluation.rows[i + 1].frame = frame;
    evaluation.rows[i + 1].quality = 0.75;
    evaluation.judged.push_back(frame_with(errors_mm[i], 0.75, frame));
  }
  evaluation.summary = summarise(name, evaluation.judged);
  return evaluation;
}

TEST(Reliability, SetsQualityAgainstTheShareOfRightFrames) {
  const JudgedFrame frames[] = {frame_with(1, 0.9), frame_with(1, 0.8), frame_with(99, 0.8),
                                frame_with(99, 0.1)};
  const Reliability reliability = reliability_of(frames, 2);
  ASSERT_EQ(reliability.bins.size(), 2U);
  EXPECT_EQ(reliability.frames, 4U);
  const ReliabilityBin& bad = reliability.bins[0];
  EXPECT_EQ(bad.frames, 1U);
  EXPECT_DOUBLE_EQ(bad.mean_quality, 0.1);
  EXPECT_DOUBLE_EQ(bad.right_share, 0);
  const ReliabilityBin& good = reliability.bins[1];
  EXPECT_EQ(good.frames, 3U);
  EXPECT_NEAR(good.mean_quality, 2.5 / 3, 1e-12);
  EXPECT_NEAR(good.right_share, 2.0 / 3, 1e-12);
  EXPECT_NEAR(reliability.calibration_error, 0.25 * 0.1 + 0.75 * 0.5 / 3, 1e-12);
}

TEST(Reliability, HasABinForBothEndsOfTheScale) {
  const JudgedFrame frames[] = {frame_with(1, 1), frame_with(1, 0)};
  const Reliability reliability = reliability_of(frames, 10);
  EXPECT_EQ(reliability.bins.front().frames, 1U);
  EXPECT_EQ(reliability.bins.back().frames, 1U);
}

TEST(Reliability, IsLessCertainOfFewFrames) {
  std::vector<JudgedFrame> frames(10, frame_with(1, 0.9));
  const ReliabilityBin few = reliability_of(frames, 1).bins[0];
  EXPECT_NEAR(few.right_low, 0.7225, 5e-5);  // Wilson's interval of 10 of 10
  EXPECT_DOUBLE_EQ(few.right_high, 1);
  frames.resize(1000, frame_with(1, 0.9));
  EXPECT_GT(reliability_of(frames, 1).bins[0].right_low, 0.99);
}

TEST(Reliability, OfNoFramesClaimsNothing) {
  const Reliability reliability = reliability_of({}, 3);
  EXPECT_EQ(reliability.frames, 0U);
  EXPECT_EQ(reliability.calibration_error, 0);
  EXPECT_EQ(reliability.bins[1].right_low, 0);
  EXPECT_EQ(reliability.bins[1].right_high, 1);
}

TEST(PlotTicks, AreRoundAndWithinTheRange) {
  EXPECT_THAT(plot_ticks({0, 1}, 5),
              ElementsAre(0, 0.2, 0.4, ::testing::DoubleEq(0.2 * 3), 0.8, 1));
  EXPECT_THAT(plot_ticks({-60, 60}, 3), ElementsAre(-50, 0, 50));
  EXPECT_THAT(plot_ticks({3, 218}, 4), ElementsAre(100, 200));
}

TEST(SvgPlot, EscapesTexts) {
  Plot plot;
  plot.title = "a < b & \"c\"";
  EXPECT_THAT(plot.to_svg(), HasSubstr(">a &lt; b &amp; &quot;c&quot;</text>"));
}

TEST(SvgPlot, BreaksALineAtAGap) {
  Plot plot;
  plot.x = {0, 4};
  plot.lines = {{"", "red", {{0, 0}, {1, 1}, {2, std::nan("")}, {3, 0}, {4, 1}}}};
  EXPECT_EQ(count_of(plot.to_svg(), "<polyline"), 2U);
  EXPECT_THAT(plot.to_svg(), Not(HasSubstr("nan")));
}

TEST(SvgPlot, KeepsValuesBeyondTheRangeAtItsEdge) {
  Plot plot, outside;
  plot.lines = {{"", "red", {{0, 0}, {1, 1}}}};
  outside.lines = {{"", "red", {{0, -7}, {1, 99}}}};
  EXPECT_EQ(plot.to_svg(), outside.to_svg());
}

TEST(ReportPlots, CutOffWhatWouldFlattenTheRestAndSaySo) {
  const Plot small = translation_plot(evaluation_of("cup", {1, -3}));
  EXPECT_NEAR(small.y.high, 3, 0.5);
  EXPECT_THAT(small.title, Not(HasSubstr("largest")));
  const Plot large = translation_plot(evaluation_of("cup", {1, -300}));
  EXPECT_NEAR(large.y.low, -60, 6);
  EXPECT_THAT(large.title, HasSubstr("the largest is 300 mm"));
}

TEST(ReportPlots, LeaveAGapWhereAFrameWasNotJudged) {
  SequenceEvaluation evaluation = evaluation_of("cup", {1, 2, 3});
  evaluation.judged.erase(evaluation.judged.begin() + 1);
  const auto& points = translation_plot(evaluation).lines.front().points;
  ASSERT_EQ(points.size(), 3U);
  EXPECT_TRUE(std::isnan(points[1].y));
  EXPECT_EQ(points[2].x, 3);
}

TEST(ReportPlots, MarkRestartsAndLostFrames) {
  SequenceEvaluation evaluation = evaluation_of("cup", {1, 99, 1});
  evaluation.judged[1].restarted = true;
  evaluation.rows[3].status = TrackStatus::lost;
  const Plot plot = quality_plot(evaluation);
  EXPECT_THAT(plot.marks, ElementsAre(2));
  ASSERT_EQ(plot.bars.size(), 1U);
  EXPECT_EQ(plot.bars[0].x_low, 2.5);
  EXPECT_EQ(plot.lines[0].points.size(), 3U) << "the given pose has no quality of its own";
}

TEST(ReportPlots, CountFramesBelowEachThreshold) {
  const auto points =
      translation_success_plot(evaluation_of("cup", {5, 20, 99, 99})).lines[0].points;
  EXPECT_EQ(points.front().y, 0);
  EXPECT_EQ(points[points.size() / 2].y, 50);  // 25 mm
  EXPECT_EQ(points.back().y, 50);
}

TEST(HtmlReport, HasEverySequenceAndTheirMean) {
  const SequenceEvaluation evaluations[] = {evaluation_of("cup", {1, 1}),
                                            evaluation_of("bowl", {61, 61})};
  const std::string page = html_report(evaluations, {{"seed", "7"}, {"protocol", "rbot"}});
  EXPECT_THAT(page, HasSubstr("<td class=\"name\">cup</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"name\">bowl</td>"));
  EXPECT_THAT(page, HasSubstr("<tr class=\"mean\"><td class=\"name\">mean</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"first\">31.00</td>")) << "mean |x| of both";
  EXPECT_THAT(page, HasSubstr("seed&nbsp;<b>7</b>"));
  EXPECT_EQ(count_of(page, "<svg "), 2U + 2 * 6);
  EXPECT_EQ(count_of(page, "<svg "), count_of(page, "</svg>"));
}

TEST(HtmlReport, EscapesNamesOptionsAndCaptions) {
  SequenceEvaluation evaluation = evaluation_of("<b>cup & saucer</b>", {1});
  evaluation.pictures.push_back({"\"worst\" <frame>", "jpeg"});
  const std::string page = html_report({&evaluation, 1}, {{"model", "<i>'m'</i>"}});
  EXPECT_THAT(page, Not(HasSubstr("<b>cup")));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;cup &amp; saucer&lt;/b&gt;"));
  EXPECT_THAT(page, HasSubstr("<b>&lt;i&gt;&#39;m&#39;&lt;/i&gt;</b>"));
  EXPECT_THAT(page, HasSubstr("alt=\"&quot;worst&quot; &lt;frame&gt;\""));
}

TEST(HtmlReport, CarriesPicturesInside) {
  SequenceEvaluation evaluation = evaluation_of("cup", {1});
  for (const char* bytes : {"any carnal pleas", "any carnal pleasu", "any carnal pleasur"}) {
    evaluation.pictures.push_back({"picture", bytes});
  }
  const std::string page = html_report({&evaluation, 1}, {});
  EXPECT_THAT(page, HasSubstr("src=\"data:image/jpeg;base64,YW55IGNhcm5hbCBwbGVhcw==\""));
  EXPECT_THAT(page, HasSubstr("src=\"data:image/jpeg;base64,YW55IGNhcm5hbCBwbGVhc3U=\""));
  EXPECT_THAT(page, HasSubstr("src=\"data:image/jpeg;base64,YW55IGNhcm5hbCBwbGVhc3Vy\""));
  EXPECT_EQ(count_of(page, "src=\""), count_of(page, "src=\"data:")) << "nothing lies outside";
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
}

TEST(EvaluationPictures, TakeTheWorstFrameByBothLimits) {
  JudgedFrame turned = frame_with(1, 1, 2);
  turned.error.rotation_deg = 4;  // twice the limit
  const JudgedFrame frames[] = {frame_with(15, 1, 1), turned, frame_with(19, 1, 3)};
  EXPECT_EQ(worst_of(frames).frame, 2);
}

}  // namespace
}  // namespace anneal6d
