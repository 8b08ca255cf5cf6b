// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <benchmark/benchmark.h>

#include <opencv2/imgproc.hpp>

#include "anneal6d/framework/edge_detector.h"

namespace anneal6d {
namespace {

/// 640x480, grey: discs and boxes over each other, slightly blurred, with a camera's noise.
cv::Mat picture() {
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(90));
  cv::RNG random(3);
  for (int i = 0; i < 60; ++i) {
    const cv::Point at(random.uniform(0, 640), random.uniform(0, 480));
    const int size_px = random.uniform(10, 80);
    const cv::Scalar grey(random.uniform(20, 235));
    if (i % 2 == 0) {
      cv::circle(image, at, size_px, grey, cv::FILLED);
    } else {
      cv::rectangle(image, at, at + cv::Point(size_px, size_px / 2), grey, cv::FILLED);
    }
  }
  cv::GaussianBlur(image, image, {}, 0.8);
  cv::Mat noise(image.size(), CV_16SC1);
  random.fill(noise, cv::RNG::NORMAL, 0, 2);
  cv::add(image, noise, image, cv::noArray(), CV_8U);
  return image;
}

void detect_edges_vga(benchmark::State& state, EdgeOperator op, std::optional<int> threshold) {
  const cv::Mat image = picture();
  const EdgeOptions options{.op = op, .threshold = threshold, .dilation_px = 1};
  EdgeDetector detector;
  EdgeImage edges;
  for ([[maybe_unused]] auto _ : state) {
    detector.detect(image, options, edges);
    benchmark::DoNotOptimize(edges.binary.data);
  }
}

BENCHMARK_CAPTURE(detect_edges_vga, sobel, EdgeOperator::sobel, 40)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(detect_edges_vga, sobel_automatic, EdgeOperator::sobel, std::nullopt)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(detect_edges_vga, prewitt, EdgeOperator::prewitt, 40)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(detect_edges_vga, canny, EdgeOperator::canny, 100)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace anneal6d
