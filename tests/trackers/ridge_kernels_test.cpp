// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "ridge_kernels.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "instruction_sets.h"

namespace anneal6d {
namespace {

// Lengths of few different values, so that neighbours are often equally long; rows that no vector
// fits evenly.
TEST(Ridges, AreWhereTheGradientIsLongestAcross) {
  constexpr int kColumns = 45, kRows = 23, kStride = 48, kMargin = 2, kLeast = 30;
  std::vector<std::int16_t> along_x(kStride * kRows), along_y(along_x.size());
  std::mt19937 random(5);
  for (auto* const values : {&along_x, &along_y}) {
    for (std::int16_t& value : *values) value = static_cast<std::int16_t>(random() % 13) - 6;
  }
  const auto place = [&](int x, int y) { return static_cast<std::size_t>(y * kStride + x); };
  const auto squared_at = [&](int x, int y) {
    return along_x[place(x, y)] * along_x[place(x, y)] +
           along_y[place(x, y)] * along_y[place(x, y)];
  };
  std::vector<std::uint32_t> expected;
  for (int y = kMargin; y < kRows - kMargin; ++y) {
    for (int x = kMargin; x < kColumns - kMargin; ++x) {
      const int here = squared_at(x, y);
      const bool upright = std::abs(along_y[place(x, y)]) > std::abs(along_x[place(x, y)]);
      const int before = upright ? squared_at(x, y - 1) : squared_at(x - 1, y);
      const int after = upright ? squared_at(x, y + 1) : squared_at(x + 1, y);
      if (here < kLeast || here < before || here <= after) continue;
      expected.push_back(static_cast<std::uint32_t>(y * kColumns + x));
    }
  }
  ASSERT_GT(expected.size(), 50U);

  for (const std::int64_t target : test::instruction_sets()) {
    const test::OnInstructionSet on(target);
    SCOPED_TRACE(hwy::TargetName(target));
    std::vector<std::int32_t> squared(along_x.size(), -1);
    std::vector<std::uint32_t> places(kColumns * kRows);
    places.resize(find_ridges({.along_x = along_x.data(),
                               .along_y = along_y.data(),
                               .stride = kStride,
                               .columns = kColumns,
                               .rows = kRows,
                               .margin = kMargin,
                               .least = kLeast,
                               .squared = squared.data(),
                               .places = places.data()}));
    EXPECT_EQ(places, expected);
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) ASSERT_EQ(squared[place(x, y)], squared_at(x, y));
    }
  }
}

}  // namespace
}  // namespace anneal6d
