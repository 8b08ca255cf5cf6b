// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <bit>
#include <cerrno>
#include <chrono>
#include <thread>

#include "dc1394_test.h"

namespace anneal6d {
namespace {

using test::Fault;

class Dc1394Faults : public test::Dc1394Test {
 protected:
  test::EmulatedCamera& camera_with(Fault::Kind kind, std::int64_t at_frame = 3) {
    test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
    camera.add_fault({kind, at_frame});
    return camera;
  }

  // Frames before the fault at frame 3.
  static void take_three(FrameSource& source) {
    for (int i = 0; i < 3; ++i) ASSERT_EQ(source.next()->index, i);
  }
};

TEST_F(Dc1394Faults, ADroppedFrameIsCounted) {
  for (const char* frame_info : {"on", "off"}) {  // by the counter, by time
    bus_.clear();
    camera_with(Fault::Kind::drop).add_fault({Fault::Kind::drop, 4});
    const auto source = open({{"frame-info", frame_info}});
    take_three(*source);
    const auto frame = source->next();
    EXPECT_EQ(frame->lost_before, 2) << frame_info;
    EXPECT_EQ(frame->index, 5) << frame_info;
    EXPECT_EQ(source->next()->lost_before, 0) << frame_info;
  }
}

TEST_F(Dc1394Faults, ALateFrameIsNoLossToACameraThatCounts) {
  camera_with(Fault::Kind::late);
  const auto source = open({{"frame-info", "on"}});
  take_three(*source);
  const auto frame = source->next();
  EXPECT_EQ(frame->lost_before, 0);
  EXPECT_NEAR(frame->timestamp_s, 5 / 60.0, 0.0003);
  EXPECT_EQ(source->next()->lost_before, 0);
}

TEST_F(Dc1394Faults, AFrameThatArrivesInPartIsLeftOutAndCounted) {
  for (const char* frame_info : {"on", "off"}) {
    bus_.clear();
    camera_with(Fault::Kind::short_frame, 13);  // each buffer was filled before
    const auto source = open({{"frame-info", frame_info}});
    for (int i = 0; i < 13; ++i) ASSERT_EQ(source->next()->index, i);
    const auto frame = source->next();
    EXPECT_EQ(frame->index, 14);
    EXPECT_EQ(frame->lost_before, 1);
    EXPECT_TRUE(has(log_, {test::kGuidText, "in part"}));
  }
}

TEST_F(Dc1394Faults, ABusResetThatDoesNotDisturbTheCameraLosesNothing) {
  camera_with(Fault::Kind::bus_reset);
  const auto source = open();
  take_three(*source);
  for (int i = 3; i < 10; ++i) {
    const auto frame = source->next();
    EXPECT_EQ(frame->index, i);
    EXPECT_EQ(frame->lost_before, 0);
  }
}

TEST_F(Dc1394Faults, AfterABusResetThatStopsTheCameraItIsStartedAgain) {
  camera_with(Fault::Kind::reset_stops);
  const auto source = open();
  take_three(*source);
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(has(log_, {test::kGuidText, "bus reset", "settings restored"}));
}

TEST_F(Dc1394Faults, AnUnpluggedCameraGoesOnWhenItIsBackWithItsSettings) {
  test::EmulatedCamera& camera = camera_with(Fault::Kind::unplug);
  camera.replug_after = 3;
  const auto source = open({{"gain", "321"}, {"shutter", "abs:5"}, {"capture", "newest"}});
  source->next();
  while (camera.plugged) source->next();
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(has(log_, {"unplugged", "settings restored", test::kGuidText}));
  EXPECT_EQ(reg(camera, 0x820) & 0xFFFU, 321U);
  EXPECT_EQ(reg(camera, 0x614), 0x80000000U);
}

TEST_F(Dc1394Faults, SettingsThatNobodyGaveAreRestoredAfterAReplug) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  open({{"gain", "444"}, {"shutter", "abs:7"}});  // by another program, say
  {
    const std::lock_guard lock(bus_.mutex());
    camera.add_fault({Fault::Kind::unplug, camera.frame() + 5});
    camera.replug_after = 2;
  }
  const auto source = open();
  for (int i = 0; i < 20; ++i) source->next();
  EXPECT_TRUE(has(log_, {"unplugged", "settings restored"}));
  EXPECT_EQ(reg(camera, 0x820) & 0xFFFU, 444U);
  EXPECT_NEAR(std::bit_cast<float>(reg(camera, 0x978)), 0.007F, 1e-6);
}

TEST_F(Dc1394Faults, ATriggeredCameraGoesOnAfterAReplug) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open({{"trigger", "0"}, {"trigger-source", "software"}});
  EXPECT_TRUE(source->next());
  bus_.unplug(camera);
  bus_.plug(camera);
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(source->next());
}

