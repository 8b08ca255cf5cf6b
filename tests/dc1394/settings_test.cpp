// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <bit>
#include <fstream>

#include "dc1394_test.h"

namespace anneal6d {
namespace {

class Dc1394Settings : public test::Dc1394Test {
 protected:
  // The message of a setting that DR2-COL refuses, which must also leave the camera silent.
  void expect_refused(const std::string& model, Given given,
                      const std::vector<std::string>& words) {
    bus_.clear();
    test::EmulatedCamera& camera = bus_.add_camera(model, test::kGuid);
    const std::string message = refusal<ConfigError>(given);
    EXPECT_TRUE(has(message, words));
    EXPECT_EQ(reg(camera, 0x614), 0U) << "it streamed before the error: " << message;
    EXPECT_EQ(camera.frame(), 0);
  }

  void expect_malformed(const std::string& name, const std::string& value) {
    Settings settings;
    settings.set(name, value);
    const std::string message = message_of<ConfigError>([&] { Dc1394Options::from(settings); });
    EXPECT_TRUE(has(message, {"--" + name, value}));
  }

  static float as_float(std::uint32_t bits) { return std::bit_cast<float>(bits); }
};

TEST_F(Dc1394Settings, MalformedValuesAreRefusedWithoutACamera) {
  for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
           {"roi", "1,2,3"},          {"roi", "0,0,320,240,"},   {"roi", "a,b,c,d"},
           {"fps", "fast"},           {"iso-speed", "500"},      {"buffers", "1"},
           {"buffers", "65"},         {"capture", "some"},       {"stall-timeout", "0"},
           {"debayer", "magic"},      {"bayer-pattern", "rgbg"}, {"gain", "loud"},
           {"gain", "abs:x"},         {"gain", "1,2"},           {"white-balance", "5"},
           {"trigger", "x"},          {"trigger-source", "9"},   {"trigger-polarity", "up"},
           {"strobe", "1:high"},      {"strobe", "1:up:0:0"},    {"gpio-direction", "left"},
           {"gpio-output", "256"},    {"memory-load", "-1"},     {"power-down", "maybe"},
           {"frame-info", "perhaps"}, {"packet-size", "0"},      {"settle-frames", "-1"}}) {
    expect_malformed(name, value);
  }
}

TEST_F(Dc1394Settings, AnUnknownModeIsRefusedWithThoseThatThereAre) {
  expect_refused("DR2-BW", {{"video-mode", "640x480-rgb8"}},
                 {"--video-mode", "640x480-rgb8", test::kGuidText, "640x480-mono8", "format7-2"});
  expect_refused("DR2-BW", {{"video-mode", "format7-5"}}, {"format7-5", "format7-0"});
}

TEST_F(Dc1394Settings, ARateThatTheModeHasNotIsRefused) {
  expect_refused("DR2-BW", {{"fps", "25"}}, {"--fps", "25", "7.5", "30", "60"});
  expect_refused("DR2-BW", {{"fps", "120"}, {"video-mode", "format7-0"}}, {"--fps", "120"});
}

TEST_F(Dc1394Settings, ARegionThatDoesNotFitIsRefusedWithLimitsAndSteps) {
  for (const char* roi : {"0,0,656,488", "4,0,648,488", "0,2,648,488", "2,0,320,240", "0,1,320,240",
                          "0,0,324,240", "0,0,320,241", "-4,0,320,240", "0,0,0,0"}) {
    expect_refused("DR2-BW", {{"roi", roi}}, {"--roi", roi, "648x488", "8x2", "4 and 2"});
  }
}

TEST_F(Dc1394Settings, APacketSizeThatTheCameraHasNotIsRefused) {
  expect_refused("DR2-BW", {{"packet-size", "1001"}}, {"--packet-size", "1001", "4 to 4096"});
  expect_refused("DR2-BW", {{"packet-size", "5000"}}, {"--packet-size", "5000"});
  expect_refused("DR2-BW", {{"packet-size", "4096"}, {"iso-speed", "200"}},
                 {"--packet-size", "4 to 2048"});
}

TEST_F(Dc1394Settings, ACodingThatTheCameraHasNotIsRefused) {
  expect_refused("DR2-BW", {{"coding", "rgb8"}}, {"--coding", "rgb8", "mono8, mono16"});
  expect_refused("DR2-COL", {{"coding", "blue"}}, {"--coding", "blue", "raw8"});
}

