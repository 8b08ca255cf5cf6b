// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "report_plots.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace anneal6d {

namespace {

// Told apart also by those who don't tell red from green (Okabe and Ito, "Color Universal Design",
// 2008).
constexpr const char* kOrange = "#d55e00";
constexpr const char* kGreen = "#009e73";
constexpr const char* kBlue = "#0072b2";
constexpr const char* kGrey = "#777777";
constexpr const char* kPaleRed = "#f7d9cc";
constexpr const char* kPaleBlue = "#b9d7ea";

constexpr double kWidestShown_mm = 1.2 * kSuccess_mm;
constexpr double kWidestShown_deg = 2 * kSuccess_deg;

/// The frames that were tracked: from the first to the last.
PlotRange frame_range(const SequenceEvaluation& evaluation) {
  const auto low = static_cast<double>(evaluation.rows.front().frame);
  return {low, std::max(low + 1, static_cast<double>(evaluation.rows.back().frame))};
}

Plot plot_over_frames(const SequenceEvaluation& evaluation, std::string title,
                      std::string y_label) {
  Plot plot;
  plot.title = std::move(title);
  plot.x_label = "frame";
  plot.y_label = std::move(y_label);
  plot.x = frame_range(evaluation);
  for (const JudgedFrame& frame : evaluation.judged) {
    if (frame.restarted) plot.marks.push_back(static_cast<double>(frame.frame));
  }
  return plot;
}

/// A line over the judged frames, with gaps where frames were tracked but not judged.
template <class Value>
PlotSeries series_of(const SequenceEvaluation& evaluation, std::string name, const char* color,
                     const Value& value_of) {
  PlotSeries series{std::move(name), color, {}};
  auto row = evaluation.rows.begin();
  for (const JudgedFrame& frame : evaluation.judged) {
    bool gap = false;
    for (; row != evaluation.rows.end() && row->frame < frame.frame; ++row) gap = true;
    if (gap && !series.points.empty()) {
      series.points.push_back({static_cast<double>(frame.frame), std::nan("")});
    }
    if (row != evaluation.rows.end()) ++row;
    series.points.push_back({static_cast<double>(frame.frame), value_of(frame)});
  }
  return series;
}

/// The largest y of all lines, by magnitude.
double largest_of(const Plot& plot) {
  double largest = 0;
  for (const PlotSeries& series : plot.lines) {
    for (const PlotPoint& point : series.points) {
      if (!std::isnan(point.y)) largest = std::max(largest, std::abs(point.y));
    }
  }
  return largest;
}

/// The top of an axis for values up to `largest`: some room, never nothing.
double top_for(double largest, double least) { return 1.08 * std::max(largest, least); }

/// `errors` are not empty.
Plot success_plot(std::vector<double> errors, double limit, double precise, std::string what,
                  const std::string& unit) {
  constexpr int kThresholds = 200;
  std::sort(errors.begin(), errors.end());
  Plot plot;
  plot.title = std::move(what);
  plot.x_label = "threshold, " + unit;
  plot.y_label = "frames below, %";
  plot.x = {0, limit};
  plot.y = {0, 100};
  plot.marks = {precise};
  PlotSeries series{"", kBlue, {}};
  for (int i = 0; i <= kThresholds; ++i) {
    const double threshold = limit * i / kThresholds;
    const auto below = std::lower_bound(errors.begin(), errors.end(), threshold) - errors.begin();
    series.points.push_back(
        {threshold, 100 * static_cast<double>(below) / static_cast<double>(errors.size())});
  }
  plot.lines = {std::move(series)};
  return plot;
}

template <class Value>
std::vector<double> values_of(const SequenceEvaluation& evaluation, const Value& value_of) {
  std::vector<double> values;
  std::transform(evaluation.judged.begin(), evaluation.judged.end(), std::back_inserter(values),
                 value_of);
  return values;
}

/// A line across the whole plot.
PlotSeries level(std::string name, const Plot& plot, double y) {
  return {std::move(name), kGrey, {{plot.x.low, y}, {plot.x.high, y}}, true, true};
}

}  // namespace

Plot translation_plot(const SequenceEvaluation& evaluation) {
  Plot plot = plot_over_frames(evaluation, "Translation: estimate minus truth", "mm");
  const char* const colors[] = {kOrange, kGreen, kBlue};
  for (int axis : {2, 1, 0}) {  // z, the largest, behind the others
    plot.lines.push_back(
        series_of(evaluation, std::string(1, "xyz"[axis]), colors[axis],
                  [axis](const JudgedFrame& frame) { return frame.error.translation_mm[axis]; }));
  }
  const double largest = largest_of(plot);
  if (largest > kWidestShown_mm) plot.title += fmt::format("; the largest is {:.0f} mm", largest);
  const double top = top_for(std::min(largest, kWidestShown_mm), 0.5);
  plot.y = {-top, top};
  return plot;
}

