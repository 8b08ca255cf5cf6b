// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>

#include "anneal6d/framework/edge_detector.h"
#include "instruction_sets.h"
#include "synthetic.h"

namespace anneal6d {
namespace {

using test::draw;
using test::Drawing;
using test::SharedMesh;
using test::small_camera;

struct CountCase {
  EdgeOperator op;
  int threshold;
  int dilation_px;

  std::string name() const {
    const std::map<EdgeOperator, std::string> names{{EdgeOperator::sobel, "Sobel"},
                                                    {EdgeOperator::prewitt, "Prewitt"},
                                                    {EdgeOperator::canny, "Canny"}};
    return names.at(op) + std::to_string(threshold) + "By" + std::to_string(dilation_px);
  }
  friend std::ostream& operator<<(std::ostream& stream, const CountCase& count_case) {
    return stream << count_case.name();
  }
};

class CountingEdges : public testing::TestWithParam<CountCase> {};

// In and partly outside the image, and crossing the near plane.
TEST_P(CountingEdges, EqualsOpenCVsPipeline) {
  EdgeOptions options{.op = GetParam().op,
                      .threshold = GetParam().threshold,
                      .dilation_px = GetParam().dilation_px};
  if (options.op == EdgeOperator::canny) options.low_threshold = GetParam().threshold / 3;
  cv::Mat frame(240, 320, CV_8UC1);
  cv::RNG random(8);
  random.fill(frame, cv::RNG::UNIFORM, 0, 3);
  frame = frame == 0;
  PackedEdges packed;
  packed.assign(frame);

  for (const std::int64_t target : test::instruction_sets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    const test::OnInstructionSet on(target);
    for (const SharedMesh& mesh :
         {test::make_box(80, 60, 40), test::make_coloured_sphere(40), test::make_bowl(45)}) {
      const RasterModel model(mesh, false);
      Rasterizer rasterizer(model, small_camera(), Shading{});
      int seen = 0;
      for (std::uint32_t i = 0; i < 60; ++i) {
        const RandomKey key{.seed = 7, .particle = i};
        const double z_mm = test::random_between(key, 2, i % 3 ? 120 : -20, 500);
        const Pose pose{test::random_rotation(key),
                        {test::random_between(key, 0, -0.6, 0.6) * z_mm,
                         test::random_between(key, 1, -0.5, 0.5) * z_mm, z_mm}};
        if (rasterizer.draw(pose, 2 + options.dilation_px).empty()) continue;
        const EdgeMatch counted = rasterizer.count_edges(packed, options);

        const Drawing drawing = draw(model, small_camera(), pose);
        const cv::Mat edges = detect_edges(drawing.grey, options).binary;
        EXPECT_EQ(counted.rendered, cv::countNonZero(edges)) << "pose " << i;
        EXPECT_EQ(counted.matched, cv::countNonZero(edges & frame)) << "pose " << i;
        seen += counted.rendered > 0;
      }
      EXPECT_GT(seen, 25);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Case, CountingEdges,
    testing::Values(CountCase{EdgeOperator::sobel, 40, 0}, CountCase{EdgeOperator::sobel, 0, 1},
                    CountCase{EdgeOperator::sobel, 254, 2}, CountCase{EdgeOperator::sobel, 60, 8},
                    CountCase{EdgeOperator::prewitt, 25, 0},
                    CountCase{EdgeOperator::prewitt, 40, 3}, CountCase{EdgeOperator::canny, 100, 0},
                    CountCase{EdgeOperator::canny, 30, 1}),
    [](const auto& test) { return test.param.name(); });

}  // namespace
}  // namespace anneal6d