TEST_F(Dc1394Faults, IsStartedAgainThoughItsShutterBecameSlowerThanThePatienceAllowsAtFirst) {
  test::EmulatedCamera& camera = camera_with(Fault::Kind::reset_stops);
  const auto source = open({{"shutter", "auto"}, {"frame-rate", "off"}, {"stall-timeout", "1"}});
  take_three(*source);
  {
    // It is dark, and automatic exposure comes to 0.9 s: half of the patience would be needed.
    constexpr std::uint64_t kShutter = 0xF0081C, kShutterInSeconds = 0xF00978;
    const std::lock_guard lock(bus_.mutex());
    const auto automatic = camera.registers().read(kShutter);
    camera.registers().write(kShutter, *automatic | 0x40000000U);
    EXPECT_TRUE(camera.registers().write(kShutterInSeconds, std::bit_cast<std::uint32_t>(0.9F)));
    camera.registers().write(kShutter, *automatic);
  }
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(source->next());
  EXPECT_TRUE(has(log_, {"sends again"}));
}

TEST_F(Dc1394Faults, IndexAndTimeGoOnOverAReplug) {
  camera_with(Fault::Kind::unplug).replug_after = 2;
  const auto source = open();
  take_three(*source);
  const auto frame = source->next();
  EXPECT_GE(frame->index, 3);
  EXPECT_EQ(frame->index, 3 + frame->lost_before);
  EXPECT_GT(frame->timestamp_s, 2 / 60.0);
}

TEST_F(Dc1394Faults, ACameraThatStaysAwayIsAnErrorThatNamesItAndCanBeTriedAgain) {
  test::EmulatedCamera& camera = camera_with(Fault::Kind::unplug);
  const auto source = open({{"recovery-timeout", "0.3"}});
  take_three(*source);
  const std::string message = message_of<CaptureError>([&] { source->next(); });
  EXPECT_TRUE(has(message, {test::kGuidText, "Dragonfly2", "unplugged", "0.3 s", "cable"}));
  bus_.plug(camera);
  EXPECT_TRUE(source->next());
}

TEST_F(Dc1394Faults, AStalledCameraIsStartedAgain) {
  camera_with(Fault::Kind::stall);
  const auto source = open();
  take_three(*source);
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(has(log_, {"no frame although it should send", "settings restored"}));
}

TEST_F(Dc1394Faults, ACameraThatStaysSilentIsAnErrorWithinTheStallTimeout) {
  test::EmulatedCamera& camera = camera_with(Fault::Kind::dies);
  const auto source = open({{"stall-timeout", "0.6"}});
  take_three(*source);
  const std::string message = message_of<CaptureError>([&] { source->next(); });
  EXPECT_TRUE(has(message, {test::kGuidText, "no frame for 0.6 s", "--stall-timeout"}));
  {
    const std::lock_guard lock(bus_.mutex());
    camera.dead = false;
    bus_.changed().notify_all();
  }
  EXPECT_TRUE(source->next()) << "a further call tries again";
}

TEST_F(Dc1394Faults, AMissingTriggerIsAnErrorThatSaysSo) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open({{"trigger", "0"}, {"trigger-source", "1"}, {"stall-timeout", "0.3"}});
  EXPECT_TRUE(has(message_of<CaptureError>([&] { source->next(); }), {"trigger", "--trigger off"}));
}

TEST_F(Dc1394Faults, NoBandwidthIsAnErrorBeforeStreamingThatSaysWhatWouldHelp) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  bus_.set_bandwidth(bandwidth_ = 100);
  const std::string message = refusal<BackendUnavailable>({});
  EXPECT_TRUE(has(message, {test::kGuidText, "bandwidth", "of 4915", "--fps", "--roi"}));
  EXPECT_EQ(reg(camera, 0x614), 0U);
}

