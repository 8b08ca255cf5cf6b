// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "line_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "anneal6d/framework/srgb.h"
#include "appearance.h"
#include "instruction_sets.h"
#include "smooth_picture.h"

namespace anneal6d {
namespace {

/// Interpolated between the four pixels around a place; outside, as at the border.
double interpolated(const cv::Mat& picture, int channel, double x, double y) {
  x = std::clamp(x, 0.0, picture.cols - 1.001);
  y = std::clamp(y, 0.0, picture.rows - 1.001);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const auto pixel = [&](int r, int c) -> double {
    return picture.ptr<std::uint8_t>(r)[c * picture.channels() + channel];
  };
  const double right = x - column, down = y - row;
  return (1 - down) * ((1 - right) * pixel(row, column) + right * pixel(row, column + 1)) +
         down * ((1 - right) * pixel(row + 1, column) + right * pixel(row + 1, column + 1));
}

/// A picture in memory that ends with its last pixel, so that a sanitizer sees reads behind it.
cv::Mat tight_picture(std::vector<std::uint8_t>& bytes, int channels) {
  bytes.resize(static_cast<std::size_t>(23 * 17 * channels));
  cv::RNG random(5);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.uniform(0, 256));
  return {17, 23, CV_8UC(channels), bytes.data()};
}

/// Lines in all directions, over the border, too.
struct Lines {
  static constexpr std::size_t kCount = 37;
  using Row = std::array<float, kCount + LineJob::kPadding>;
  Row x, y, normal_x, normal_y, inside_px, outside_px, polarity;

  Lines() {
    cv::RNG random(7);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double angle = random.uniform(0.0, 6.28);
      x[i] = random.uniform(-3.0F, 26.0F);
      y[i] = random.uniform(-3.0F, 20.0F);
      normal_x[i] = static_cast<float>(std::cos(angle));
      normal_y[i] = static_cast<float>(std::sin(angle));
      inside_px[i] = random.uniform(0, 3) == 0 ? -1.0F : random.uniform(0.0F, 16.0F);
      outside_px[i] = random.uniform(0.0F, 16.0F);
      polarity[i] = static_cast<float>(random.uniform(-1, 2));
    }
  }

  LineJob job(const cv::Mat& picture, int reach_px) const {
    LineJob job = lines_through(picture, reach_px);
    job.count = kCount;
    job.x = x.data();
    job.y = y.data();
    job.normal_x = normal_x.data();
    job.normal_y = normal_y.data();
    job.inside_px = inside_px.data();
    job.outside_px = outside_px.data();
    job.polarity = polarity.data();
    return job;
  }

  /// Just one of them.
  LineJob job(const cv::Mat& picture, int reach_px, std::size_t line) const {
    LineJob one = job(picture, reach_px);
    one.count = 1;
    for (const float** row : {&one.x, &one.y, &one.normal_x, &one.normal_y, &one.inside_px,
                              &one.outside_px, &one.polarity}) {
      *row += line;
    }
    return one;
  }
};

class SampledLines : public testing::TestWithParam<int> {};

TEST_P(SampledLines, InterpolateBetweenPixelsStayInThePictureAndHaveItsSlopes) {
  std::vector<std::uint8_t> bytes;
  const cv::Mat picture = tight_picture(bytes, GetParam());
  const Lines lines;
  constexpr int kReach_px = 13;
  constexpr int kMiddleSample = kReach_px + kLineMargin;
  for (const std::int64_t target : test::instruction_sets()) {
    const test::OnInstructionSet on(target);
    SCOPED_TRACE(hwy::TargetName(target));
    for (std::size_t line = 0; line < Lines::kCount; ++line) {
      std::array<std::vector<float>, 3> grey;
      for (auto& row : grey) row.resize(kLongestLine * kLongestVector);
      std::vector<float> slope(kLongestLine * kLongestVector);
      sample_lines(lines.job(picture, kReach_px, line),
                   {{grey[0].data(), grey[1].data(), grey[2].data()}, slope.data()});
      const auto sample = [&](const std::vector<float>& row, int i) {
        return row[static_cast<std::size_t>(i) * kLongestVector];
      };
      for (int i = 0; i <= 2 * kMiddleSample; ++i) {
        const double along = i - kMiddleSample;
        double sum = 0;
        for (int channel = 0; channel < picture.channels(); ++channel) {
          const auto& row = grey[static_cast<std::size_t>(channel)];
          const double expected =
              interpolated(picture, channel, lines.x[line] + along * lines.normal_x[line],
                           lines.y[line] + along * lines.normal_y[line]);
          EXPECT_NEAR(sample(row, i), expected, 0.02)
              << "sample " << i << " of line " << line << ", channel " << channel;
          if (i == 0 || i == 2 * kMiddleSample) continue;
          sum += std::pow(0.5 * (sample(row, i + 1) - sample(row, i - 1)), 2);
        }
        if (i == 0 || i == 2 * kMiddleSample) continue;
        EXPECT_NEAR(sample(slope, i), std::sqrt(sum), 1e-3) << "sample " << i << " of " << line;
      }
    }
  }
}

