// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "html_report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "anneal6d/visualizer/headless_context.h"
#include "report_plots.h"

namespace anneal6d {

namespace {

constexpr std::size_t kReliabilityBins = 10;

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Anneal6D evaluation</title>
<style>
body { font: 15px/1.45 "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; color: #1a1a1a;
       background: #fff; max-width: 1240px; margin: 24px auto; padding: 0 16px; }
h1 { font-size: 24px; margin: 0 0 4px; }
h2 { font-size: 19px; margin: 40px 0 6px; border-bottom: 1px solid #ccc; padding-bottom: 4px; }
p { margin: 6px 0; max-width: 75em; }
.note { color: #555; font-size: 13px; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 12px 0; font-size: 12px;
        font-variant-numeric: tabular-nums; }
th, td { padding: 4px 5px; text-align: right; white-space: nowrap; }
th { font-weight: 600; background: #f2f2f2; }
th[colspan] { text-align: center; border-left: 1px solid #ddd; }
td { border-top: 1px solid #e4e4e4; }
.first { border-left: 1px solid #ddd; }
th.name, td.name { text-align: left; }
tr.mean td { border-top: 2px solid #999; font-weight: 600; }
.row { display: flex; flex-wrap: wrap; align-items: flex-start; gap: 12px 16px; margin: 10px 0; }
figure { margin: 0; flex: 0 1 372px; }
figure img { width: 100%; height: auto; display: block; background: #eee; }
figcaption { font-size: 13px; color: #444; margin-top: 3px; }
svg { max-width: 100%; height: auto; font-family: inherit; }
svg .title { font-size: 13px; font-weight: 600; fill: #1a1a1a; }
svg .tick, svg .label { font-size: 12px; fill: #444; }
svg .middle { text-anchor: middle; }
svg .end { text-anchor: end; }
svg .grid { stroke: #e6e6e6; }
svg .frame { fill: none; stroke: #999; }
svg .mark { stroke: #cc79a7; stroke-width: 1.5; stroke-dasharray: 3 3; }
svg .interval { stroke: #0072b2; stroke-width: 1.5; opacity: 0.55; }
svg polyline { fill: none; stroke-width: 1.5; stroke-linejoin: round; }
</style>
</head>
<body>
)";

/// RFC 4648.
std::string to_base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = i; k < i + 3; ++k) {
      group = group << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
    }
    const std::size_t digits = std::min<std::size_t>(bytes.size() - i, 3) + 1;
    for (std::size_t k = 0; k < 4; ++k) {
      text += k < digits ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

std::string cell(std::string_view text, std::string_view css_class = {}) {
  return css_class.empty() ? fmt::format("<td>{}</td>", text)
                           : fmt::format("<td class=\"{}\">{}</td>", css_class, text);
}

std::string spread_cells(const Spread& spread) {
  return cell(fmt::format("{:.2f}", spread.mean), "first") +
         cell(fmt::format("{:.2f}", spread.median)) + cell(fmt::format("{:.2f}", spread.max));
}

/// Whole in one sequence, but not always in the mean of several.
std::string count_text(double count) { return fmt::format("{:.6g}", count); }

std::string summary_row(const Summary& summary, std::string_view css_class) {
  std::string row = fmt::format("<tr class=\"{}\">", css_class);
  row += cell(escape_html(summary.name), "name");
  row += cell(count_text(summary.frames)) + cell(count_text(summary.broken_frames)) +
         cell(count_text(summary.restarts));
  row += cell(fmt::format("{:.1f}", 100 * summary.success_share), "first") +
         cell(fmt::format("{:.1f}", 100 * summary.precise_share));
  for (const Spread& axis : summary.translation_mm) row += spread_cells(axis);
  row += spread_cells(summary.rotation_deg);
  row += cell(fmt::format("{:.1f}", summary.median_ms), "first") +
         cell(fmt::format("{:.1f}", summary.p95_ms));
  return row + "</tr>\n";
}

std::string summary_table(std::span<const SequenceEvaluation> evaluations) {
  std::string table =
      "<div class=\"wide\"><table>\n<tr><th class=\"name\" rowspan=\"2\">sequence</th>"
      "<th rowspan=\"2\">frames</th><th rowspan=\"2\">broken</th><th rowspan=\"2\">restarts</th>"
      "<th colspan=\"2\">success, %</th><th colspan=\"3\">|x|, mm</th><th colspan=\"3\">|y|, "
      "mm</th>"
      "<th colspan=\"3\">|z|, mm</th><th colspan=\"3\">rotation, \u00b0</th>"
      "<th colspan=\"2\">time, ms</th></tr>\n";
  table +=
      fmt::format("<tr><th class=\"first\">{:g} mm, {:g}\u00b0</th><th>{:g} mm, {:g}\u00b0</th>",
                  kSuccess_mm, kSuccess_deg, kPrecise_mm, kPrecise_deg);
  for (int i = 0; i < 4; ++i) {
    table += "<th class=\"first\">mean</th><th>median</th><th>max</th>";
  }
  table += "<th class=\"first\">median</th><th>95 %</th></tr>\n";
  std::vector<Summary> summaries;
  for (const SequenceEvaluation& evaluation : evaluations) {
    summaries.push_back(evaluation.summary);
    table += summary_row(evaluation.summary, "sequence");
  }
  if (summaries.size() > 1) table += summary_row(mean_of(summaries), "mean");
  return table + "</table></div>\n";
}

std::string options_text(const std::map<std::string, std::string>& options) {
  std::string text = "<p class=\"note\">Options:";
  for (const auto& [name, value] : options) {
    text += fmt::format(" {}&nbsp;<b>{}</b>;", escape_html(name), escape_html(value));
  }
  text.back() = '.';
  return text + "</p>\n";
}

std::string reliability_section(std::span<const SequenceEvaluation> evaluations) {
  std::vector<JudgedFrame> frames;
  for (const SequenceEvaluation& evaluation : evaluations) {
    frames.insert(frames.end(), evaluation.judged.begin(), evaluation.judged.end());
  }
  const Reliability reliability = reliability_of(frames, kReliabilityBins);
  return fmt::format(
      "<h2>Reliability of the quality</h2>\n"
      "<p>The tracker predicts with each pose how likely it is right: its quality. Here the judged "
      "frames of all sequences stand in bins of like quality. The height of a point tells how many "
      "of its frames came true, that is, lay within {:g} mm and {:g}\u00b0; on the diagonal "
      "prediction and truth agree, and the shaded bar is the gap. Below the diagonal the tracker "
      "is too sure of itself. Thin bars: 95 % confidence, if frames were independent of each "
      "other.</p>\n<div class=\"row\">\n{}{}</div>\n",
      kPrecise_mm, kPrecise_deg, reliability_plot(reliability).to_svg(),
      reliability_count_plot(reliability).to_svg());
}

std::string sequence_section(const SequenceEvaluation& evaluation) {
  const Summary& s = evaluation.summary;
  std::string section = fmt::format(
      "<h2>{}</h2>\n<p>{} frames judged; {:.1f} % within {:g} mm and {:g}\u00b0, {:.1f} % within "
      "{:g} mm and {:g}\u00b0; {} restarts.</p>\n<div class=\"row\">\n",
      escape_html(s.name), count_text(s.frames), 100 * s.success_share, kSuccess_mm, kSuccess_deg,
      100 * s.precise_share, kPrecise_mm, kPrecise_deg, count_text(s.restarts));
  for (const EvaluationPicture& picture : evaluation.pictures) {
    const std::string caption = escape_html(picture.caption);
    section += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\">"
        "<figcaption>{0}</figcaption></figure>\n",
        caption, to_base64(picture.jpeg));
  }
  section += "</div>\n<div class=\"row\">\n";
  for (const auto& make : {translation_plot, rotation_plot, quality_plot, time_plot,
                           translation_success_plot, rotation_success_plot}) {
    section += make(evaluation).to_svg();
  }
  return section + "</div>\n";
}

}  // namespace

std::string html_report(std::span<const SequenceEvaluation> evaluations,
                        const std::map<std::string, std::string>& options) {
  std::string page(kHead);
  page += "<h1>Evaluation against ground truth</h1>\n" + options_text(options);
  page += summary_table(evaluations);
  page +=
      "<p class=\"note\">Errors are those of <i>camera_from_object</i>: along the camera's axes, x "
      "right, y down, z forward, by magnitude, and the angle of the rotation, the smallest over "
      "the "
      "object's symmetry. The first pose is given and not judged; neither are frames without "
      "ground "
      "truth. Success: the share of judged frames within both limits. The mean counts every "
      "sequence alike. Time is that of track() alone.</p>\n";
  page += reliability_section(evaluations);
  page +=
      "<p class=\"note\">In what follows: pictures with the estimated pose in green, in red where "
      "the tracker says that it lost the object, and the true pose in magenta where it differs. "
      "Dashed vertical lines over frames: restarts at the ground truth; over thresholds: the "
      "stricter limit.</p>\n";
  if (const std::string& reason = headless_opengl_unavailable_reason(); !reason.empty()) {
    page +=
        "<p class=\"note\">No pictures, since OpenGL draws them: " + escape_html(reason) + "</p>\n";
  }
  for (const SequenceEvaluation& evaluation : evaluations) page += sequence_section(evaluation);
  return page + "</body>\n</html>\n";
}

}  // namespace anneal6d
