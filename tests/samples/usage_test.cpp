// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "tool_runner.h"

namespace anneal6d {
namespace {

class Usage : public ToolTest {};

TEST_F(Usage, HelpAndVersionOfEachCommandGoToStandardOutput) {
  for (const char* command :
       {"", "track ", "evaluate ", "simulate ", "record ", "list ", "bench "}) {
    const ProgramRun help = tool(std::string(command) + "--help");
    EXPECT_EQ(help.status, 0) << command << help.err;
    EXPECT_NE(help.out.find("--version"), std::string::npos) << command;
    const ProgramRun version = tool(std::string(command) + "--version");
    EXPECT_EQ(version.status, 0) << command << version.err;
    EXPECT_EQ(version.out.rfind("anneal6d ", 0), 0U) << version.out;
  }
}

TEST_F(Usage, HelpOfTrackAndEvaluateNamesTheOptionsTheyShare) {
  const std::string track = tool("track --help").out, evaluate = tool("evaluate --help").out;
  for (const char* option :
       {"--model ",     "--model-unit ", "--camera ",         "--init ",          "--tracker ",
        "--plugin ",    "--scorer ",     "--particles ",      "--layers ",        "--sigma-mm ",
        "--sigma-deg ", "--edges ",      "--edge-threshold ", "--canny-low ",     "--seed ",
        "--threads ",   "--start ",      "--stride ",         "--frames ",        "--poses ",
        "--overlay ",   "--mode ",       "--textured ",       "--edge-pictures ", "--config "}) {
    EXPECT_NE(track.find(option), std::string::npos) << option;
    EXPECT_NE(evaluate.find(option), std::string::npos) << option;
  }
}

TEST_F(Usage, WrongUsageIsStatusTwoWithAMessage) {
  expect_refused("", 2, {"subcommand"});
  expect_refused("fly", 2, {"fly", "track", "evaluate", "simulate", "list"});
  expect_refused("track", 2, {"INPUT"});
  expect_refused("evaluate", 2, {"SEQUENCE"});
  expect_refused("simulate out", 2, {"--model"});
  expect_refused("record camera:0", 2, {"OUT"});
  expect_refused("track " + sequence_argument_ + " --gain 300", 2, {"--gain", "dc1394:"});
  expect_refused("track " + sequence_argument_ + " --noise 3", 2, {"--noise", "simulate:"});
  expect_refused("track " + sequence_argument_ + " --particels 5", 2, {"--particels"});
  expect_refused("track " + sequence_argument_ + " --stride 0", 2, {"--stride"});
  expect_refused("track " + sequence_argument_ + " --frames many", 2, {"--frames"});
  expect_refused("evaluate " + sequence_argument_ + " --protocol hope", 2, {"--protocol", "rbot"});
  EXPECT_TRUE(only_has({}));
}

TEST_F(Usage, ValuesThatTheTrackerRefusesAreStatusTwo) {
  const auto refused = [&](const std::string& option, const std::string& word) {
    expect_refused("track " + sequence_argument_ + " --poses p.csv " + option, 2, {word});
  };
  refused("--particles 0", "--particles");
  refused("--particles -3", "--particles");
  refused("--particles many", "--particles");
  refused("--layers 0", "--layers");
  refused("--sigma-mm nan", "--sigma-mm");
  refused("--sigma-deg -1", "--sigma-deg");
  refused("--edges laplace", "laplace");
  refused("--edge-threshold 1e9", "--edge-threshold");
  refused("--textured perhaps", "--textured");
  refused("--mode fast", "--mode");
  refused("--model-unit inch", "inch");
  refused("--seed x", "--seed");
  EXPECT_TRUE(only_has({}));
}

TEST_F(Usage, UnknownNamesListThoseThatExist) {
  expect_refused("track " + sequence_argument_ + " --tracker best", 2, {"best", "universal"});
  expect_refused("track " + sequence_argument_ + " --scorer best", 2, {"best", "cpu", "reference"});
  expect_refused("track radio:1", 2, {"radio", "sequence", "camera"});
}

TEST_F(Usage, ListShowsPluginsAndCameras) {
  const ProgramRun run = tool("list");
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* word : {"trackers", "universal", "scorers", "cpu", "reference", "frame sources",
                           "cameras", "dc1394", "FireWire cameras"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << word;
  }
}

TEST_F(Usage, OptionsComeFromAConfigurationFileToo) {
  write("run.toml", "particles = 60\nlayers = 2\nframes = 3\nposes = \"from_config.csv\"\n");
  const ProgramRun run = tool("track " + sequence_argument_ + " --config run.toml --frames 2");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(lines_of(scratch_ / "from_config.csv").size(), 3U);  // header and two: --frames wins
}

TEST_F(Usage, SettingsThatOnlyTheThesisModeReadsAreAnsweredWithAWarning) {
  const std::string base = "track " + sequence_argument_ + fast_ + " --frames 1 --drift on";
  EXPECT_NE(tool(base).err.find("--drift does nothing"), std::string::npos);
  EXPECT_EQ(tool(base + " --mode thesis").err.find("--drift"), std::string::npos);
}

TEST_F(Usage, BadConfigurationFilesAreNamedWithTheirKey) {
  const auto refused = [&](const std::string& content, const std::string& word) {
    write("run.toml", content);
    expect_refused("track " + sequence_argument_ + " --config run.toml", 2, {"run.toml", word});
  };
  refused("partikles = 60\n", "partikles");
  refused("particles = 0\n", "particles");
  refused("particles = \"many\"\n", "particles");
  refused("stride = \"two\"\n", "stride");
  refused("[track]\nparticles = 60\n", "track");
  refused("init = \"1 2 3\n", "init");
  expect_refused("track " + sequence_argument_ + " --config nowhere.toml", 1, {"nowhere.toml"});
}

}  // namespace
}  // namespace anneal6d
