// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// What every PoseScorer keeps to, whatever it is made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <ostream>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/rating.h"
#include "anneal6d/trackers/universal_tracker.h"
#include "scorer_cases.h"
#include "special_numbers.h"

namespace anneal6d {

bool operator==(const EdgeMatch& a, const EdgeMatch& b) {
  return a.rendered == b.rendered && a.matched == b.matched;
}

std::ostream& operator<<(std::ostream& stream, const EdgeMatch& match) {
  return stream << match.matched << " of " << match.rendered;
}

namespace {

using test::kInfinity;
using test::kNaN;
using test::Placement;
using test::scores;

constexpr EdgeMatch kNothing{0, 0};

Pose at(double x_mm, double y_mm, double z_mm) {
  return {Eigen::Quaterniond::Identity(), {x_mm, y_mm, z_mm}};
}

/// The textured can, Sobel.
ScorerSetup can_setup() {
  ScorerSetup setup;
  setup.view_cache = default_view_cache();
  setup.mesh = test::models()[1].mesh;
  setup.camera = test::vga_camera();
  setup.edges.threshold = 40;
  return setup;
}

/// A thin box; at z = 500 mm its front covers 100 x 60 pixels.
ScorerSetup plate_setup() {
  ScorerSetup setup;
  setup.view_cache = default_view_cache();
  setup.mesh = test::make_box(100, 60, 0.02F);
  setup.camera = {
      .width_px = 640, .height_px = 480, .fx_px = 500, .fy_px = 500, .cx_px = 320, .cy_px = 240};
  setup.edges.threshold = 40;
  return setup;
}

const Pose kPlateInTheMiddle = at(0.5, 0.5, 500.01);  // columns 271..370, rows 211..270

/// Pixels on the border of a plate of w x h pixels that differ from the middle by at most `reach`
/// pixels: `outward` beyond it, `inward` within.
constexpr int border_pixels(int w, int h, int outward, int inward) {
  return (w + 2 * outward) * (h + 2 * outward) - (w - 2 * inward) * (h - 2 * inward);
}

/// The `sparse` scorer estimates counts from views of the object at another size, distance, and
/// angle in the image: within 40 % for a plate, of which the frame's image confirms the right
/// share. All others count.
bool only_estimates(std::string_view scorer) { return scorer == "sparse"; }

void expect_match(std::string_view scorer, const EdgeMatch& found, const EdgeMatch& expected) {
  if (!only_estimates(scorer)) {
    EXPECT_EQ(found, expected);
    return;
  }
  EXPECT_NEAR(found.rendered, expected.rendered, 0.4 * expected.rendered);
  EXPECT_NEAR(match_ratio(found), match_ratio(expected), 0.05);
}

class EveryScorer : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    for (const ScorerPlugin& plugin : table_) {
      if (plugin.name != GetParam()) continue;
      if (const std::string reason = plugin.obstacle(); !reason.empty()) {
        GTEST_SKIP() << reason;
      }
    }
  }

  std::unique_ptr<PoseScorer> make(const ScorerSetup& setup) const {
    return make_plugin(table_, "scorer", GetParam(), setup);
  }
  std::unique_ptr<PoseScorer> make(const ScorerSetup& setup, const EdgeImage& edges) const {
    auto scorer = make(setup);
    scorer->set_edges(edges);
    return scorer;
  }
  static EdgeMatch score(PoseScorer& scorer, const Pose& pose) {
    return scores(scorer, {&pose, 1})[0];
  }
  /// Poses of every kind in one batch.
  static std::vector<Pose> mixed_poses(const ScorerSetup& setup) {
    std::vector<Pose> poses;
    for (const Placement placement :
         {Placement::inside, Placement::border, Placement::near, Placement::behind}) {
      const auto some = test::random_poses(*setup.mesh, setup.camera, placement, 12);
      poses.insert(poses.end(), some.begin(), some.end());
    }
    return poses;
  }

 private:
  ScorerTable table_ = test::all_scorers();
};

TEST_P(EveryScorer, CountsTheEdgesOfAPlateByHand) {
  // Sobel responds on both sides of a border.
  const ScorerSetup setup = plate_setup();
  EdgeImage upper_half = test::uniform_edges(setup.camera, 0);
  upper_half.binary.rowRange(0, 241).setTo(255);  // 211..240 are half of the plate's rows
  const auto scorer = make(setup, upper_half);
  const int border = border_pixels(100, 60, 1, 1);
  expect_match(GetParam(), score(*scorer, kPlateInTheMiddle), {border, border / 2});
}

