// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "fuzz_readers.h"

namespace anneal6d::fuzz {
namespace {

class FuzzCorpus : public testing::TestWithParam<Target> {};

// What fuzzing found once must stay harmless; the sanitizer builds run this, too.
TEST_P(FuzzCorpus, IsReadOrRefusedWithoutFault) {
  int files = 0;
  const std::filesystem::path folder =
      std::filesystem::path(ANNEAL6D_FUZZ_CORPUS) / GetParam().name;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NO_THROW(
        GetParam().run(reinterpret_cast<const std::uint8_t*>(content.data()), content.size()));
    ++files;
  }
  EXPECT_GT(files, 0) << "no files in " << folder;
}

INSTANTIATE_TEST_SUITE_P(EveryReader, FuzzCorpus, testing::ValuesIn(kTargets),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace anneal6d::fuzz
