// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "appearance.h"

#include <gtest/gtest.h>

#include <array>

namespace anneal6d {
namespace {

constexpr std::array<std::uint8_t, 3> kRed{20, 30, 200}, kBlue{210, 30, 20}, kGreen{0, 220, 0};

std::vector<std::uint16_t> pixels(std::uint16_t bin, std::size_t count = 200) {
  return std::vector<std::uint16_t>(count, bin);
}

std::uint16_t bin_of(const Appearance& grey_appearance, std::uint8_t level) {
  const std::array<std::uint8_t, 3> pixel{level, 0, 0};  // as part of an image
  return grey_appearance.bin(pixel.data());
}

TEST(AppearanceOfColours, TellsTheObjectsFromThoseBesideIt) {
  Appearance appearance(3);
  const auto red = appearance.bin(kRed.data()), blue = appearance.bin(kBlue.data());
  EXPECT_FALSE(appearance.learned());
  EXPECT_EQ(appearance.log_odds(red), 0);
  appearance.learn(pixels(red), pixels(blue));
  EXPECT_TRUE(appearance.learned());
  EXPECT_EQ(appearance.log_odds(red), Appearance::kLimit);
  EXPECT_EQ(appearance.log_odds(blue), -Appearance::kLimit);
  EXPECT_EQ(appearance.log_odds(appearance.bin(kGreen.data())), 0) << "unseen";
}

TEST(AppearanceOfColours, SaysNothingOfWhatIsOnBothSides) {
  Appearance appearance(3);
  const auto red = appearance.bin(kRed.data());
  appearance.learn(pixels(red), pixels(red, 400));
  EXPECT_EQ(appearance.log_odds(red), 0);
}

TEST(AppearanceOfColours, IgnoresFramesWithTooFewPixels) {
  Appearance appearance(3);
  const auto red = appearance.bin(kRed.data()), blue = appearance.bin(kBlue.data());
  appearance.learn(pixels(red, 99), pixels(blue));
  appearance.learn(pixels(red), pixels(blue, 99));
  appearance.learn({}, {});
  EXPECT_FALSE(appearance.learned());
  EXPECT_EQ(appearance.log_odds(red), 0);
}

TEST(AppearanceOfColours, ForgetsOldFramesSlowly) {
  Appearance appearance(3);
  const auto red = appearance.bin(kRed.data()), blue = appearance.bin(kBlue.data());
  appearance.learn(pixels(red), pixels(blue));
  appearance.learn(pixels(blue), pixels(red));
  EXPECT_GT(appearance.log_odds(red), 0) << "one frame does not outweigh what came before";
  for (int i = 0; i < 20; ++i) appearance.learn(pixels(blue), pixels(red));
  EXPECT_LT(appearance.log_odds(red), 0);
  EXPECT_GT(appearance.log_odds(blue), 0);
}

TEST(AppearanceOfGreyLevels, TellsTheObjectsFromThoseBesideIt) {
  Appearance appearance(1);
  const auto bin = [&](std::uint8_t level) { return bin_of(appearance, level); };
  appearance.learn(pixels(bin(255)), pixels(bin(0)));
  EXPECT_EQ(appearance.channels(), 1);
  EXPECT_EQ(appearance.log_odds(bin(255)), Appearance::kLimit);
  EXPECT_EQ(appearance.log_odds(bin(0)), -Appearance::kLimit);
  EXPECT_EQ(appearance.log_odds(bin(128)), 0);
}

TEST(AppearanceOfGreyLevels, HasABinForEveryLevel) {
  const Appearance appearance(1);
  for (int level = 0; level < 256; ++level) {
    EXPECT_EQ(bin_of(appearance, static_cast<std::uint8_t>(level)), level / 2);
  }
}

}  // namespace
}  // namespace anneal6d
