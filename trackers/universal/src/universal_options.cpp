// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <cmath>
#include <cstdlib>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"
#include "anneal6d/trackers/universal_tracker.h"

namespace anneal6d {
namespace {

UniversalMode parse_mode(const std::string& text) {
  if (text == "thesis") return UniversalMode::thesis;
  if (text == "default") return UniversalMode::standard;
  throw ConfigError("--mode: '" + text + "' is neither thesis nor default");
}

AnnealingRule parse_annealing(const std::string& text) {
  if (text == "thesis") return AnnealingRule::thesis;
  if (text == "geometric") return AnnealingRule::geometric;
  throw ConfigError("--annealing: '" + text + "' is neither thesis nor geometric");
}

RatingRule parse_rating(const std::string& text) {
  if (text == "ratio") return RatingRule::ratio;
  if (text == "normalized") return RatingRule::normalized;
  if (text == "balanced") return RatingRule::balanced;
  throw ConfigError("--rating: '" + text + "' is not one of ratio, normalized, balanced");
}

/// A threshold that may also be "auto"; unchanged if it was not given.
void read_threshold(const Settings& settings, std::string_view name,
                    std::optional<int>& threshold) {
  const auto text = settings.text(name);
  if (!text) return;
  threshold = *text == "auto" ? std::nullopt : settings.integer(name, 0, 10000);
}

UniversalTrackerOptions defaults_of(UniversalMode mode) {
  UniversalTrackerOptions options;
  options.mode = mode;
  if (mode == UniversalMode::thesis) {
    options.particles = 600;
    options.layers = 5;
    options.scorer = "cpu";
    options.frame_edges.threshold = 40;
    options.rating.rule = RatingRule::ratio;
  }
  return options;
}

std::filesystem::path folder_in_environment(const char* name) {
  const char* const value = std::getenv(name);
  return value ? std::filesystem::path(value) : std::filesystem::path();
}

}  // namespace

std::filesystem::path default_view_cache() {
#ifdef _WIN32
  const std::filesystem::path folder = folder_in_environment("LOCALAPPDATA");
#else
  std::filesystem::path folder = folder_in_environment("XDG_CACHE_HOME");
  if (folder.empty()) {
    folder = folder_in_environment("HOME");
    if (!folder.empty()) folder /= ".cache";
  }
#endif
  return folder.is_absolute() ? folder / "anneal6d" : std::filesystem::path();
}

UniversalTrackerOptions UniversalTrackerOptions::from(const Settings& settings) {
  UniversalTrackerOptions o = defaults_of(parse_mode(settings.text("mode").value_or("default")));
  o.scorer = settings.text("scorer").value_or(o.scorer);
  o.particles = settings.integer("particles", 1, 100000).value_or(o.particles);
  o.layers = settings.integer("layers", 1, 100).value_or(o.layers);
  if (const auto rule = settings.text("annealing")) o.annealing = parse_annealing(*rule);
  o.annealing_ratio = settings.number("annealing-ratio", 0, 1).value_or(o.annealing_ratio);
  o.drift = settings.flag("drift").value_or(o.drift);
  o.sigma_mm = settings.number("sigma-mm", 0, 1000).value_or(o.sigma_mm);
  o.sigma_deg = settings.number("sigma-deg", 0, 90).value_or(o.sigma_deg);

  if (const auto op = settings.text("edges")) {
    o.frame_edges.op = o.model_edges.op = parse_edge_operator(*op);
    // Canny's edges are one pixel wide: the thesis widens those of the model, too (Alg. 4).
    if (o.frame_edges.op == EdgeOperator::canny) {
      o.frame_edges.threshold.reset();
      o.model_edges = {.op = EdgeOperator::canny, .threshold = 100, .dilation_px = 1};
    }
  }
  read_threshold(settings, "edge-threshold", o.frame_edges.threshold);
  read_threshold(settings, "canny-low", o.frame_edges.low_threshold);
  o.frame_edges.dilation_px =
      settings.integer("edge-dilation", 0, 8).value_or(o.frame_edges.dilation_px);
  o.frame_edges.blur_sigma_px =
      settings.number("edge-blur", 0, 5).value_or(o.frame_edges.blur_sigma_px);
  o.model_edges.blur_sigma_px = o.frame_edges.blur_sigma_px;
  if (const auto threshold = settings.integer("model-edge-threshold", 0, 10000)) {
    o.model_edges.threshold = threshold;
  }

  if (const auto rule = settings.text("rating")) o.rating.rule = parse_rating(*rule);
  o.rating.c = settings.number("rating-c", 0, 1e6).value_or(o.rating.c);
  o.rating.c1 = settings.number("rating-c1", 0, 1e6).value_or(o.rating.c1);
  o.rating.c2 = settings.number("rating-c2", 0, 1e6).value_or(o.rating.c2);
  o.rating.c3 = settings.number("rating-c3", 0, 1e6).value_or(o.rating.c3);

  o.textured = settings.flag("textured").value_or(o.textured);
  o.seed = settings.natural_number("seed").value_or(o.seed);
  o.threads = settings.integer("threads", 0, 1024).value_or(o.threads);
  if (const auto folder = settings.text("view-cache")) {
    o.view_cache = *folder == "off" ? std::filesystem::path() : std::filesystem::path(*folder);
  }
  o.validate();
  return o;
}

void UniversalTrackerOptions::validate() const {
  const auto check = [](const char* field, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      throw ConfigError(std::string("universal tracker: ") + field + " = " + std::to_string(value) +
                        " is not in " + std::to_string(low) + ".." + std::to_string(high));
    }
  };
  check("particles", particles, 1, 100000);
  check("layers", layers, 1, 100);
  check("annealing_ratio", annealing_ratio, 0, 1);
  check("sigma_mm", sigma_mm, 0, 1000);
  check("sigma_deg", sigma_deg, 0, 90);
  if (mode == UniversalMode::standard && (sigma_mm == 0 || sigma_deg == 0)) {
    throw ConfigError(
        "universal tracker: sigma_mm and sigma_deg must be more than 0 in default mode, which "
        "expects no motion at all otherwise");
  }
  check("threads", threads, 0, 1024);
  frame_edges.validate();
  model_edges.validate();
  if (!model_edges.threshold) {
    throw ConfigError("universal tracker: model_edges.threshold must be a number, not automatic");
  }
  rating.validate();
}

}  // namespace anneal6d