TEST_F(Dc1394Settings, Format7SettingsAreRefusedForAFixedMode) {
  expect_refused("DR2-BW", {{"video-mode", "640x480-mono8"}, {"roi", "0,0,320,240"}},
                 {"--roi", "Format_7", "640x480-mono8"});
}

TEST_F(Dc1394Settings, APictureTooFastForTheBusIsRefusedWithTheFastestRate) {
  expect_refused("DR2-13S2C", {{"coding", "rgb8"}, {"fps", "20"}}, {"--fps", "20", "8.7", "--roi"});
}

TEST_F(Dc1394Settings, BModeIsRefusedWhereThereIsNone) {
  expect_refused("DR2-BW", {{"iso-speed", "800"}}, {"--iso-speed", "800", "100, 200 and 400"});
}

TEST_F(Dc1394Settings, BModeIsUsedWhereThereIsOne) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  camera.registers().add_b_mode();
  const auto source = open({{"iso-speed", "800"}});
  EXPECT_TRUE(source->next());
  EXPECT_EQ(reg(camera, 0x60C) & 0x8007U, 0x8003U);
}

TEST_F(Dc1394Settings, AbsentFeaturesAndValuesOutOfRangeAreRefused) {
  expect_refused("DR2-BW", {{"white-balance", "auto"}}, {"--white-balance", "no such feature"});
  expect_refused("DR2-BW", {{"gain", "5000"}}, {"--gain", "5000", "192..820", "abs:0..24 dB"});
  expect_refused("DR2-BW", {{"gain", "abs:25"}}, {"--gain", "abs:25", "24 dB"});
  expect_refused("DR2-BW", {{"gain", "off"}}, {"--gain", "off", "auto, one-push"});
  expect_refused("DR2-BW", {{"gamma", "auto"}}, {"--gamma", "auto", "abs:0.5..4"});
  expect_refused("DR2-BW", {{"sharpness", "abs:3"}}, {"--sharpness", "0..4095"});
}

TEST_F(Dc1394Settings, TriggersThatTheCameraHasNotAreRefused) {
  expect_refused("DR2-13S2M", {{"trigger", "4"}}, {"--trigger", "4", "off, 0, 1, 3, 14"});
  expect_refused("DR2-BW", {{"trigger", "2"}}, {"--trigger", "off, 0, 1, 3, 4, 5, 14"});
}

TEST_F(Dc1394Settings, MemoryChannelsPinsAndTablesThatTheCameraHasNotAreRefused) {
  expect_refused("DR2-BW", {{"memory-load", "3"}}, {"--memory-load", "3", "1 to 2"});
  expect_refused("DR2-BW", {{"strobe", "9:high:0:0"}}, {"--strobe", "9"});
  const std::string path = ::testing::TempDir() + "dc1394_short_table.txt";
  std::ofstream(path) << "1 2 3\n";
  expect_refused("DR2-BW", {{"lut", path}}, {"--lut", "3 entries", "512 entries from 0 to 511"});
}

TEST_F(Dc1394Settings, ACalibrationOfAnotherSizeIsRefused) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const CameraModel calibration{1280, 960, 900, 900, 640, 480, {}};
  EXPECT_TRUE(has(message_of<ConfigError>([&] {
                    open_dc1394_camera("", Dc1394Options::from(settings()), calibration);
                  }),
                  {"1280x960", "640x480-mono8"}));
  EXPECT_TRUE(has(message_of<ConfigError>([&] {
                    open_dc1394_camera(
                        "", Dc1394Options::from(settings({{"video-mode", "640x480-mono8"}})),
                        calibration);
                  }),
                  {"1280x960", "640x480"}));
}

