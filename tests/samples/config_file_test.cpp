// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "config_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ConfigFile : public ::testing::Test {
 protected:
  ConfigFile() {
    app_.add_option("--particles", particles_);
    app_.add_option("--poses", poses_);
    app_.add_option("--config", config_)->configurable(false);
    app_.add_flag("--force", force_);
  }
  ~ConfigFile() override { std::filesystem::remove(path_); }

  std::set<std::string> apply(const std::string& content, const std::string& command_line = {}) {
    std::ofstream(path_, std::ios::binary) << content;
    app_.parse(command_line);
    return apply_config_file(app_, path_);
  }

  std::string refusal_of(const std::string& content) {
    try {
      apply(content);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".toml");
  CLI::App app_{"", "track"};
  int particles_ = 100;
  std::string poses_, config_;
  bool force_ = false;
};

TEST_F(ConfigFile, GivesTheOptionsItNames) {
  EXPECT_THAT(apply("# a comment\nparticles = 600  # many\nposes = \"a b.csv\"\nforce = true\n"),
              ElementsAre("force", "particles", "poses"));
  EXPECT_EQ(particles_, 600);
  EXPECT_EQ(poses_, "a b.csv");
  EXPECT_TRUE(force_);
}

TEST_F(ConfigFile, YieldsToTheCommandLine) {
  EXPECT_TRUE(apply("particles = 600\n", "--particles 5").empty());
  EXPECT_EQ(particles_, 5);
}

TEST_F(ConfigFile, MayBeEmpty) {
  EXPECT_TRUE(apply("").empty());
  EXPECT_EQ(particles_, 100);
}

TEST_F(ConfigFile, RefusesAnUnknownKeyAndNamesThoseThatExist) {
  EXPECT_THAT(refusal_of("partikles = 600\n"),
              AllOf(HasSubstr(path_.string()), HasSubstr("'partikles'"), HasSubstr("particles")));
}

TEST_F(ConfigFile, RefusesSectionsAndOptionsThatAreNoneOfItsBusiness) {
  EXPECT_THAT(refusal_of("[track]\nparticles = 600\n"), HasSubstr("track"));
  EXPECT_THAT(refusal_of("config = \"other.toml\"\n"), HasSubstr("'config'"));
  EXPECT_THAT(refusal_of("help = true\n"), HasSubstr("'help'"));
}

TEST_F(ConfigFile, RefusesAValueOfTheWrongType) {
  EXPECT_THAT(refusal_of("particles = many\n"),
              AllOf(HasSubstr(path_.string()), HasSubstr("'particles'"), HasSubstr("many")));
  EXPECT_THAT(refusal_of("particles = true\n"), HasSubstr("'particles'"));
}

TEST_F(ConfigFile, RefusesAList) {
  EXPECT_THAT(refusal_of("particles = [1, 2]\n"), HasSubstr("one value, not 2"));
}

TEST_F(ConfigFile, RefusesAKeyGivenTwice) {
  EXPECT_THAT(refusal_of("particles = 1\nforce = true\nparticles = 2\n"), HasSubstr("twice"));
}

TEST_F(ConfigFile, RefusesAnUnfinishedString) {
  EXPECT_THAT(refusal_of("poses = \"a.csv\n"), HasSubstr("quote"));
}

TEST_F(ConfigFile, RefusesWhatIsNoTextWithoutRepeatingIt) {
  EXPECT_THAT(refusal_of(std::string("\x7F"
                                     "ELF\x02\x01\x01\0\0\x1b[2J",
                                     13)),
              AllOf(HasSubstr("is not an option"), ::testing::Not(HasSubstr("\x1b"))));
}

TEST_F(ConfigFile, ThatIsMissingIsAFileError) {
  app_.parse("");
  EXPECT_THROW(apply_config_file(app_, path_ / "nowhere.toml"), FileError);
}

}  // namespace
}  // namespace anneal6d