// Vectors of all lengths, the last one not full: a line shows the same alone as beside others.
TEST_P(SampledLines, ShowTheSameEdgesOnEveryInstructionSetAlone) {
  std::vector<std::uint8_t> bytes;
  const cv::Mat picture = tight_picture(bytes, GetParam());
  Appearance appearance(GetParam());
  std::vector<std::uint16_t> object, beside;
  for (std::size_t i = 0; i + 4 < bytes.size(); ++i) {
    (i % 3 == 0 ? object : beside).push_back(appearance.bin(bytes.data() + i));
  }
  appearance.learn(object, beside);
  const Lines lines;
  using Row = Lines::Row;
  struct Rows {
    std::array<Row, 9> candidates{};
    std::array<Row, 6> others{};
  };
  const auto ask = [&](LineJob job) {
    job.log_odds = appearance.log_odds();
    job.blur_px = job.outside_px;
    Rows rows;
    LineCandidates candidates;
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      candidates.offset_px[k] = rows.candidates[3 * k].data();
      candidates.weight[k] = rows.candidates[3 * k + 1].data();
      candidates.log_score[k] = rows.candidates[3 * k + 2].data();
    }
    find_candidates(job, candidates);
    find_strongest(job, {rows.others[0].data(), rows.others[1].data(), rows.others[2].data(),
                         rows.others[5].data()});
    find_borders(job, rows.others[3].data(), rows.others[4].data());
    return rows;
  };
  for (const int reach_px : {1, 6, LineJob::kMaxReach_px}) {
    int edges = 0;
    for (const std::int64_t target : test::instruction_sets()) {
      const test::OnInstructionSet on(target);
      SCOPED_TRACE(hwy::TargetName(target));
      const Rows all = ask(lines.job(picture, reach_px));
      int beside_alone = 0;
      for (std::size_t line = 0; line < Lines::kCount; ++line) {
        const LineJob one = lines.job(picture, reach_px, line);
        const Rows alone = ask(one);
        for (std::size_t row = 0; row < all.candidates.size(); ++row) {
          EXPECT_EQ(all.candidates[row][line], alone.candidates[row][0]) << row << ", " << line;
        }
        for (std::size_t row = 0; row < all.others.size(); ++row) {
          EXPECT_EQ(all.others[row][line], alone.others[row][0]) << row << ", " << line;
        }
        edges += alone.candidates[1][0] > 0;
        beside_alone += count_edges_beside(one, 1, reach_px);
      }
      EXPECT_EQ(count_edges_beside(lines.job(picture, reach_px), 1, reach_px), beside_alone);
    }
    EXPECT_GT(edges, 5) << "a picture with edges";
  }
}

INSTANTIATE_TEST_SUITE_P(GreyAndColour, SampledLines, testing::Values(1, 3));

/// Where the edge is found of an object that fades towards its outline, in pixels behind that.
float edge_of_faded_object(int background, const float* shading_px, float share = 1) {
  constexpr int kOutside = 24;  // the first column of the background
  cv::Mat picture(16, 48, CV_8UC1, cv::Scalar(background));
  for (int x = 0; x < kOutside; ++x) {
    picture.col(x) = 150.0 - 40.0 / std::sqrt(static_cast<double>(kOutside - x));
  }
  cv::GaussianBlur(picture, picture, {5, 5}, 1.0, 1.0);
  Lines lines;
  lines.x[0] = kOutside - 0.5F;
  lines.y[0] = 8;
  lines.normal_x[0] = 1;
  lines.normal_y[0] = 0;
  lines.inside_px[0] = lines.outside_px[0] = 8;
  lines.polarity[0] = 0;
  LineJob job = lines.job(picture, 3, 0);
  job.shading_px = shading_px;
  job.shading_share = share;
  Lines::Row offset{}, strength{}, agreement{};
  find_strongest(job, {offset.data(), strength.data(), agreement.data()});
  EXPECT_GT(strength[0], 0) << "no edge before " << background;
  return offset[0];
}

