// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// What it costs to turn a frame in the DMA ring into an image: 640x480, one core.
#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>
#include <random>
#include <vector>

#include "decoder.h"

namespace {

using anneal6d::Dc1394Options;

void decode(benchmark::State& state, dc1394color_coding_t coding, Dc1394Options::Debayer debayer) {
  constexpr int width = 640, height = 480;
  std::vector<unsigned char> bytes(width * height * 3);
  std::mt19937 random(1);
  for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random());
  anneal6d::dc1394::VideoFormat format;
  format.coding = coding;
  Dc1394Options options;
  options.debayer = debayer;
  anneal6d::dc1394::Decoder decoder(format, options);
  anneal6d::dc1394::RawPicture picture;
  picture.bytes = bytes.data();
  picture.size = {width, height};
  picture.coding = coding;
  picture.depth_bits = 12;
  cv::setNumThreads(1);
  for (auto _ : state) benchmark::DoNotOptimize(decoder.decode(picture).data);
}

constexpr auto kBilinear = Dc1394Options::Debayer::bilinear;
BENCHMARK_CAPTURE(decode, mono8, DC1394_COLOR_CODING_MONO8, kBilinear);
BENCHMARK_CAPTURE(decode, mono16, DC1394_COLOR_CODING_MONO16, kBilinear);
BENCHMARK_CAPTURE(decode, rgb8, DC1394_COLOR_CODING_RGB8, kBilinear);
BENCHMARK_CAPTURE(decode, yuv422, DC1394_COLOR_CODING_YUV422, kBilinear);
BENCHMARK_CAPTURE(decode, yuv411, DC1394_COLOR_CODING_YUV411, kBilinear);
BENCHMARK_CAPTURE(decode, raw8_bilinear, DC1394_COLOR_CODING_RAW8, kBilinear);
BENCHMARK_CAPTURE(decode, raw8_edge_aware, DC1394_COLOR_CODING_RAW8,
                  Dc1394Options::Debayer::edge_aware);
BENCHMARK_CAPTURE(decode, raw8_vng, DC1394_COLOR_CODING_RAW8, Dc1394Options::Debayer::vng);
BENCHMARK_CAPTURE(decode, raw8_grey, DC1394_COLOR_CODING_RAW8, Dc1394Options::Debayer::grey);

}  // namespace
