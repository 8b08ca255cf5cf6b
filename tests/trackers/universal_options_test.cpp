// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>

#include "anneal6d/framework/error.h"
#include "anneal6d/trackers/universal_tracker.h"

namespace anneal6d {
namespace {

using Options = UniversalTrackerOptions;

Settings settings_of(std::initializer_list<std::pair<std::string, std::string>> values) {
  Settings settings;
  for (const auto& [name, value] : values) settings.set(name, value);
  return settings;
}

Options from(std::initializer_list<std::pair<std::string, std::string>> values) {
  return Options::from(settings_of(values));
}

void expect_refused(const std::string& name, const std::string& value,
                    const std::string& words = {}) {
  try {
    from({{name, value}});
    ADD_FAILURE() << name << " = " << value << " was accepted";
  } catch (const ConfigError& error) {
    const std::string wanted = words.empty() ? "--" + name : words;
    EXPECT_NE(std::string(error.what()).find(wanted), std::string::npos) << error.what();
  }
}

TEST(UniversalOptions, AreTheDefaultsWithoutSettings) {
  const Options options = from({});
  EXPECT_EQ(options.mode, UniversalMode::standard);
  EXPECT_EQ(options.scorer, "sparse");
  EXPECT_EQ(options.annealing, AnnealingRule::thesis);
  EXPECT_FALSE(options.drift);
  EXPECT_EQ(options.view_cache, default_view_cache());
  EXPECT_EQ(options.particles, Options{}.particles);
  EXPECT_EQ(options.rating.rule, RatingRule::balanced);
  EXPECT_EQ(options.frame_edges.op, EdgeOperator::sobel);
  EXPECT_FALSE(options.frame_edges.threshold) << "automatic";
  EXPECT_TRUE(options.model_edges.threshold);
  EXPECT_NO_THROW(options.validate());
}

TEST(UniversalOptions, AreTheThesissInThesisMode) {
  const Options options = from({{"mode", "thesis"}});
  EXPECT_EQ(options.mode, UniversalMode::thesis);
  EXPECT_EQ(options.scorer, "cpu") << "exact";
  EXPECT_EQ(options.particles, 600);
  EXPECT_EQ(options.layers, 5);
  EXPECT_EQ(options.annealing, AnnealingRule::thesis);
  EXPECT_FALSE(options.drift);
  EXPECT_EQ(options.rating.rule, RatingRule::ratio);
  EXPECT_TRUE(options.frame_edges.threshold);
}

TEST(UniversalOptions, TakeEverySetting) {
  const Options options = from({{"mode", "default"},
                                {"scorer", "reference"},
                                {"particles", "77"},
                                {"layers", "3"},
                                {"annealing", "geometric"},
                                {"annealing-ratio", "0.7"},
                                {"drift", "on"},
                                {"sigma-mm", "2.5"},
                                {"sigma-deg", "1.5"},
                                {"edges", "prewitt"},
                                {"edge-threshold", "55"},
                                {"edge-dilation", "2"},
                                {"edge-blur", "0.8"},
                                {"model-edge-threshold", "33"},
                                {"rating", "normalized"},
                                {"rating-c", "11"},
                                {"rating-c1", "1"},
                                {"rating-c2", "2"},
                                {"rating-c3", "3"},
                                {"textured", "off"},
                                {"seed", "9"},
                                {"threads", "2"},
                                {"view-cache", "kept/here"}});
  EXPECT_EQ(options.scorer, "reference");
  EXPECT_EQ(options.particles, 77);
  EXPECT_EQ(options.layers, 3);
  EXPECT_EQ(options.annealing, AnnealingRule::geometric);
  EXPECT_EQ(options.annealing_ratio, 0.7);
  EXPECT_TRUE(options.drift);
  EXPECT_EQ(options.sigma_mm, 2.5);
  EXPECT_EQ(options.sigma_deg, 1.5);
  EXPECT_EQ(options.frame_edges.op, EdgeOperator::prewitt);
  EXPECT_EQ(options.model_edges.op, EdgeOperator::prewitt);
  EXPECT_EQ(options.frame_edges.threshold, 55);
  EXPECT_EQ(options.frame_edges.dilation_px, 2);
  EXPECT_EQ(options.frame_edges.blur_sigma_px, 0.8);
  EXPECT_EQ(options.model_edges.blur_sigma_px, 0.8);
  EXPECT_EQ(options.model_edges.threshold, 33);
  EXPECT_EQ(options.rating.rule, RatingRule::normalized);
  EXPECT_EQ(options.rating.c, 11);
  EXPECT_EQ(options.rating.c1, 1);
  EXPECT_EQ(options.rating.c2, 2);
  EXPECT_EQ(options.rating.c3, 3);
  EXPECT_FALSE(options.textured);
  EXPECT_EQ(options.seed, 9U);
  EXPECT_EQ(options.threads, 2);
  EXPECT_EQ(options.view_cache, std::filesystem::path("kept/here"));
}

TEST(UniversalOptions, KeepViewsNowhereIfTheCacheIsOff) {
  EXPECT_TRUE(from({{"view-cache", "off"}}).view_cache.empty());
}

TEST(UniversalOptions, ChangeThePresetOfTheMode) {
  const Options options = from({{"mode", "thesis"}, {"particles", "50"}, {"rating", "normalized"}});
  EXPECT_EQ(options.particles, 50);
  EXPECT_EQ(options.rating.rule, RatingRule::normalized);
}

TEST(UniversalOptions, TakeThresholdsThatAreAutomatic) {
  EXPECT_FALSE(from({{"mode", "thesis"}, {"edge-threshold", "auto"}}).frame_edges.threshold);
}

TEST(UniversalOptions, WidenTheModelsEdgesForCanny) {
  const Options options =
      from({{"edges", "canny"}, {"edge-threshold", "180"}, {"canny-low", "90"}});
  EXPECT_EQ(options.frame_edges.op, EdgeOperator::canny);
  EXPECT_EQ(options.frame_edges.threshold, 180);
  EXPECT_EQ(options.frame_edges.low_threshold, 90);
  EXPECT_EQ(options.model_edges.op, EdgeOperator::canny);
  EXPECT_EQ(options.model_edges.dilation_px, 1);
  EXPECT_TRUE(options.model_edges.threshold);
  EXPECT_EQ(from({{"edges", "canny"}, {"model-edge-threshold", "222"}}).model_edges.threshold, 222);
}

TEST(UniversalOptions, LeaveSettingsOfOthersAlone) {
  EXPECT_NO_THROW(from({{"overlay", "here.mp4"}, {"model-unit", "mm"}}));
}

TEST(UniversalOptions, NameTheSettingThatIsWrong) {
  expect_refused("mode", "standard");
  expect_refused("mode", "");
  expect_refused("particles", "0");
  expect_refused("particles", "-5");
  expect_refused("particles", "100001");
  expect_refused("particles", "many");
  expect_refused("layers", "0");
  expect_refused("layers", "101");
  expect_refused("annealing", "linear");
  expect_refused("annealing-ratio", "1.5");
  expect_refused("annealing-ratio", "-0.1");
  expect_refused("drift", "maybe");
  expect_refused("sigma-mm", "-1");
  expect_refused("sigma-mm", "nan");
  expect_refused("sigma-mm", "0", "more than 0");
  expect_refused("sigma-deg", "0", "more than 0");
  expect_refused("sigma-deg", "91");
  expect_refused("edges", "roberts", "unknown edge operator 'roberts'");
  expect_refused("edge-threshold", "automatic");
  expect_refused("edge-threshold", "255", "edge threshold 255");
  expect_refused("edge-dilation", "9");
  expect_refused("edge-blur", "6");
  expect_refused("model-edge-threshold", "auto");
  expect_refused("rating", "best");
  expect_refused("rating-c", "-2");
  expect_refused("rating-c", "0", "rating constant c");
  expect_refused("textured", "maybe");
  expect_refused("seed", "-1");
  expect_refused("threads", "-1");
  expect_refused("canny-low", "20", "belongs to canny");
}

TEST(UniversalOptions, AllowNoNoiseInTheThesissMode) {
  Settings settings;
  settings.set("mode", "thesis");
  settings.set("sigma-deg", "0");
  EXPECT_EQ(Options::from(settings).sigma_deg, 0);
}

TEST(UniversalOptions, NameTheFieldThatIsWrong) {
  const auto refused = [](auto change, const char* field) {
    Options options;
    change(options);
    try {
      options.validate();
      ADD_FAILURE() << field << " was accepted";
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
  };
  refused([](Options& o) { o.particles = 0; }, "particles");
  refused([](Options& o) { o.layers = -1; }, "layers");
  refused([](Options& o) { o.annealing_ratio = 2; }, "annealing_ratio");
  refused([](Options& o) { o.sigma_mm = std::numeric_limits<double>::quiet_NaN(); }, "sigma_mm");
  refused([](Options& o) { o.sigma_deg = 1000; }, "sigma_deg");
  refused([](Options& o) { o.threads = -1; }, "threads");
  refused([](Options& o) { o.model_edges.threshold.reset(); }, "model_edges.threshold");
  refused([](Options& o) { o.frame_edges.dilation_px = 100; }, "edge dilation");
  refused([](Options& o) { o.rating.c = 0; }, "rating constant c");
}

}  // namespace
}  // namespace anneal6d
