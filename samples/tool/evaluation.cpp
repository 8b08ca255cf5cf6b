// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "evaluation.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "anneal6d/framework/error.h"

namespace anneal6d {

namespace {

/// The table's and the mean's view of the numbers: one place that lists them all.
template <class Function>
void for_each_number(Summary& target, const Summary& source, Function function) {
  function(target.frames, source.frames);
  function(target.broken_frames, source.broken_frames);
  function(target.restarts, source.restarts);
  function(target.success_share, source.success_share);
  function(target.precise_share, source.precise_share);
  const auto each_of_spread = [&](Spread& a, const Spread& b) {
    function(a.mean, b.mean);
    function(a.median, b.median);
    function(a.max, b.max);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    each_of_spread(target.translation_mm[axis], source.translation_mm[axis]);
  }
  each_of_spread(target.rotation_deg, source.rotation_deg);
  function(target.median_ms, source.median_ms);
  function(target.p95_ms, source.p95_ms);
}

double share_within(std::span<const JudgedFrame> frames, double limit_mm, double limit_deg) {
  const auto count = std::count_if(frames.begin(), frames.end(), [&](const JudgedFrame& frame) {
    return frame.error.is_within(limit_mm, limit_deg);
  });
  return static_cast<double>(count) / static_cast<double>(frames.size());
}

template <class Function>
std::vector<double> collect(std::span<const JudgedFrame> frames, Function value_of) {
  std::vector<double> values(frames.size());
  std::transform(frames.begin(), frames.end(), values.begin(), value_of);
  return values;
}

/// Counts are whole numbers in one sequence, but not always in the mean of several.
nlohmann::ordered_json count_json(double count) {
  if (count == std::floor(count)) return static_cast<std::int64_t>(count);
  return count;
}

nlohmann::ordered_json to_json(const Spread& spread) {
  return {{"mean", spread.mean}, {"median", spread.median}, {"max", spread.max}};
}

}  // namespace

PoseError pose_error(const Pose& estimate, const Pose& truth, const Symmetry& symmetry) {
  const Eigen::Quaterniond closest = symmetry.fold(estimate.rotation, truth.rotation);
  return {estimate.translation_mm - truth.translation_mm,
          angle_between(closest, truth.rotation) * 180.0 / std::numbers::pi};
}

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return {std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()),
          values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]),
          values.back()};
}

double quantile(std::vector<double> values, double share) {
  const double count = static_cast<double>(values.size());
  // The small tolerance keeps 0.95 * 20 = 19.000000000000004 at rank 19.
  const double rank = std::clamp(std::ceil(share * count - 1e-9), 1.0, count);
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Summary summarise(std::string name, std::span<const JudgedFrame> frames) {
  if (frames.empty()) {
    throw Error(name +
                ": no frame after the first has ground truth to judge it by; give another "
                "pose file with --reference, or more frames");
  }
  Summary summary;
  summary.name = std::move(name);
  summary.frames = static_cast<double>(frames.size());
  summary.success_share = share_within(frames, kSuccess_mm, kSuccess_deg);
  summary.precise_share = share_within(frames, kPrecise_mm, kPrecise_deg);
  for (int axis = 0; axis < 3; ++axis) {
    summary.translation_mm[static_cast<std::size_t>(axis)] =
        spread_of(collect(frames, [&](const JudgedFrame& frame) {
          return std::abs(frame.error.translation_mm[axis]);
        }));
  }
  summary.rotation_deg =
      spread_of(collect(frames, [](const JudgedFrame& frame) { return frame.error.rotation_deg; }));
  const std::vector<double> times =
      collect(frames, [](const JudgedFrame& frame) { return frame.milliseconds; });
  summary.median_ms = spread_of(times).median;
  summary.p95_ms = quantile(times, 0.95);
  return summary;
}

Summary mean_of(std::span<const Summary> summaries) {
  Summary mean;
  mean.name = "mean";
  for (const Summary& summary : summaries) {
    for_each_number(mean, summary, [](double& sum, double value) { sum += value; });
  }
  const double count = static_cast<double>(summaries.size());
  for_each_number(mean, mean, [count](double& sum, double) { sum /= count; });
  return mean;
}

nlohmann::ordered_json to_json(const Summary& summary) {
  return {{"name", summary.name},
          {"frames", count_json(summary.frames)},
          {"broken_frames", count_json(summary.broken_frames)},
          {"restarts", count_json(summary.restarts)},
          {"success_50mm_5deg", summary.success_share},
          {"success_10mm_2deg", summary.precise_share},
          {"translation_error_mm",
           {{"x", to_json(summary.translation_mm[0])},
            {"y", to_json(summary.translation_mm[1])},
            {"z", to_json(summary.translation_mm[2])}}},
          {"rotation_error_deg", to_json(summary.rotation_deg)},
          {"milliseconds", {{"median", summary.median_ms}, {"p95", summary.p95_ms}}}};
}

std::string to_table(std::span<const Summary> summaries) {
  std::vector<Summary> rows(summaries.begin(), summaries.end());
  if (rows.size() > 1) rows.push_back(mean_of(summaries));
  std::size_t width = 8;
  for (const Summary& row : rows) width = std::max(width, row.name.size());

  std::string table = fmt::format(
      "{0:<{1}}  {2:>6}  {3:>8}  {4:>8}  {5:>8}  {6:>23}  {7:>14}  {8:>13}\n"
      "{9:<{1}}  {9:>6}  {10:>8}  {11:>8}  {9:>8}  {12:>23}  {13:>14}  {14:>13}\n",
      "sequence", width, "frames", "success", "success", "restarts", "mean |error|, mm",
      "rotation, deg", "time, ms", "", "50mm 5d", "10mm 2d", "x       y       z", "mean     max",
      "median     95%");
  for (const Summary& row : rows) {
    table += fmt::format(
        "{:<{}}  {:>6.0f}  {:>7.1f}%  {:>7.1f}%  {:>8.1f}  {:>7.3f} {:>7.3f} {:>7.3f}  "
        "{:>6.3f} {:>7.3f}  {:>6.1f} {:>6.1f}\n",
        row.name, width, row.frames, 100 * row.success_share, 100 * row.precise_share, row.restarts,
        row.translation_mm[0].mean, row.translation_mm[1].mean, row.translation_mm[2].mean,
        row.rotation_deg.mean, row.rotation_deg.max, row.median_ms, row.p95_ms);
  }
  return table;
}

}  // namespace anneal6d