TEST_F(Dc1394Settings, FeaturesReachTheRegisters) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-COL", test::kGuid);
  open({{"gain", "300"},
        {"shutter", "abs:20"},
        {"auto-exposure", "off"},
        {"iris", "auto"},
        {"white-balance", "400,600"},
        {"gamma", "abs:2"},
        {"brightness", "17"}});
  EXPECT_EQ(reg(camera, 0x820), 0x82000000U | 300);
  EXPECT_NEAR(as_float(reg(camera, 0x978)), 0.020F, 1e-6);
  EXPECT_EQ(reg(camera, 0x81C) & 0x41000000U, 0x40000000U) << "absolute and manual";
  EXPECT_EQ(reg(camera, 0x804) & 0x02000000U, 0U);
  EXPECT_EQ(reg(camera, 0x824) & 0x03000000U, 0x03000000U);
  EXPECT_EQ(reg(camera, 0x80C) & 0x00FFFFFFU, 400U << 12 | 600U);
  EXPECT_EQ(as_float(reg(camera, 0x968)), 2);
  EXPECT_EQ(reg(camera, 0x800) & 0xFFFU, 17U);
}

TEST_F(Dc1394Settings, ExposuresMayBeLongerThanAFrameWithoutRateControl) {
  expect_refused("DR2-BW", {{"shutter", "abs:2000"}}, {"--shutter", "abs:2000", "66.6 ms"});
  bus_.clear();
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  open({{"shutter", "abs:2000"}, {"frame-rate", "off"}, {"stall-timeout", "5"}});
  EXPECT_NEAR(as_float(reg(camera, 0x978)), 2, 1e-6);
}

TEST_F(Dc1394Settings, AStallTimeoutTooShortForTheExposureIsRefused) {
  expect_refused("DR2-BW", {{"shutter", "abs:2000"}, {"frame-rate", "off"}},
                 {"--stall-timeout", "'3'", "at least 4"});
  expect_refused("DR2-BW", {{"fps", "1.875"}, {"stall-timeout", "1"}},
                 {"--stall-timeout", "'1'", "at least 1.067"});
}

TEST_F(Dc1394Settings, TriggerStrobeAndPinsReachTheRegisters) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  open({{"trigger", "5"},
        {"trigger-source", "2"},
        {"trigger-polarity", "high"},
        {"trigger-parameter", "7"},
        {"strobe", "1:high:16:32"},
        {"gpio-direction", "in,out"},
        {"gpio-output", "3"}});
  EXPECT_EQ(reg(camera, 0x830), 0x80000000U | 0x02000000U | 0x01000000U | 2U << 21 | 5U << 16 | 7U);
  EXPECT_EQ(reg(camera, 0x1504), 0x83000000U | 16U << 12 | 32U);
  EXPECT_EQ(reg(camera, 0x11F8), 0x40000000U);
  EXPECT_EQ(reg(camera, 0x1604), 3U);
}

TEST_F(Dc1394Settings, MemoryChannelsKeepSettings) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  open({{"gain", "333"}, {"memory-save", "1"}});
  open({{"gain", "444"}});
  EXPECT_EQ(reg(camera, 0x820) & 0xFFFU, 444U);
  open({{"memory-load", "1"}});
  EXPECT_EQ(reg(camera, 0x820) & 0xFFFU, 333U);
}

TEST_F(Dc1394Settings, ALookupTableIsWrittenAndSwitchedOn) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  const std::string path = ::testing::TempDir() + "dc1394_table.txt";
  {
    std::ofstream file(path);
    for (int i = 0; i < 512; ++i) file << 511 - i << "\n";
  }
  open({{"lut", path}});
  EXPECT_EQ(reg(camera, 0x82000), 511U);
  EXPECT_EQ(reg(camera, 0x82000 + 4 * 511), 0U);
  EXPECT_EQ(reg(camera, 0x8000C) & 0x04000000U, 0x04000000U);
}

TEST_F(Dc1394Settings, TheCameraIsSwitchedOffWhenDoneIfThatIsWanted) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  open();
  EXPECT_EQ(reg(camera, 0x610), 0x80000000U);
  open({{"power-down", "on"}});
  EXPECT_EQ(reg(camera, 0x610), 0U);
  EXPECT_TRUE(open()->next()) << "it is switched on again";
}

TEST_F(Dc1394Settings, PacketsAreAsSmallAsTheWantedRateAllows) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open({{"video-mode", "format7-0"}, {"fps", "15"}});
  EXPECT_EQ(reg(camera, 0x8044) >> 16, 596U);  // 648 * 488 * 15 / 8000 = 592.9, steps of 4
  EXPECT_NEAR(source->next()->timestamp_s, 0, 1e-9);
  EXPECT_NEAR(source->next()->timestamp_s, 1.0 / 15, 0.0003);
}

}  // namespace
}  // namespace anneal6d
