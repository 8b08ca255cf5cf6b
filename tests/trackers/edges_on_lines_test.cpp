// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "anneal6d/framework/srgb.h"
#include "appearance.h"
#include "line_kernels.h"
#include "smooth_picture.h"

namespace anneal6d {
namespace {

const Eigen::Vector2d kMiddle(30, 20);
const Eigen::Vector2d kRight(1, 0);

/// A stripe of colour, up to a column that may lie between pixels.
struct Stripe {
  double to_column;
  cv::Vec3b bgr;
};

/// What a camera sees of vertical stripes, blurred as trackers blur it. Light mixes within pixels.
cv::Mat stripes(const std::vector<Stripe>& stripes, bool colour = true) {
  cv::Mat image(41, 61, CV_8UC3);
  for (int x = 0; x < image.cols; ++x) {
    std::array<double, 3> light{};
    double begin = x - 0.5;
    for (const Stripe& stripe : stripes) {
      const double end = std::min(x + 0.5, stripe.to_column);
      if (end <= begin) continue;
      for (int c = 0; c < 3; ++c) {
        const auto level = static_cast<std::size_t>(stripe.bgr[c]);
        light[static_cast<std::size_t>(c)] += (end - begin) * srgb_light_table()[level];
      }
      begin = end;
    }
    cv::Vec3b pixel;
    for (int c = 0; c < 3; ++c) {
      const double encoded = 1.055 * std::pow(light[static_cast<std::size_t>(c)], 1 / 2.4) - 0.055;
      pixel[c] = cv::saturate_cast<std::uint8_t>(255 * encoded);
    }
    image.col(x).setTo(pixel);
  }
  if (!colour) cv::extractChannel(image, image, 0);
  cv::Mat smooth;
  cv::GaussianBlur(image, smooth, {5, 5}, 1.0, 1.0, cv::BORDER_REPLICATE);
  return smooth;
}

cv::Vec3b grey(int level) { return cv::Vec3b::all(static_cast<std::uint8_t>(level)); }

struct Edge {
  float offset_px = 0, weight = 0, log_score = 0;
};

/// One line, and what the kernels make of it.
class Line {
 public:
  Line(const SmoothPicture& picture, const Eigen::Vector2d& middle_px,
       const Eigen::Vector2d& normal, int reach_px) {
    const Eigen::Vector2d place = middle_px - Eigen::Vector2d(picture.origin.x, picture.origin.y);
    numbers_[0][0] = static_cast<float>(place.x());
    numbers_[1][0] = static_cast<float>(place.y());
    numbers_[2][0] = static_cast<float>(normal.x());
    numbers_[3][0] = static_cast<float>(normal.y());
    numbers_[4][0] = numbers_[5][0] = -1;
    job_ = lines_through(picture.smooth, reach_px);
    job_.count = 1;
  }

  void require(int polarity) { numbers_[6][0] = static_cast<float>(polarity); }

  void compare(const Appearance& appearance, float inside_px, float outside_px) {
    numbers_[4][0] = inside_px;
    numbers_[5][0] = outside_px;
    appearance_ = &appearance;
  }

  /// The best edges, as many as there are.
  std::vector<Edge> candidates() const {
    Row rows[3][LineJob::kCandidates];
    LineCandidates out;
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      out.offset_px[k] = rows[0][k].data();
      out.weight[k] = rows[1][k].data();
      out.log_score[k] = rows[2][k].data();
    }
    find_candidates(job(), out);
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      if (rows[1][k][0] <= 0) continue;
      edges.push_back({rows[0][k][0], rows[1][k][0], rows[2][k][0]});
    }
    return edges;
  }

  /// The best edge, located in light; nothing if there is none.
  Edge best() const {
    const std::vector<Edge> edges = candidates();
    return edges.empty() ? Edge{} : edges[0];
  }

