// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "view_store.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "anneal6d/framework/log.h"
#include "synthetic.h"

namespace anneal6d {
namespace {

namespace fs = std::filesystem;

class ViewStore : public testing::Test {
 protected:
  void SetUp() override {
    // Unlike those of other tests, which may run at the same time.
    folder_ = fs::path(testing::TempDir()) /
              (std::string("anneal6d_views_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    setup_.mesh = test::make_box(90, 60, 75);
    setup_.camera = test::small_camera();
    setup_.edges.threshold = 40;
    setup_.view_cache = folder_;
    setup_.progress = [this](double) { ++drawn_; };
    set_log_handler([this](LogLevel level, const std::string& text) {
      if (level >= LogLevel::warning) warnings_ += text + "\n";
    });
  }
  void TearDown() override {
    set_log_handler({});
    fs::remove_all(folder_);
  }

  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    if (fs::is_directory(folder_)) {
      for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path());
    }
    return found;
  }

  fs::path folder_;
  ScorerSetup setup_;
  int drawn_ = 0;  ///< views
  std::string warnings_;
};

}  // namespace
}  // namespace anneal6d
