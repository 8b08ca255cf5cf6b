// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "svg_plot.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace anneal6d {

namespace {

constexpr double kLeft_px = 52, kRight_px = 12, kTop_px = 44, kBottom_px = 38;
constexpr double kTickEveryAcross_px = 70, kTickEveryUp_px = 32;
constexpr double kLetter_px = 6.6;  // about, at 12 px: to lay out the legend

/// The steps of one drawing: from values to pixels.
class Painter {
 public:
  explicit Painter(const Plot& plot)
      : plot_(plot),
        right_px_(plot.width_px - kRight_px),
        bottom_px_(plot.height_px - kBottom_px),
        svg_(fmt::format("<svg viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
                         "height=\"{1:.0f}\" role=\"img\">\n",
                         plot.width_px, plot.height_px)) {}

  std::string paint() {
    text(kLeft_px, 16, "title", plot_.title);
    for (const PlotBar& bar : plot_.bars) paint_bar(bar);
    paint_axes();
    for (const double mark : plot_.marks) {
      line("mark", at_x(mark), kTop_px, at_x(mark), bottom_px_);
    }
    for (const Plot::Interval& interval : plot_.intervals) {
      line("interval", at_x(interval.x), at_y(interval.y_low), at_x(interval.x),
           at_y(interval.y_high));
    }
    for (const PlotSeries& series : plot_.lines) paint_series(series);
    paint_legend();
    return svg_ + "</svg>\n";
  }

 private:
  double at_x(double x) const {
    const double share = std::clamp((x - plot_.x.low) / (plot_.x.high - plot_.x.low), 0.0, 1.0);
    return kLeft_px + share * (right_px_ - kLeft_px);
  }
  double at_y(double y) const {
    const double share = std::clamp((y - plot_.y.low) / (plot_.y.high - plot_.y.low), 0.0, 1.0);
    return bottom_px_ - share * (bottom_px_ - kTop_px);
  }

  void text(double x_px, double y_px, std::string_view css_class, std::string_view content) {
    svg_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x_px, y_px,
                        css_class, escape_html(content));
  }

  void line(std::string_view css_class, double x0_px, double y0_px, double x1_px, double y1_px) {
    svg_ += fmt::format(
        "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" "
        "y2=\"{:.1f}\"/>\n",
        css_class, x0_px, y0_px, x1_px, y1_px);
  }

  void paint_axes() {
    const int across = static_cast<int>((right_px_ - kLeft_px) / kTickEveryAcross_px);
    const int up = static_cast<int>((bottom_px_ - kTop_px) / kTickEveryUp_px);
    for (const double x : plot_ticks(plot_.x, across)) {
      line("grid", at_x(x), kTop_px, at_x(x), bottom_px_);
      text(at_x(x), bottom_px_ + 15, "tick middle", fmt::format("{:g}", x));
    }
    for (const double y : plot_ticks(plot_.y, up)) {
      line("grid", kLeft_px, at_y(y), right_px_, at_y(y));
      text(kLeft_px - 6, at_y(y) + 4, "tick end", fmt::format("{:g}", y));
    }
    svg_ += fmt::format(
        "<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.1f}\"/>\n",
        kLeft_px, kTop_px, right_px_ - kLeft_px, bottom_px_ - kTop_px);
    text(0.5 * (kLeft_px + right_px_), plot_.height_px - 7, "label middle", plot_.x_label);
    svg_ += fmt::format(
        "<text class=\"label middle\" transform=\"translate(13 {:.1f}) "
        "rotate(-90)\">{}</text>\n",
        0.5 * (kTop_px + bottom_px_), escape_html(plot_.y_label));
  }

  void paint_bar(const PlotBar& bar) {
    const double left = at_x(bar.x_low), top = at_y(bar.y_high);
    svg_ += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
        "fill=\"{}\"/>\n",
        left, top, std::max(1.0, at_x(bar.x_high) - left), at_y(bar.y_low) - top,
        escape_html(bar.color));
    if (!bar.label.empty())
      text(0.5 * (left + at_x(bar.x_high)), top - 4, "tick middle", bar.label);
  }

  void paint_series(const PlotSeries& series) {
    if (series.as_line) {
      paint_lines(series);
    } else {
      for (const PlotPoint& point : series.points) paint_dot(series, point);
    }
  }

  void paint_lines(const PlotSeries& series) {
    const auto& points = series.points;
    for (std::size_t begin = 0; begin < points.size();) {
      if (std::isnan(points[begin].y)) {
        ++begin;
        continue;
      }
      const auto gap = std::find_if(points.begin() + static_cast<std::ptrdiff_t>(begin),
                                    points.end(), [](const auto& p) { return std::isnan(p.y); });
      const auto end = static_cast<std::size_t>(gap - points.begin());
      if (end == begin + 1) {
        paint_dot(series, points[begin]);  // a line of one point would be invisible
      } else {
        svg_ += fmt::format("<polyline stroke=\"{}\"{} points=\"", escape_html(series.color),
                            dash_of(series));
        for (std::size_t i = begin; i < end; ++i) {
          svg_ += fmt::format("{:.1f},{:.1f} ", at_x(points[i].x), at_y(points[i].y));
        }
        svg_ += "\"/>\n";
      }
      begin = end;
    }
  }

  void paint_dot(const PlotSeries& series, const PlotPoint& point) {
    svg_ +=
        fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", at_x(point.x),
                    at_y(point.y), series.as_line ? 1.5 : 4.0, escape_html(series.color));
  }

  /// From the front to the back.
  void paint_legend() {
    double x_px = kLeft_px;
    for (auto series = plot_.lines.rbegin(); series != plot_.lines.rend(); ++series) {
      if (series->name.empty()) continue;
      const std::string color = escape_html(series->color);
      if (series->as_line) {
        svg_ += fmt::format(
            "<line stroke=\"{}\" stroke-width=\"3\"{} x1=\"{:.1f}\" y1=\"30\" x2=\"{:.1f}\" "
            "y2=\"30\"/>\n",
            color, dash_of(*series), x_px, x_px + 18);
      } else {
        svg_ +=
            fmt::format("<circle cx=\"{:.1f}\" cy=\"30\" r=\"4\" fill=\"{}\"/>\n", x_px + 9, color);
      }
      text(x_px + 23, 34, "tick", series->name);
      x_px += 23 + kLetter_px * static_cast<double>(series->name.size()) + 16;
    }
  }

  static const char* dash_of(const PlotSeries& series) {
    return series.dashed ? " stroke-dasharray=\"5 4\"" : "";
  }

  const Plot& plot_;
  double right_px_, bottom_px_;
  std::string svg_;
};

}  // namespace

std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::vector<double> plot_ticks(const PlotRange& range, int count) {
  const double least = (range.high - range.low) / count;
  const double power = std::pow(10, std::floor(std::log10(least)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= least * (1 - 1e-9)) step = factor * power;
  }
  std::vector<double> ticks;
  const auto last = static_cast<long long>(std::floor(range.high / step + 1e-9));
  for (auto i = static_cast<long long>(std::ceil(range.low / step - 1e-9)); i <= last; ++i) {
    ticks.push_back(static_cast<double>(i) * step);
  }
  return ticks;
}

std::string Plot::to_svg() const { return Painter(*this).paint(); }

}  // namespace anneal6d
