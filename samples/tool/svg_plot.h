// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace anneal6d {

/// `text` such that HTML and SVG show it as it is, also as the value of a quoted attribute.
std::string escape_html(std::string_view text);

/// Values along one axis; `low` < `high`.
struct PlotRange {
  double low = 0;
  double high = 1;
};

struct PlotPoint {
  double x = 0;
  double y = 0;  ///< not a number: a gap in the line. Beyond the plot's range: drawn at its edge.
};

struct PlotSeries {
  std::string name;   ///< in the legend; empty: not there
  std::string color;  ///< as CSS has it
  std::vector<PlotPoint> points;
  bool as_line = true;  ///< otherwise dots
  bool dashed = false;
};

struct PlotBar {
  double x_low = 0, x_high = 0;
  double y_low = 0, y_high = 0;
  std::string color;
  std::string label;  ///< above the bar
};

/// One diagram with axes, drawn as SVG.
struct Plot {
  std::string title, x_label, y_label;
  PlotRange x, y;
  double width_px = 560, height_px = 220;
  std::vector<PlotBar> bars;      ///< behind everything else
  std::vector<double> marks;      ///< vertical lines, dashed
  std::vector<PlotSeries> lines;  ///< the later ones in front and first in the legend
  /// Upright bars of error: x, lower y, upper y.
  struct Interval {
    double x = 0, y_low = 0, y_high = 0;
  };
  std::vector<Interval> intervals;

  /// An `<svg>` element. Texts are escaped.
  std::string to_svg() const;
};

/// Round values within the range, about `count` of them: 1, 2 or 5 times a power of ten apart.
std::vector<double> plot_ticks(const PlotRange& range, int count);

}  // namespace anneal6d