TEST_P(EveryScorer, WidensTheEdgesOfThePlate) {
  ScorerSetup setup = plate_setup();
  setup.edges.dilation_px = 3;
  const auto scorer = make(setup, test::uniform_edges(setup.camera, 255));
  const int border = border_pixels(100, 60, 4, 4);
  expect_match(GetParam(), score(*scorer, kPlateInTheMiddle), {border, border});
}

TEST_P(EveryScorer, CountsInsideTheImageOnly) {
  // The plate's middle is on the right border of the image: columns 590..639 of it are seen. The
  // border of the image itself is no edge.
  const ScorerSetup setup = plate_setup();
  const auto scorer = make(setup, test::uniform_edges(setup.camera, 255));
  const int half = (50 + 1) * (60 + 2) - (50 - 1) * (60 - 2);
  expect_match(GetParam(), score(*scorer, at(319.5, 0.5, 500.01)), {half, half});
}

TEST_P(EveryScorer, SeesNoEdgeWhereAFlatFaceFillsTheImage) {
  const ScorerSetup setup = plate_setup();
  const auto scorer = make(setup, test::uniform_edges(setup.camera, 255));
  EXPECT_EQ(score(*scorer, at(0, 0, 30)), kNothing);
}

TEST_P(EveryScorer, GivesNothingForWhatCannotBeSeen) {
  const auto scorer = make(can_setup(), test::uniform_edges(can_setup().camera, 255));
  EXPECT_GT(score(*scorer, at(0, 0, 600)).rendered, 0);
  EXPECT_EQ(score(*scorer, at(0, 0, -600)), kNothing);
  EXPECT_EQ(score(*scorer, at(0, 0, -150)), kNothing);
  for (const double far_mm : {5000.0, 1e6, 1e12, 1e300}) {
    for (const double side : {-1.0, 1.0}) {
      EXPECT_EQ(score(*scorer, at(side * far_mm, 0, 600)), kNothing) << far_mm;
      EXPECT_EQ(score(*scorer, at(0, side * far_mm, 600)), kNothing) << far_mm;
    }
  }
  EXPECT_EQ(score(*scorer, at(0, 0, 1e12)), kNothing);
}

TEST_P(EveryScorer, GivesNothingBehindTheCamera) {
  for (const test::Model& model : test::models()) {
    ScorerSetup setup = can_setup();
    setup.mesh = model.mesh;
    const auto scorer = make(setup, test::uniform_edges(setup.camera, 255));
    const auto poses = test::random_poses(*model.mesh, setup.camera, Placement::behind, 20);
    for (const EdgeMatch& match : scores(*scorer, poses)) EXPECT_EQ(match, kNothing) << model.name;
  }
}

TEST_P(EveryScorer, GivesNothingForPosesThatAreNotFinite) {
  const auto scorer = make(can_setup(), test::uniform_edges(can_setup().camera, 255));
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    for (int i = 0; i < 3; ++i) {
      Pose pose = at(0, 0, 600);
      pose.translation_mm[i] = bad;
      EXPECT_EQ(score(*scorer, pose), kNothing);
    }
    for (int i = 0; i < 4; ++i) {
      Pose pose = at(0, 0, 600);
      pose.rotation.coeffs()[i] = bad;
      EXPECT_EQ(score(*scorer, pose), kNothing);
    }
  }
}

TEST_P(EveryScorer, GoesOnAfterPosesThatAreNotFinite) {
  const auto scorer = make(can_setup(), test::cluttered_edges(can_setup().camera));
  const EdgeMatch before = score(*scorer, at(0, 0, 600));
  score(*scorer, at(kNaN, 0, 600));
  EXPECT_EQ(score(*scorer, at(0, 0, 600)), before);
}

TEST_P(EveryScorer, MatchesEverythingOnWhite) {
  const auto scorer = make(can_setup(), test::uniform_edges(can_setup().camera, 255));
  for (const EdgeMatch& match : scores(*scorer, mixed_poses(can_setup()))) {
    EXPECT_EQ(match.matched, match.rendered);
  }
}

TEST_P(EveryScorer, MatchesNothingOnBlack) {
  const auto scorer = make(can_setup(), test::uniform_edges(can_setup().camera, 0));
  int rendered = 0;
  for (const EdgeMatch& match : scores(*scorer, mixed_poses(can_setup()))) {
    EXPECT_EQ(match.matched, 0);
    rendered += match.rendered;
  }
  EXPECT_GT(rendered, 1000);
}

