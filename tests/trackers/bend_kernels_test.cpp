// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "bend_kernels.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "instruction_sets.h"

namespace anneal6d {
namespace {

/// Two planes that meet in a vertical ridge before the camera, each turned away from it by an
/// angle, and a strip without surface at the right.
class Roof : public testing::TestWithParam<std::int64_t> {
 protected:
  static constexpr int kColumns = 37, kRows = 23;  // no whole vectors
  static constexpr float kFocal_px = 400, kDistance_mm = 500;
  static constexpr int kRidge = 18;      // column
  static constexpr float kAngle = 0.4F;  // rad

  Roof() : on_(GetParam()) {
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        const Eigen::Vector3f normal = normal_at(x);
        // normal . p = normal . ridge
        const Eigen::Vector3f ray((x - kRidge) / kFocal_px, (y - 11) / kFocal_px, 1);
        at(depth_mm_, x, y) = x < kColumns - 5 ? kDistance_mm * normal.z() / normal.dot(ray) : 0.0F;
      }
    }
    for (auto& normal : normals_) normal.assign(depth_mm_.size(), 9);
    turns_.assign(depth_mm_.size(), 9);
    const BendJob job{.depth_mm = depth_mm_.data(),
                      .depth_stride = kColumns,
                      .columns = kColumns,
                      .rows = kRows,
                      .fx = kFocal_px,
                      .fy = kFocal_px,
                      .cx = kRidge,
                      .cy = 11,
                      .jump_mm = 50,
                      .normals = {normals_[0].data(), normals_[1].data(), normals_[2].data()},
                      .turns = turns_.data()};
    find_normals(job);
    find_turns(job);
  }

  static Eigen::Vector3f normal_at(int x) {
    const float angle = x < kRidge ? -kAngle : kAngle;
    return {std::sin(angle), 0, std::cos(angle)};
  }

  static float& at(std::vector<float>& picture, int x, int y) {
    return picture[static_cast<std::size_t>(y * kColumns + x)];
  }

  std::vector<float> depth_mm_ = std::vector<float>(kColumns * kRows);
  std::array<std::vector<float>, 3> normals_;
  std::vector<float> turns_;

 private:
  test::OnInstructionSet on_;
};

TEST_P(Roof, HasTheNormalsOfItsPlanes) {
  for (int y = 1; y < kRows - 1; ++y) {
    for (int x = 1; x < kColumns - 6; ++x) {
      if (std::abs(x - kRidge) <= 1) continue;
      const Eigen::Vector3f normal(at(normals_[0], x, y), at(normals_[1], x, y),
                                   at(normals_[2], x, y));
      EXPECT_LT((normal - normal_at(x)).norm(), 2e-3) << x << ", " << y;
    }
  }
}

TEST_P(Roof, HasNoNormalsAtTheBorderAndWhereItEnds) {
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      if (y > 0 && y < kRows - 1 && x > 0 && x < kColumns - 6) continue;
      for (auto& normal : normals_) EXPECT_EQ(at(normal, x, y), 0) << x << ", " << y;
    }
  }
}

TEST_P(Roof, TurnsAtItsRidge) {
  for (int y = 3; y < kRows - 3; ++y) {
    EXPECT_NEAR(at(turns_, kRidge, y), 2 * std::sin(kAngle), 3e-3) << "row " << y;
    for (int x = 3; x < kColumns - 8; ++x) {
      if (std::abs(x - kRidge) > 3) {
        EXPECT_EQ(at(turns_, x, y), BendJob::kFlat) << x << ", " << y;
      }
    }
    EXPECT_EQ(at(turns_, kColumns - 8, y), 0) << "beside its end, row " << y;
  }
}

INSTANTIATE_TEST_SUITE_P(OnEachInstructionSet, Roof, testing::ValuesIn(test::instruction_sets()),
                         [](const auto& set) { return std::string(hwy::TargetName(set.param)); });

}  // namespace
}  // namespace anneal6d