Plot rotation_plot(const SequenceEvaluation& evaluation) {
  Plot plot = plot_over_frames(evaluation, "Rotation: angle to the truth", "degrees");
  plot.lines = {series_of(evaluation, "", kBlue,
                          [](const JudgedFrame& frame) { return frame.error.rotation_deg; })};
  const double largest = largest_of(plot);
  if (largest > kWidestShown_deg)
    plot.title += fmt::format("; the largest is {:.0f}\u00b0", largest);
  plot.y = {0, top_for(std::min(largest, kWidestShown_deg), 0.5)};
  return plot;
}

Plot quality_plot(const SequenceEvaluation& evaluation) {
  Plot plot =
      plot_over_frames(evaluation, "Quality; shaded where the tracker says lost", "quality");
  PlotSeries series{"", kBlue, {}};
  for (const PoseRow& row : evaluation.rows) {
    if (row.reset) continue;  // its quality was given, too
    const auto frame = static_cast<double>(row.frame);
    series.points.push_back({frame, row.quality});
    if (row.status == TrackStatus::lost) {
      plot.bars.push_back({frame - 0.5, frame + 0.5, 0, 1, kPaleRed, ""});
    }
  }
  plot.lines = {std::move(series)};
  return plot;
}

Plot time_plot(const SequenceEvaluation& evaluation) {
  Plot plot = plot_over_frames(evaluation, "Time of a frame, track() alone", "ms");
  plot.marks.clear();
  PlotSeries series{"", kBlue, {}};
  for (const PoseRow& row : evaluation.rows) {
    if (!row.reset) series.points.push_back({static_cast<double>(row.frame), row.milliseconds});
  }
  plot.lines = {std::move(series)};
  plot.y = {0, top_for(largest_of(plot), 0.1)};
  const Summary& summary = evaluation.summary;
  plot.lines.push_back(level(fmt::format("95 % {:.1f} ms", summary.p95_ms), plot, summary.p95_ms));
  plot.lines.push_back(
      level(fmt::format("median {:.1f} ms", summary.median_ms), plot, summary.median_ms));
  return plot;
}

Plot translation_success_plot(const SequenceEvaluation& evaluation) {
  return success_plot(
      values_of(evaluation,
                [](const JudgedFrame& frame) { return frame.error.translation_mm.norm(); }),
      kSuccess_mm, kPrecise_mm, "Success by translation", "mm");
}

Plot rotation_success_plot(const SequenceEvaluation& evaluation) {
  return success_plot(
      values_of(evaluation, [](const JudgedFrame& frame) { return frame.error.rotation_deg; }),
      kSuccess_deg, kPrecise_deg, "Success by rotation", "degrees");
}

Plot reliability_plot(const Reliability& reliability) {
  Plot plot;
  plot.title =
      fmt::format("Is the quality a probability? Mean gap {:.3f}", reliability.calibration_error);
  plot.x_label = "quality, mean of the bin (predicted)";
  plot.y_label =
      fmt::format("frames within {:g} mm and {:g}\u00b0 (came true)", kPrecise_mm, kPrecise_deg);
  plot.height_px = 480;
  PlotSeries found{"frames", kBlue, {}, false};
  for (const ReliabilityBin& bin : reliability.bins) {
    if (bin.frames == 0) continue;
    plot.bars.push_back({bin.low, bin.high, std::min(bin.mean_quality, bin.right_share),
                         std::max(bin.mean_quality, bin.right_share), kPaleRed, ""});
    plot.intervals.push_back({bin.mean_quality, bin.right_low, bin.right_high});
    found.points.push_back({bin.mean_quality, bin.right_share});
  }
  plot.lines = {{"quality = probability", kGrey, {{0, 0}, {1, 1}}, true, true}, std::move(found)};
  return plot;
}

Plot reliability_count_plot(const Reliability& reliability) {
  Plot plot;
  plot.title = fmt::format("Frames in each bin, {} in all", reliability.frames);
  plot.x_label = "quality";
  plot.y_label = "frames";
  std::size_t most = 1;
  for (const ReliabilityBin& bin : reliability.bins) {
    most = std::max(most, bin.frames);
    plot.bars.push_back({bin.low, bin.high, 0, static_cast<double>(bin.frames), kPaleBlue,
                         std::to_string(bin.frames)});
  }
  plot.y = {0, 1.15 * static_cast<double>(most)};
  return plot;
}

}  // namespace anneal6d
