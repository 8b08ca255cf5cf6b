// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "view_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic.h"

namespace anneal6d {
namespace {

constexpr ViewKey kKey = 0x0123456789ABCDEFULL;

class ViewFile : public testing::Test {
 protected:
  static const test::SharedMesh& mesh() {
    static const auto box = test::make_box(90, 60, 75);
    return box;
  }
  static Eigen::Vector3d center_mm() { return mesh()->center_mm().cast<double>(); }
  static double radius_mm() { return mesh()->radius_mm(); }
  static const std::vector<ModelView>& views() {
    static const RasterModel model(mesh(), false);
    static const ViewModel made(model, {.threshold = 40}, Shading{}, 0, {});
    return made.views();
  }
  static const std::string& packed() {
    static const std::string bytes = pack_views(views(), kKey, center_mm(), radius_mm());
    return bytes;
  }
  static std::optional<std::vector<ModelView>> unpack(std::string_view bytes, ViewKey key = kKey) {
    return unpack_views(bytes, key, center_mm(), radius_mm());
  }
};

TEST_F(ViewFile, KeepsTheViewsButForRounding) {
  const auto read = unpack(packed());
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), views().size());
  const double place_mm = 1.25 * radius_mm() / 32767;  // half a step, with room
  const double length_mm = 0.5 * radius_mm() / 255;
  for (std::size_t i = 0; i < views().size(); ++i) {
    const ModelView& before = views()[i];
    const ModelView& after = (*read)[i];
    ASSERT_EQ(before.contour.size(), after.contour.size());
    ASSERT_EQ(before.edges, after.edges);
    EXPECT_EQ(before.edge_px, after.edge_px);
    for (std::size_t k = 0; k < before.contour.size(); ++k) {
      const ContourSample &a = before.contour[k], &b = after.contour[k];
      EXPECT_LT((a.object_mm - b.object_mm).norm(), 1.8 * place_mm);
      EXPECT_LT((a.normal - b.normal).norm(), 1e-4);
      EXPECT_NEAR(a.curve_mm, b.curve_mm, place_mm);
      if (a.silhouette) {
        EXPECT_NEAR(std::min<double>(a.inside_mm, 0.5 * radius_mm()), b.inside_mm, length_mm);
        EXPECT_NEAR(std::min<double>(a.outside_mm, 0.5 * radius_mm()), b.outside_mm, length_mm);
      }
      EXPECT_NEAR(a.shift_px, b.shift_px, 2e-4);
      EXPECT_NEAR(a.trust, b.trust, 0.003);
      EXPECT_EQ(a.silhouette, b.silhouette);
      EXPECT_EQ(a.polarity, b.polarity);
    }
    ASSERT_EQ(after.edge_x.size() % ModelView::kPadding, 0U);
    ASSERT_GE(after.edge_x.size(), static_cast<std::size_t>(after.edges));
    for (std::size_t k = 0; k < after.edge_x.size(); ++k) {
      if (k < static_cast<std::size_t>(after.edges)) {
        EXPECT_NEAR(before.edge_x[k], after.edge_x[k], place_mm);
        EXPECT_NEAR(before.edge_y[k], after.edge_y[k], place_mm);
        EXPECT_NEAR(before.edge_z[k], after.edge_z[k], place_mm);
      } else {
        EXPECT_TRUE(std::isnan(after.edge_x[k]) && std::isnan(after.edge_y[k]) &&
                    std::isnan(after.edge_z[k]));
      }
    }
  }
}

TEST_F(ViewFile, KeepsEveryPolarity) {
  std::vector<ModelView> some(ViewModel::kViews);
  for (const int polarity : {-1, 0, 1}) {
    ContourSample sample;
    sample.object_mm.setZero();
    sample.normal = Eigen::Vector3f::UnitX();
    sample.polarity = polarity;
    sample.silhouette = polarity == 0;
    some[7].contour.push_back(sample);
  }
  const auto read = unpack(pack_views(some, kKey, center_mm(), radius_mm()));
  ASSERT_TRUE(read);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ((*read)[7].contour[static_cast<std::size_t>(i)].polarity, i - 1);
    EXPECT_EQ((*read)[7].contour[static_cast<std::size_t>(i)].silhouette, i == 1);
  }
}

TEST_F(ViewFile, IsNotReadIfItIsTruncated) {
  const std::string_view whole = packed();
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{4}, std::size_t{11},
        std::size_t{15}, std::size_t{16}, std::size_t{17}, std::size_t{23}, std::size_t{24},
        std::size_t{30}, whole.size() / 3, whole.size() / 2 + 1, whole.size() - 1}) {
    EXPECT_FALSE(unpack(whole.substr(0, length))) << length << " bytes";
  }
}

TEST_F(ViewFile, IsNotReadIfItGoesOn) { EXPECT_FALSE(unpack(packed() + '\0')); }

TEST_F(ViewFile, IsNotReadForAnotherModel) { EXPECT_FALSE(unpack(packed(), kKey + 1)); }

TEST_F(ViewFile, IsNotReadInAnotherVersion) {
  for (std::size_t place = 0; place < 4; ++place) {
    std::string other = packed();
    other[place] = static_cast<char>(other[place] ^ 0x55);
    EXPECT_FALSE(unpack(other)) << "byte " << place;
  }
}

TEST_F(ViewFile, IsNotReadIfABitIsWrong) {
  for (std::uint32_t i = 0; i < 40; ++i) {
    const RandomKey key{.seed = 8, .particle = i};
    std::string damaged = packed();
    const auto place = static_cast<std::size_t>(
        test::random_between(key, 0, 0, static_cast<double>(damaged.size() - 1)));
    damaged[place] = static_cast<char>(damaged[place] ^ 1 << i % 8);
    EXPECT_FALSE(unpack(damaged)) << "bit " << i % 8 << " of byte " << place;
  }
}

}  // namespace
}  // namespace anneal6d
