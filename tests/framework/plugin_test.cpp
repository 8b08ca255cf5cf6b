// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/plugin.h"

#include <gtest/gtest.h>

#include "anneal6d/framework/rigid_object_tracker.h"
#include "file_test_support.h"

namespace anneal6d {
namespace {

using NumberTable = PluginTable<int, int>;

std::string available() { return {}; }

NumberTable table() {
  return {{"double", "twice the setup", available,
           [](const int& setup) { return std::make_unique<int>(2 * setup); }},
          {"gpu", "needs a card", [] { return "no card; plug one in"; },
           [](const int&) -> std::unique_ptr<int> { throw std::logic_error("was made"); }},
          {"broken", "its maker throws", available,
           [](const int&) -> std::unique_ptr<int> { throw GraphicsError("driver"); }}};
}

template <class Kind>
std::string message_of(const NumberTable& plugins, const char* name) {
  try {
    make_plugin(plugins, "scorer", name, 21);
  } catch (const Kind& error) {
    return error.what();
  }
  return "no such error";
}

TEST(PluginTable, MakesByName) { EXPECT_EQ(*make_plugin(table(), "scorer", "double", 21), 42); }

TEST(PluginTable, ListsWhatThereIsForAnUnknownName) {
  EXPECT_EQ(message_of<ConfigError>(table(), "Double"),
            "unknown scorer 'Double'; there are: double, gpu, broken");
  EXPECT_EQ(message_of<ConfigError>(table(), ""),
            "unknown scorer ''; there are: double, gpu, broken");
  EXPECT_EQ(message_of<ConfigError>({}, "double"), "unknown scorer 'double'; there are: none");
}

TEST(PluginTable, SaysWhyOneIsUnavailableInsteadOfMakingIt) {
  EXPECT_EQ(message_of<BackendUnavailable>(table(), "gpu"),
            "scorer 'gpu' is not available: no card; plug one in");
}

TEST(PluginTable, WhatNeverLacksAnythingNeedNotSaySo) {
  const NumberTable plugins = {
      {"half", "", {}, [](const int& setup) { return std::make_unique<int>(setup / 2); }}};
  EXPECT_EQ(*make_plugin(plugins, "scorer", "half", 8), 4);
}

TEST(PluginTable, PassesOnWhatTheMakerThrows) {
  EXPECT_EQ(message_of<GraphicsError>(table(), "broken"), "driver");
}

// Loading a plugin that works is tested where one is built: tests/consumer.
TEST(TrackerPlugins, NameTheFileThatIsMissing) {
  const test::TemporaryFolder folder;
  test::expect_file_error([&] { load_tracker_plugins(folder.path() / "none.so"); },
                          folder.path() / "none.so", "", "cannot be loaded");
}

TEST(TrackerPlugins, RefuseAFileThatIsNoLibrary) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("text.so", "this is no library");
  test::expect_file_error([&] { load_tracker_plugins(path); }, path, "", "cannot be loaded");
}

#ifdef __linux__
TEST(TrackerPlugins, RefuseALibraryWithoutTheEntryPoint) {
  // Any library will do that is in this process already.
  std::ifstream maps("/proc/self/maps");
  std::string line, library;
  while (library.empty() && std::getline(maps, line)) {
    if (line.find("libopencv_core") != std::string::npos) library = line.substr(line.find('/'));
  }
  if (library.empty()) GTEST_SKIP() << "OpenCV is not linked as a shared library";
  try {
    load_tracker_plugins(library);
    FAIL() << "was loaded";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("does not export anneal6d_tracker_plugins"),
              std::string::npos)
        << error.what();
  }
}
#endif

}  // namespace
}  // namespace anneal6d