  /// Offset of the strongest edge, its strength, and how colours agree with the middle.
  struct Strongest {
    float offset_px, strength, agreement;
  };
  Strongest strongest() const {
    Row rows[3];
    find_strongest(job(), {rows[0].data(), rows[1].data(), rows[2].data()});
    return {rows[0][0], rows[1][0], rows[2][0]};
  }

  struct Border {
    float offset_px, variance_px2;
  };
  Border border() const {
    Row rows[2];
    find_borders(job(), rows[0].data(), rows[1].data());
    return {rows[0][0], rows[1][0]};
  }

  int edges_beside(int from_px, int to_px) const {
    return count_edges_beside(job(), from_px, to_px);
  }

 private:
  using Row = std::array<float, LineJob::kPadding>;

  LineJob job() const {
    LineJob job = job_;
    job.x = numbers_[0].data();
    job.y = numbers_[1].data();
    job.normal_x = numbers_[2].data();
    job.normal_y = numbers_[3].data();
    job.inside_px = numbers_[4].data();
    job.outside_px = numbers_[5].data();
    job.polarity = numbers_[6].data();
    job.log_odds = appearance_ ? appearance_->log_odds() : nullptr;
    return job;
  }

  LineJob job_;
  std::array<Row, 7> numbers_{};
  const Appearance* appearance_ = nullptr;
};

TEST(LineOverAStep, FindsItBetweenPixelsWhicheverSideIsBright) {
  for (const auto& [before, behind] : {std::pair(40, 160), std::pair(160, 40), std::pair(30, 60)}) {
    for (double at_px = -4.0; at_px <= 4.0; at_px += 0.25) {
      for (const bool colour : {false, true}) {
        const cv::Mat image =
            stripes({{kMiddle.x() + at_px, grey(before)}, {1e9, grey(behind)}}, colour);
        const Line line({image, {}}, kMiddle, kRight, 8);
        const Edge edge = line.best();
        ASSERT_GT(edge.weight, 0) << before << " to " << behind << " at " << at_px;
        // 0.11 px at worst, where the step halves a pixel: the correction is right on average.
        EXPECT_NEAR(edge.offset_px, at_px, 0.13) << before << " to " << behind;
        EXPECT_NEAR(line.strongest().offset_px, at_px, 0.35) << "shifted to the dark side";
      }
    }
  }
}

TEST(LineOverAStep, CountsFromTheMiddleAlongTheNormal) {
  const cv::Mat image = stripes({{32.5, grey(40)}, {1e9, grey(160)}}, false);
  EXPECT_NEAR(Line({image, {}}, kMiddle, -kRight, 8).best().offset_px, -2.5, 0.13);
  // The same pixels as part of a larger image.
  const Eigen::Vector2d shifted = kMiddle + Eigen::Vector2d(100, 50);
  EXPECT_NEAR(Line({image, {100, 50}}, shifted, kRight, 8).best().offset_px, 2.5, 0.13);
}

TEST(LineOverAStep, FindsNothingOnAPlainPictureOrBeyondItsReach) {
  EXPECT_EQ(Line({stripes({{1e9, grey(90)}}), {}}, kMiddle, kRight, 8).best().weight, 0);
  const cv::Mat far = stripes({{45.0, grey(40)}, {1e9, grey(160)}});
  EXPECT_EQ(Line({far, {}}, kMiddle, kRight, 8).best().weight, 0);
}

TEST(LineOverAStep, StaysInThePictureAtItsBorder) {
  const cv::Mat image = stripes({{2.0, grey(40)}, {1e9, grey(160)}});
  const Line line({image, {}}, {0, 0}, Eigen::Vector2d(-1, -1).normalized(), LineJob::kMaxReach_px);
  EXPECT_TRUE(std::isfinite(line.best().offset_px));
}

