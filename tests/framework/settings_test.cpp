// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/settings.h"

#include <gtest/gtest.h>

#include "anneal6d/framework/error.h"
#include "file_test_support.h"

namespace anneal6d {
namespace {

Settings with(const std::string& value) {
  Settings settings;
  settings.set("sigma-mm", value);
  return settings;
}

template <class Read>
void expect_refused_with(const Read& read, const std::string& words) {
  try {
    read();
    ADD_FAILURE() << "was accepted; expected: " << words;
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()), words);
  }
}

TEST(Settings, AreEmptyIfNotGiven) {
  const Settings settings;
  EXPECT_FALSE(settings.has("sigma-mm"));
  EXPECT_FALSE(settings.text("sigma-mm"));
  EXPECT_FALSE(settings.integer("sigma-mm", 0, 9));
  EXPECT_FALSE(settings.number("sigma-mm", 0, 9));
  EXPECT_FALSE(settings.flag("sigma-mm"));
}

TEST(Settings, KeepTheLastValue) {
  Settings settings = with("1");
  settings.set("sigma-mm", "2");
  EXPECT_TRUE(settings.has("sigma-mm"));
  EXPECT_EQ(settings.text("sigma-mm"), "2");
  EXPECT_EQ(std::distance(settings.begin(), settings.end()), 1);
}

TEST(Settings, ReadNumbersWithinTheirRange) {
  EXPECT_EQ(with("2.5e1").number("sigma-mm", 0, 25), 25.0);
  EXPECT_EQ(with("-3").integer("sigma-mm", -3, 3), -3);
  EXPECT_EQ(with("3").integer("sigma-mm", -3, 3), 3);
}

TEST(Settings, ReadNumbersWhateverTheLocale) {
  const test::CommaLocale comma;
  EXPECT_EQ(with("1.5").number("sigma-mm", 0, 10), 1.5);
  expect_refused_with([] { with("1,5").number("sigma-mm", 0, 10); },
                      "--sigma-mm: '1,5' is not a number from 0 to 10");
}

TEST(Settings, RefuseWhatIsOutOfRangeOrNoNumber) {
  for (const char* text : {"11", "-0.1", "nan", "inf", "1e999", "", "five", "1 2"}) {
    expect_refused_with([&] { with(text).number("sigma-mm", 0, 10); },
                        "--sigma-mm: '" + std::string(text) + "' is not a number from 0 to 10");
  }
}

TEST(Settings, RefuseWhatIsNoWholeNumber) {
  for (const char* text : {"1.5", "0x10", "99999999999999999999", "4294967297", "7"}) {
    expect_refused_with(
        [&] { with(text).integer("sigma-mm", 1, 6); },
        "--sigma-mm: '" + std::string(text) + "' is not a whole number from 1 to 6");
  }
}

TEST(Settings, ReadSeedsOfSixtyFourBits) {
  EXPECT_EQ(with("18446744073709551615").natural_number("sigma-mm"), 18446744073709551615U);
  EXPECT_FALSE(Settings().natural_number("sigma-mm"));
  for (const char* wrong : {"18446744073709551616", "-1", "1.5", "many", ""}) {
    EXPECT_THROW(with(wrong).natural_number("sigma-mm"), ConfigError) << wrong;
  }
}

TEST(Settings, WriteBoundsShortly) {
  expect_refused_with([] { with("x").number("sigma-mm", 0.25, 1000); },
                      "--sigma-mm: 'x' is not a number from 0.25 to 1000");
}

TEST(Settings, ReadFlags) {
  for (const char* text : {"on", "true", "1"}) EXPECT_EQ(with(text).flag("sigma-mm"), true);
  for (const char* text : {"off", "false", "0"}) EXPECT_EQ(with(text).flag("sigma-mm"), false);
  expect_refused_with([] { with("yes").flag("sigma-mm"); }, "--sigma-mm: 'yes' is not on or off");
}

}  // namespace
}  // namespace anneal6d
