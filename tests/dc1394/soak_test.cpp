// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Many frames on the emulated bus, whose time passes as fast as frames are taken: an hour's worth,
// or as many hours as ANNEAL6D_SOAK_HOURS says.
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "dc1394_test.h"

namespace anneal6d {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsOurs = false;  // sanitizers hold freed memory back
#else
constexpr bool kMemoryIsOurs = true;
#endif

class Dc1394Soak : public test::Dc1394Test {
 protected:
  static constexpr double kPeriod_s = 0.033333;  // the camera's, whole microseconds

  static double hours() {
    const char* text = std::getenv("ANNEAL6D_SOAK_HOURS");
    return text != nullptr ? std::atof(text) : 1;
  }

  static long resident_kb() {
    long size = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> size >> resident;
    return resident * (sysconf(_SC_PAGESIZE) / 1024);
  }
};

TEST_F(Dc1394Soak, RunsWithoutALeakOrALostFrame) {
  bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open({{"roi", "0,0,64,48"}, {"packet-size", "4096"}, {"fps", "30"}});
  const auto frames = static_cast<std::int64_t>(hours() * 3600 * 30);
  constexpr std::int64_t warm = 1000;
  long before_kb = 0;
  for (std::int64_t i = 0; i < frames; ++i) {
    const auto frame = source->next();
    ASSERT_EQ(frame->index, i);
    ASSERT_EQ(frame->lost_before, 0);
    if (i == warm) before_kb = resident_kb();
    if (i + 1 == frames) {
      EXPECT_NEAR(frame->timestamp_s, static_cast<double>(i) * kPeriod_s, 0.0003);
    }
  }
  if (kMemoryIsOurs) {
    EXPECT_LT(resident_kb() - before_kb, 1024) << "kilobytes more";
  }
}

TEST_F(Dc1394Soak, ReplugsLeaveNoFilesAndNoBandwidthBehind) {
  test::EmulatedCamera& camera = bus_.add_camera("DR2-BW", test::kGuid);
  const auto source = open();
  source->next();
  const int files = bus_.open_files();
  const int bandwidth = bus_.bandwidth();
  for (int i = 0; i < 20; ++i) {
    bus_.unplug(camera);
    bus_.plug(camera);
    ASSERT_TRUE(source->next());
    ASSERT_TRUE(source->next());
    EXPECT_EQ(bus_.open_files(), files);
    EXPECT_EQ(bus_.bandwidth(), bandwidth);
  }
}

}  // namespace
}  // namespace anneal6d