TEST(LineWithAPolarity, RefusesTheWrongOne) {
  const cv::Mat image = stripes({{31.0, grey(40)}, {1e9, grey(160)}});
  Line line({image, {}}, kMiddle, kRight, 8);
  line.require(-1);
  EXPECT_EQ(line.best().weight, 0);
  EXPECT_EQ(line.strongest().strength, 0);
  line.require(1);
  EXPECT_NEAR(line.best().offset_px, 1.0, 0.13);
  line.require(0);
  EXPECT_NEAR(line.best().offset_px, 1.0, 0.13);
}

TEST(LineWithColours, PrefersTheObjectsEdgeToStrongerClutter) {
  const cv::Vec3b red(30, 30, 150), table(90, 90, 90), clutter(250, 250, 250);
  // Object, background, and something bright that begins as near to the middle.
  const cv::Mat image = stripes({{27.0, red}, {33.0, table}, {1e9, clutter}});
  Line line({image, {}}, kMiddle, kRight, 8);
  EXPECT_NEAR(line.strongest().offset_px, 3.0, 0.3) << "the stronger edge";
  EXPECT_EQ(line.strongest().agreement, 1);

  Appearance appearance(3);
  line.compare(appearance, 16, 16);
  EXPECT_NEAR(line.strongest().offset_px, 3.0, 0.3) << "nothing was learned yet";

  const std::vector<std::uint16_t> object(200, appearance.bin(red.val));
  const std::vector<std::uint16_t> beside(200, appearance.bin(table.val));
  appearance.learn(object, beside);
  line.compare(appearance, 16, 16);
  EXPECT_NEAR(line.strongest().offset_px, -3.0, 0.3);
  EXPECT_LT(line.strongest().agreement, 0.5) << "the middle is background";

  Line there({image, {}}, kMiddle - Eigen::Vector2d(3, 0), kRight, 8);
  there.compare(appearance, 16, 16);
  EXPECT_GT(there.strongest().agreement, 0.5) << "the middle is the object's border";
}

TEST(LineWithColours, KnowsTheObjectsBorderFarFromTheMiddle) {
  const cv::Vec3b red(30, 30, 150), table(90, 90, 90);
  const cv::Mat image = stripes({{23.0, red}, {1e9, table}});
  Line line({image, {}}, kMiddle, kRight, 16);
  Appearance appearance(3);
  line.compare(appearance, 32, 32);
  const Line::Border unknown = line.border();
  EXPECT_NEAR(unknown.offset_px, 0, 1e-3) << "nothing was learned yet";

  appearance.learn(std::vector<std::uint16_t>(200, appearance.bin(red.val)),
                   std::vector<std::uint16_t>(200, appearance.bin(table.val)));
  line.compare(appearance, 32, 32);
  EXPECT_NEAR(line.border().offset_px, -7.0, 0.5);
  EXPECT_LT(line.border().variance_px2, 0.1F * unknown.variance_px2);
}

TEST(LineOverManyEdges, GivesTheBestFirst) {
  const cv::Mat image =
      stripes({{25.0, grey(60)}, {31.0, grey(160)}, {36.0, grey(60)}, {1e9, grey(160)}});
  const Line line({image, {}}, kMiddle, kRight, 8);
  const std::vector<Edge> edges = line.candidates();
  ASSERT_EQ(edges.size(), 3U);
  EXPECT_NEAR(edges[0].offset_px, 1, 0.2) << "the nearest";
  EXPECT_GE(edges[0].log_score, edges[1].log_score);
  EXPECT_GE(edges[1].log_score, edges[2].log_score);
}

TEST(LineOverManyEdges, CountsThoseAtADistanceOnBothSides) {
  const cv::Mat image =
      stripes({{25.0, grey(60)}, {31.0, grey(160)}, {36.0, grey(60)}, {1e9, grey(160)}});
  const Line line({image, {}}, kMiddle, kRight, 10);
  EXPECT_EQ(line.edges_beside(4, 7), 2);
  EXPECT_EQ(line.edges_beside(2, 3), 0);
  EXPECT_EQ(line.edges_beside(1, 2), 1);
}

}  // namespace
}  // namespace anneal6d
