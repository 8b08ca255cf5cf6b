// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "frame_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

using ::testing::ElementsAre;

/// Frames 0 to count - 1, some of which are broken.
class FakeSource : public FrameSource {
 public:
  explicit FakeSource(std::int64_t count, std::set<std::int64_t> broken = {})
      : count_(count), broken_(std::move(broken)) {}

  std::optional<Frame> next() override {
    if (position_ >= count_) return std::nullopt;
    const std::int64_t index = position_++;
    if (broken_.contains(index)) throw FileError("frame", std::to_string(index), "is broken");
    Frame frame;
    frame.index = index;
    return frame;
  }
  std::int64_t skip(std::int64_t count) override {
    const std::int64_t skipped = std::min(count, count_ - position_);
    position_ += skipped;
    return skipped;
  }
  std::string description() const override { return "fake"; }

 private:
  std::int64_t count_, position_ = 0;
  std::set<std::int64_t> broken_;
};

std::vector<std::int64_t> indices_of(FrameReader& reader) {
  std::vector<std::int64_t> indices;
  while (const auto frame = reader.next()) indices.push_back(frame->index);
  return indices;
}

TEST(FrameReader, TakesEverythingByDefault) {
  FakeSource source(4);
  FrameReader reader(source, 0, 1, std::nullopt);
  EXPECT_THAT(indices_of(reader), ElementsAre(0, 1, 2, 3));
}

TEST(FrameReader, TakesEveryNthFrameFromTheStartOn) {
  FakeSource source(10);
  FrameReader reader(source, 2, 3, std::nullopt);
  EXPECT_THAT(indices_of(reader), ElementsAre(2, 5, 8));
}

TEST(FrameReader, StopsAfterTheNumberOfFramesWanted) {
  FakeSource source(10);
  FrameReader reader(source, 1, 2, 3);
  EXPECT_THAT(indices_of(reader), ElementsAre(1, 3, 5));
}

TEST(FrameReader, FindsNothingBehindTheEnd) {
  FakeSource source(3);
  FrameReader reader(source, 3, 1, std::nullopt);
  EXPECT_TRUE(indices_of(reader).empty());
}

TEST(FrameReader, GoesOnPastABrokenFrameAndKeepsTheStride) {
  FakeSource source(9, {4});
  FrameReader reader(source, 0, 2, std::nullopt);
  EXPECT_THAT(indices_of(reader), ElementsAre(0, 2, 6, 8));
  EXPECT_EQ(reader.broken(), 1);
}

TEST(FrameReader, DoesNotLookAtBrokenFramesBetweenThoseWanted) {
  FakeSource source(5, {1, 3});
  FrameReader reader(source, 0, 2, std::nullopt);
  EXPECT_THAT(indices_of(reader), ElementsAre(0, 2, 4));
  EXPECT_EQ(reader.broken(), 0);
}

TEST(FrameReader, ThrowsIfTheFirstFrameIsBroken) {
  FakeSource source(3, {0});
  FrameReader reader(source, 0, 1, std::nullopt);
  EXPECT_THROW(reader.next(), FileError);
}

}  // namespace
}  // namespace anneal6d
