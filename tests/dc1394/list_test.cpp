// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <cerrno>

#include "dc1394_test.h"

namespace anneal6d {
namespace {

class Dc1394List : public test::Dc1394Test {
 protected:
  static std::string feature(const Dc1394CameraReport& report, const std::string& name) {
    for (const auto& row : report.features) {
      if (row.name == name) return row.allowed + " | " + row.current;
    }
    return {};
  }

  static std::string modes(const Dc1394CameraReport& report) {
    std::string text;
    for (const std::string& mode : report.modes) text += mode + "\n";
    return text;
  }
};

TEST_F(Dc1394List, ShowsWhatACameraCanDo) {
  bus_.add_camera("DR2-COL", test::kGuid);
  const auto reports = list_dc1394_cameras();
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_EQ(reports[0].guid, test::kGuidText);
  EXPECT_EQ(reports[0].vendor, "Point Grey Research");
  EXPECT_EQ(reports[0].model, "Dragonfly2 DR2-COL");
  EXPECT_EQ(reports[0].why_unusable, "");
  EXPECT_TRUE(
      has(modes(reports[0]), {"640x480-mono8 at 1.875, 3.75, 7.5, 15, 30, 60 fps", "640x480-yuv411",
                              "format7-0 up to 648x488 in steps of 8x2", "raw8"}));
  EXPECT_EQ(feature(reports[0], "gain"), "auto, one-push, 192..820, abs:0..24 dB | auto 256, 6 dB");
  EXPECT_EQ(feature(reports[0], "white-balance"), "off, auto, one-push, 0..1023,0..1023 | 512,700");
}

TEST_F(Dc1394List, ShowsEveryCameraOfTheBus) {
  bus_.add_camera("DR2-BW", 1);
  bus_.add_camera("DR2-13S2C", 2);
  EXPECT_EQ(list_dc1394_cameras().size(), 2U);
}

TEST_F(Dc1394List, SaysThatACameraIsInUse) {
  bus_.give_to_another_program(bus_.add_camera("DR2-BW", test::kGuid));
  reserved_channels_ = bus_.channels_in_use();
  EXPECT_TRUE(has(list_dc1394_cameras().at(0).why_unusable, {"another program"}));
}

TEST_F(Dc1394List, SaysThatTheBusIsTooBusy) {
  bus_.add_camera("DR2-BW", test::kGuid);
  bus_.set_bandwidth(bandwidth_ = 100);
  EXPECT_TRUE(has(list_dc1394_cameras().at(0).why_unusable, {"bandwidth", "of 4915"}));
}

TEST_F(Dc1394List, SaysThatThisUserMayNotOpenThem) {
  bus_.add_camera("DR2-BW", test::kGuid);
  bus_.set_open_error(EACCES);
  EXPECT_TRUE(has(list_dc1394_cameras().at(0).why_unusable, {"udev"}));
}

TEST_F(Dc1394List, IsEmptyWithoutABus) { EXPECT_TRUE(list_dc1394_cameras().empty()); }

}  // namespace
}  // namespace anneal6d
