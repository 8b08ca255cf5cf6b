// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "dc1394_test.h"

namespace anneal6d {
namespace {

class Dc1394Group : public test::Dc1394Test {
 protected:
  Dc1394Group() {
    bus_.add_camera("DR2-BW", 0xA);
    second_ = &bus_.add_camera("DR2-BW", 0xB);
    second_->skew_us = 100;
  }

  static std::unique_ptr<FrameSetSource> group(Given given = {}) {
    Settings all = settings(given);
    all.set("fps", "30");  // two cameras at 60 fps would be too much for the bus
    return open_dc1394_group({"a", "b"}, Dc1394Options::from(all));
  }

  test::EmulatedCamera* second_ = nullptr;
};

TEST_F(Dc1394Group, GivesFramesOfTheSameExposure) {
  const auto source = group();
  EXPECT_EQ(source->size(), 2U);
  for (int i = 0; i < 50; ++i) {
    const auto set = source->next();
    ASSERT_EQ(set->frames.size(), 2U);
    EXPECT_LE(set->spread_s, 0.0005);
    EXPECT_EQ(set->lost_before, 0);
  }
}

TEST_F(Dc1394Group, AFrameThatOneCameraLostCostsTheSet) {
  second_->add_fault({test::Fault::Kind::drop, 25});
  const auto source = group();
  std::int64_t lost = 0;
  for (int i = 0; i < 50; ++i) {
    const auto set = source->next();
    EXPECT_LE(set->spread_s, 0.0005);
    lost += set->lost_before;
  }
  EXPECT_EQ(lost, 1);
}

TEST_F(Dc1394Group, GivesTheNewestFramesThatBelongTogether) {
  const auto source = group({{"capture", "newest"}});
  for (int i = 0; i < 20; ++i) EXPECT_LE(source->next()->spread_s, 0.0005);
}

TEST_F(Dc1394Group, WhatIsPassedOverIsNotLost) {
  const auto source = group({{"capture", "newest"}, {"buffers", "4"}, {"frame-info", "on"}});
  std::int64_t last = 0;
  for (int i = 0; i < 10; ++i) {
    const auto set = source->next();
    EXPECT_EQ(set->lost_before, 0);
    last = set->frames[0].index;
  }
  EXPECT_GT(last, 20) << "frames that waited were not passed over";
}

TEST_F(Dc1394Group, RefusesASoftwareTrigger) {
  EXPECT_TRUE(has(message_of<ConfigError>([] {
                    group({{"trigger", "0"}, {"trigger-source", "software"}});
                  }),
                  {"--trigger-source", "pin"}));
}

TEST_F(Dc1394Group, SaysThatCamerasDoNotRunInStep) {
  second_->skew_us = 8000;
  const auto source = group();
  EXPECT_TRUE(has(message_of<CaptureError>([&] { source->next(); }), {"together", "same bus"}));
}

TEST_F(Dc1394Group, NeedsTwoDifferentCameras) {
  const auto open_with = [](const std::vector<std::string>& guids) {
    return [guids] { open_dc1394_group(guids, Dc1394Options()); };
  };
  EXPECT_TRUE(has(message_of<ConfigError>(open_with({"a"})), {"two or more"}));
  EXPECT_TRUE(has(message_of<ConfigError>(open_with({"a", "A"})), {"twice"}));
}

TEST_F(Dc1394Group, SharesTheBandwidthOfTheBus) {
  bus_.set_bandwidth(bandwidth_ = 1500);
  const std::string message = message_of<BackendUnavailable>([&] { group(); });
  EXPECT_TRUE(has(message, {"bandwidth"}));
}

}  // namespace
}  // namespace anneal6d