TEST_F(Dc1394Faults, ACameraInUseIsLeftAlone) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  bus_.give_to_another_program(camera);
  reserved_channels_ = bus_.channels_in_use();
  const std::string message = refusal<BackendUnavailable>({});
  EXPECT_TRUE(has(message, {test::kGuidText, "in use", "another program"}));
  EXPECT_EQ(reg(camera, 0x614), 0x80000000U) << "the other program's camera was stopped";
}

TEST_F(Dc1394Faults, ACameraThatACrashLeftSendingIsStoppedAndUsed) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  {
    const std::lock_guard lock(bus_.mutex());
    camera.registers().set_iso(true, 9);  // a channel that nobody holds any more
  }
  EXPECT_TRUE(open()->next());
  EXPECT_TRUE(has(log_, {"left sending"}));
}

TEST_F(Dc1394Faults, WithoutPermissionTheUdevRuleIsNamed) {
  bus_.add_camera("DR2-BW", test::kGuid);
  bus_.set_open_error(EACCES);
  EXPECT_TRUE(has(refusal<BackendUnavailable>({}),
                  {"/dev/fw1", "60-anneal6d-firewire.rules", "usermod -aG video"}));
}

TEST_F(Dc1394Faults, ADeviceThatAnotherProgramHasOpenIsNamed) {
  bus_.add_camera("DR2-BW", test::kGuid);
  bus_.set_open_error(EBUSY);
  EXPECT_TRUE(has(refusal<BackendUnavailable>({}), {"/dev/fw1", "another program"}));
}

TEST_F(Dc1394Faults, AWrongGuidListsTheCamerasThatThereAre) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const auto open_other = [] { open_dc1394_camera("00b09d0100ffffff", Dc1394Options()); };
  EXPECT_TRUE(
      has(message_of<BackendUnavailable>(open_other), {"00b09d0100ffffff", test::kGuidText}));
  const auto open_nonsense = [] { open_dc1394_camera("front", Dc1394Options()); };
  EXPECT_TRUE(has(message_of<ConfigError>(open_nonsense), {"front", "hexadecimal"}));
}

TEST_F(Dc1394Faults, WithoutACameraItSaysWhatToCheck) {
  EXPECT_TRUE(has(refusal<BackendUnavailable>({}), {"no FireWire bus", "firewire-ohci"}));
}

TEST_F(Dc1394Faults, AFeatureThatRefusesIsAnErrorThatNamesIt) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  camera.registers().refuse_writes_to(0x820);
  EXPECT_TRUE(has(refusal<CaptureError>({{"gain", "300"}}), {test::kGuidText, "gain"}));
  EXPECT_EQ(reg(camera, 0x614), 0U);
}

TEST_F(Dc1394Faults, GarbageInTheRegistersIsAnErrorAndNoCrash) {
  for (const std::uint32_t garbage : {0xFFFFFFFFU, 0U, 0xDEADBEEFU, 0x7F7F7F7FU, 0x00010001U}) {
    bus_.clear();
    test::EmulatedCamera& camera = bus_.add_camera("DR2-COL", test::kGuid);
    camera.registers().answer_inquiries_with(garbage);
    for (const char* mode : {"format7-0", "640x480-mono8"}) {
      try {
        open({{"video-mode", mode}, {"gain", "300"}});
      } catch (const Error& error) {
        EXPECT_TRUE(has(error.what(), {"camera"}));
      }
    }
    EXPECT_NO_THROW(list_dc1394_cameras());
  }
}

TEST_F(Dc1394Faults, ACameraUnpluggedWhileItIsSetUpIsAnError) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open();
  source->next();
  bus_.unplug(camera);
  EXPECT_THROW(open(), BackendUnavailable);
}

TEST_F(Dc1394Faults, FramesInRealTimeAreLostOnlyWhenNobodyTakesThem) {
  bus_.add_camera("DR2-BW", test::kGuid);
  bus_.set_pace(emulated::Pace::real_time);
  const auto source =
      open({{"buffers", "2"}, {"fps", "60"}, {"frame-info", "on"}, {"stall-timeout", "3"}});
  source->next();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  std::int64_t lost = 0;
  for (int i = 0; i < 4; ++i) lost += source->next()->lost_before;
  EXPECT_GT(lost, 3) << "twelve frames came while two buffers waited";
}

}  // namespace
}  // namespace anneal6d