TEST_P(EveryScorer, MatchesAtMostWhatItRenders) {
  for (const test::EdgeCase& edge_case : test::edge_cases()) {
    ScorerSetup setup = can_setup();
    setup.edges = edge_case.edges;
    const auto scorer = make(setup, test::cluttered_edges(setup.camera));
    for (const EdgeMatch& match : scores(*scorer, mixed_poses(setup))) {
      EXPECT_GE(match.matched, 0) << edge_case.name;
      EXPECT_LE(match.matched, match.rendered) << edge_case.name;
    }
  }
}

TEST_P(EveryScorer, CountsMatchesAndTheirComplement) {
  const ScorerSetup setup = can_setup();
  const EdgeImage some = test::cluttered_edges(setup.camera);
  const EdgeImage others{255 - some.binary};
  const auto scorer = make(setup, some);
  const auto poses = mixed_poses(setup);
  const auto with_some = scores(*scorer, poses);
  scorer->set_edges(others);
  const auto with_others = scores(*scorer, poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(with_some[i].rendered, with_others[i].rendered);
    const int sum = with_some[i].matched + with_others[i].matched;
    const int rounding = only_estimates(GetParam()) ? 1 : 0;
    EXPECT_NEAR(sum, with_some[i].rendered, rounding);
  }
}

TEST_P(EveryScorer, ScoresABatchAsOneByOneAndRepeatedly) {
  const ScorerSetup setup = can_setup();
  const auto scorer = make(setup, test::cluttered_edges(setup.camera));
  const auto poses = mixed_poses(setup);
  const auto batch = scores(*scorer, poses);
  EXPECT_EQ(scores(*scorer, poses), batch);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(score(*scorer, poses[i]), batch[i]) << "pose " << i;
  }
}

TEST_P(EveryScorer, ScoresInAnyOrder) {
  const ScorerSetup setup = can_setup();
  const auto scorer = make(setup, test::cluttered_edges(setup.camera));
  std::vector<Pose> poses = mixed_poses(setup);
  std::vector<EdgeMatch> forward = scores(*scorer, poses);
  std::reverse(poses.begin(), poses.end());
  std::reverse(forward.begin(), forward.end());
  EXPECT_EQ(scores(*scorer, poses), forward);
}

TEST_P(EveryScorer, ScoresTheSameOnOneAndOnTwoThreads) {
  for (const test::EdgeCase& edge_case : test::edge_cases()) {
    ScorerSetup setup = can_setup();
    setup.edges = edge_case.edges;
    const auto poses = mixed_poses(setup);
    setup.threads = 1;
    const auto one = scores(*make(setup, test::cluttered_edges(setup.camera)), poses);
    setup.threads = 2;
    const auto two = scores(*make(setup, test::cluttered_edges(setup.camera)), poses);
    EXPECT_EQ(one, two) << edge_case.name;
  }
}

TEST_P(EveryScorer, TakesAnEmptyBatch) {
  const auto scorer = make(can_setup(), test::uniform_edges(can_setup().camera, 0));
  EXPECT_NO_THROW(scorer->score({}, {}));
}

TEST_P(EveryScorer, UsesTheLastEdgesGiven) {
  const ScorerSetup setup = can_setup();
  const auto scorer = make(setup, test::uniform_edges(setup.camera, 255));
  const EdgeMatch white = score(*scorer, at(0, 0, 600));
  scorer->set_edges(test::uniform_edges(setup.camera, 0));
  EXPECT_EQ(score(*scorer, at(0, 0, 600)), (EdgeMatch{white.rendered, 0}));
  scorer->set_edges(test::uniform_edges(setup.camera, 255));
  EXPECT_EQ(score(*scorer, at(0, 0, 600)), white);
}

