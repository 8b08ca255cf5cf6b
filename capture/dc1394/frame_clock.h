// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <optional>

namespace anneal6d::dc1394 {

/// Numbers frames and finds out how many were lost, by the camera's own counter if it sends one
/// and by the time of exposure otherwise: libdc1394 can't tell on Linux.
class FrameClock {
 public:
  struct Stamp {
    std::int64_t index = 0;        ///< counts all frames that the camera took, from 0
    std::int64_t lost_before = 0;  ///< never arrived; those passed over do not count
    double timestamp_s = 0;        ///< since the first frame
  };

  /// `period_s`: from frame to frame; 0: not known, then only the counter tells of losses.
  explicit FrameClock(double period_s) : period_s_(period_s) {}

  /// `time_us`: of the exposure; `passed_over`: complete frames since the last one stamped that are
  /// not handed out.
  Stamp stamp(std::uint64_t time_us, std::optional<std::uint32_t> counter,
              std::int64_t passed_over);

  /// The camera was started anew: its counter does not go on from the last frame.
  void restart() { last_counter_.reset(); }

 private:
  std::int64_t missing(std::uint64_t time_us, std::optional<std::uint32_t> counter,
                       std::int64_t passed_over) const;

  double period_s_;
  std::optional<std::uint64_t> first_us_;
  std::uint64_t last_us_ = 0;
  std::optional<std::uint32_t> last_counter_;
  std::int64_t index_ = -1;
};

}  // namespace anneal6d::dc1394
