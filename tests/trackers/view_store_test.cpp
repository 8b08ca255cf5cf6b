// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "view_store.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "anneal6d/framework/error.h"
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
    setup_.mesh = test::make_box(91, 61, 76);  // of which other tests keep no views
    setup_.camera = test::small_camera();
    setup_.edges.threshold = 40;
    setup_.view_cache = folder_;
    setup_.progress = [this](double share) { drawn_ += share == 1 ? 1 : 0; };
    set_log_sink([this](LogLevel level, std::string_view message) {
      if (level >= LogLevel::warning) warnings_ += std::string(message) + "\n";
    });
  }
  void TearDown() override {
    set_log_sink({});
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
  int drawn_ = 0;  ///< times that views were made
  std::string warnings_;
};

bool same(const ContourSample& a, const ContourSample& b) {
  return a.object_mm == b.object_mm && a.normal == b.normal && a.curve_mm == b.curve_mm &&
         a.inside_mm == b.inside_mm && a.outside_mm == b.outside_mm && a.shift_px == b.shift_px &&
         a.trust == b.trust && a.silhouette == b.silhouette && a.polarity == b.polarity;
}

bool same(const ViewModel& a, const ViewModel& b) {
  for (std::size_t i = 0; i < a.views().size(); ++i) {
    const ModelView &one = a.views()[i], &other = b.views()[i];
    if (one.contour.size() != other.contour.size() || one.edges != other.edges) return false;
    if (one.edge_px != other.edge_px) return false;
    for (std::size_t k = 0; k < one.contour.size(); ++k) {
      if (!same(one.contour[k], other.contour[k])) return false;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(one.edges); ++k) {
      if (one.edge_x[k] != other.edge_x[k] || one.edge_y[k] != other.edge_y[k] ||
          one.edge_z[k] != other.edge_z[k]) {
        return false;
      }
    }
  }
  return true;
}

TEST_F(ViewStore, SharesWhatIsInUse) {
  const auto first = view_model_of(setup_);
  EXPECT_EQ(drawn_, 1);
  EXPECT_EQ(view_model_of(setup_), first);
  setup_.view_cache.clear();
  setup_.mesh = test::make_box(91, 61, 76);
  setup_.camera.fx_px *= 2;
  setup_.threads = 1;
  EXPECT_EQ(view_model_of(setup_), first) << "neither cache, camera nor threads change the views";
  EXPECT_EQ(drawn_, 1);
}

TEST_F(ViewStore, ReadsWhatAnEarlierRunWroteAndGivesTheSame) {
  auto first = view_model_of(setup_);
  const ViewModel made = *first;
  first.reset();  // as if the program had ended
  ASSERT_EQ(files().size(), 1U);
  EXPECT_LT(fs::file_size(files()[0]), 15e6);
  const auto second = view_model_of(setup_);
  EXPECT_EQ(drawn_, 1) << "drawn once";
  EXPECT_TRUE(same(made, *second));
  EXPECT_EQ(warnings_, "");
}

TEST_F(ViewStore, MakesOthersForAnotherModelOrDrawing) {
  const auto first = view_model_of(setup_);
  setup_.shading.ambient *= 0.5F;
  const auto second = view_model_of(setup_);
  EXPECT_NE(second, first);
  setup_.mesh = test::make_box(91, 61, 77);
  EXPECT_NE(view_model_of(setup_), second);
  EXPECT_EQ(drawn_, 3);
  EXPECT_EQ(files().size(), 3U);
}

TEST_F(ViewStore, MakesADamagedFileAnew) {
  const ViewModel made = *view_model_of(setup_);
  const fs::path file = files().at(0);
  const auto whole = fs::file_size(file);
  fs::resize_file(file, whole / 2);
  const auto again = view_model_of(setup_);
  EXPECT_EQ(drawn_, 2);
  EXPECT_TRUE(same(made, *again));
  EXPECT_EQ(fs::file_size(file), whole);
  EXPECT_NE(warnings_.find("damaged"), std::string::npos) << warnings_;
}

TEST_F(ViewStore, DoesWithoutAFolderThatCannotBeWritten) {
  std::ofstream(folder_) << "a file";  // no folder can be below it, not even root's
  setup_.view_cache = folder_ / "below";
  EXPECT_EQ(view_model_of(setup_)->views().size(), std::size_t{ViewModel::kViews});
  EXPECT_NE(warnings_.find("the next run will prepare the model again"), std::string::npos)
      << warnings_;
}

TEST_F(ViewStore, AsksForTheUnitOfATinyModel) {
  setup_.mesh = test::make_box(0.9F, 0.6F, 0.7F);
  try {
    view_model_of(setup_);
    ADD_FAILURE() << "a model in metres was taken";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("unit"), std::string::npos) << error.what();
  }
  EXPECT_EQ(drawn_, 0);
  setup_.mesh = test::make_box(4, 3, 3);
  const auto views = view_model_of(setup_);
  for (const ModelView& view : views->views()) EXPECT_GT(view.contour.size(), 20U);
}

TEST_F(ViewStore, KeepsNothingWithoutAFolder) {
  setup_.view_cache.clear();
  EXPECT_NE(view_model_of(setup_), nullptr);
  EXPECT_TRUE(files().empty());
  EXPECT_EQ(warnings_, "");
}

}  // namespace
}  // namespace anneal6d