TEST_P(EveryScorer, RefusesEdgesOfAnotherSizeOrTypeAndKeepsTheLast) {
  const ScorerSetup setup = can_setup();
  const auto scorer = make(setup, test::uniform_edges(setup.camera, 255));
  EXPECT_THROW(scorer->set_edges({cv::Mat(240, 320, CV_8UC1, cv::Scalar(0))}), ConfigError);
  EXPECT_THROW(scorer->set_edges({cv::Mat(640, 480, CV_8UC1, cv::Scalar(0))}), ConfigError);
  EXPECT_THROW(scorer->set_edges({cv::Mat(480, 640, CV_8UC3, cv::Scalar(0))}), ConfigError);
  EXPECT_THROW(scorer->set_edges({cv::Mat(480, 640, CV_32FC1, cv::Scalar(0))}), ConfigError);
  EXPECT_THROW(scorer->set_edges({}), ConfigError);
  const EdgeMatch match = score(*scorer, at(0, 0, 600));
  EXPECT_EQ(match.matched, match.rendered);
}

TEST_P(EveryScorer, TakesEdgesThatArePartOfALargerImage) {
  const ScorerSetup setup = can_setup();
  const EdgeImage whole = test::cluttered_edges(setup.camera);
  cv::Mat large(700, 900, CV_8UC1, cv::Scalar(255));
  const cv::Mat part = large(cv::Rect(30, 40, 640, 480));
  whole.binary.copyTo(part);
  EXPECT_EQ(score(*make(setup, {part}), at(0, 0, 600)), score(*make(setup, whole), at(0, 0, 600)));
}

TEST_P(EveryScorer, TakesImagesOfAnySize) {
  for (const cv::Size size : {cv::Size(16, 16), cv::Size(101, 67), cv::Size(333, 21)}) {
    ScorerSetup setup = can_setup();
    setup.camera = {.width_px = size.width,
                    .height_px = size.height,
                    .fx_px = 300,
                    .fy_px = 300,
                    .cx_px = size.width / 2.0,
                    .cy_px = size.height / 2.0};
    setup.edges.dilation_px = 2;
    const auto scorer = make(setup, test::uniform_edges(setup.camera, 255));
    int rendered = 0;
    for (const EdgeMatch& match : scores(*scorer, mixed_poses(setup))) {
      EXPECT_EQ(match.matched, match.rendered) << size.width << "x" << size.height;
      // An estimate does not know how crowded a small image is.
      if (!only_estimates(GetParam())) {
        EXPECT_LE(match.rendered, size.area()) << size.width << "x" << size.height;
      }
      rendered += match.rendered;
    }
    EXPECT_GT(rendered, 0) << size.width << "x" << size.height;
  }
}

TEST_P(EveryScorer, SeesTheTextureUnlessToldNotTo) {
  ScorerSetup setup = can_setup();
  const EdgeImage white = test::uniform_edges(setup.camera, 255);
  const int textured = score(*make(setup, white), at(0, 0, 600)).rendered;
  setup.textured = false;
  const int plain = score(*make(setup, white), at(0, 0, 600)).rendered;
  EXPECT_GT(textured, plain + plain / 4);
}

TEST_P(EveryScorer, ShadesByTheLightOfItsSetup) {
  // Without a difference in light between its faces, a box shows its silhouette only.
  ScorerSetup setup = plate_setup();
  setup.mesh = test::make_box(80, 80, 80);
  const EdgeImage white = test::uniform_edges(setup.camera, 255);
  const Pose corner{rotation_from_axis_angle({1, 1, 0}, 0.8), {0, 0, 400}};
  const int shaded = score(*make(setup, white), corner).rendered;
  setup.shading.ambient = 1;
  setup.shading.diffuse = 0;
  const int flat = score(*make(setup, white), corner).rendered;
  EXPECT_GT(flat, 0);
  EXPECT_GT(shaded, flat + flat / 5);
}

TEST_P(EveryScorer, RefusesASetupThatMakesNoSense) {
  const auto refused = [&](auto change) {
    ScorerSetup setup = can_setup();
    change(setup);
    EXPECT_THROW(make(setup), ConfigError);
  };
  refused([](ScorerSetup& setup) { setup.mesh = nullptr; });
  refused([](ScorerSetup& setup) { setup.camera.fx_px = 0; });
  refused([](ScorerSetup& setup) { setup.edges.threshold.reset(); });
  refused([](ScorerSetup& setup) { setup.edges.threshold = 300; });
  refused([](ScorerSetup& setup) { setup.edges.dilation_px = -1; });
  refused([](ScorerSetup& setup) { setup.threads = -1; });
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const ScorerPlugin& plugin : test::all_scorers()) names.push_back(plugin.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scorer, EveryScorer, testing::ValuesIn(all_names()), [](const auto& test) {
  std::string name = test.param;
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

}  // namespace
}  // namespace anneal6d