TEST(EdgesOfAShadedObject, AreNearerToWhereItEndsBeforeAnyBackground) {
  const std::array<float, 1 + LineJob::kPadding> shading_px{edge_of_faded_object(0, nullptr)};
  EXPECT_LT(shading_px[0], -0.1F) << "inside";
  EXPECT_LT(edge_of_faded_object(60, nullptr), shading_px[0]) << "there is less contrast";
  EXPECT_GT(edge_of_faded_object(200, nullptr), 0.1F) << "outside, before what is brighter";
  for (const int background : {0, 30, 60, 80, 160, 180, 200, 220, 240}) {
    const float found_px = edge_of_faded_object(background, nullptr);
    const float told_px = edge_of_faded_object(background, shading_px.data());
    EXPECT_LT(std::abs(told_px), 0.6F * std::abs(found_px)) << background;
    const float half_told_px = edge_of_faded_object(background, shading_px.data(), 0.5F);
    EXPECT_NEAR(half_told_px, 0.5F * (told_px + found_px), 1e-5F) << background;
  }
}

/// A step from one level to another, whose light is gathered while it moves by `blur_px`.
class MovingStep {
 public:
  MovingStep(int from, int to, float blur_px) : blur_px_{blur_px} {
    const auto& light = srgb_light_table();
    cv::Mat row(1, kWidth, CV_8UC1);
    for (int x = 0; x < kWidth; ++x) {
      double sum = 0;
      for (int i = 0; i < kParts * kParts; ++i) {
        const double in_pixel = (i % kParts + 0.5) / kParts - 0.5;
        const double moved_px = blur_px * ((i / kParts + 0.5) / kParts - 0.5);
        const bool before = x + in_pixel < kStep + moved_px;
        sum += light[static_cast<std::size_t>(before ? from : to)];
      }
      const double encoded = 1.055 * std::pow(sum / (kParts * kParts), 1 / 2.4) - 0.055;
      row.at<std::uint8_t>(0, x) = cv::saturate_cast<std::uint8_t>(255 * encoded);
    }
    cv::repeat(row, 16, 1, picture_);
    cv::GaussianBlur(picture_, picture_, {5, 5}, 1.0, 1.0);
    lines_.x[0] = kStep;
    lines_.y[0] = 8;
    lines_.normal_x[0] = 1;
    lines_.normal_y[0] = lines_.polarity[0] = 0;
    lines_.inside_px[0] = -1;
  }

  /// Where it is found, in pixels behind the middle of its way.
  float found_px(bool told_of_blur) const {
    Lines::Row rows[3][LineJob::kCandidates];
    LineCandidates candidates;
    for (std::size_t k = 0; k < LineJob::kCandidates; ++k) {
      candidates.offset_px[k] = rows[0][k].data();
      candidates.weight[k] = rows[1][k].data();
      candidates.log_score[k] = rows[2][k].data();
    }
    LineJob job = lines_.job(picture_, 4, 0);
    if (told_of_blur) job.blur_px = blur_px_.data();
    find_candidates(job, candidates);
    EXPECT_GT(rows[1][0][0], 0) << "no edge";
    return rows[0][0][0];
  }

  float sharpness() const {
    Lines::Row offset, strength, agreement, sharpness;
    find_strongest(lines_.job(picture_, 4, 0),
                   {offset.data(), strength.data(), agreement.data(), sharpness.data()});
    return sharpness[0];
  }

 private:
  static constexpr int kWidth = 48, kParts = 24;
  static constexpr float kStep = 23.5F;

  std::array<float, 1 + LineJob::kPadding> blur_px_;
  cv::Mat picture_;
  Lines lines_;
};

TEST(EdgesBlurredByMotion, AreFoundInTheMiddleOfTheirWay) {
  for (const float blur_px : {1.5F, 2.0F, 3.0F, 4.0F}) {
    for (const auto& [from, to] : {std::pair(230, 40), std::pair(60, 200)}) {
      const MovingStep step(from, to, blur_px);
      SCOPED_TRACE(testing::Message() << blur_px << " px from " << from << " to " << to);
      const float untold_px = step.found_px(false);
      EXPECT_GT(from > to ? untold_px : -untold_px, 0.08F) << "bright objects look large";
      EXPECT_LT(std::abs(step.found_px(true)), 0.5F * std::abs(untold_px));
    }
  }
}

TEST(EdgesBlurredByMotion, AreTheLessSharpTheFartherTheyMove) {
  float last = 1;
  for (const float blur_px : {0.0F, 1.0F, 2.0F, 3.0F, 4.0F}) {
    const float sharpness = MovingStep(200, 80, blur_px).sharpness();
    EXPECT_LT(sharpness, last) << blur_px;
    EXPECT_GT(sharpness, 0) << blur_px;
    last = sharpness;
  }
  // A ramp of 4 pixels adds as much variance, and its flat top looks a little wider yet.
  const double added = 1 / (2 * last) - 1 / (2 * MovingStep(200, 80, 0).sharpness());
  EXPECT_NEAR(added / (4 * 4 / 12.0), 1.15, 0.15);
  EXPECT_EQ(MovingStep(106, 100, 0).sharpness(), 0) << "too faint to tell";
}

}  // namespace
}  // namespace anneal6d
