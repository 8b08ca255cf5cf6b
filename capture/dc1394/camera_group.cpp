// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "camera_group.h"

#include <algorithm>
#include <cstdio>

#include "anneal6d/framework/error.h"

namespace anneal6d::dc1394 {
namespace {

// Cameras of one bus expose within 125 us of each other (data sheet); the times are known to one
// cycle of the bus, another 125 us each.
constexpr std::uint64_t kTogether_us = 500;

// So many frames out of step are no start-up and no loss, but cameras that run on their own.
constexpr int kMostAttempts = 200;

}  // namespace

CameraGroup::CameraGroup(const std::vector<std::string>& guids, const Dc1394Options& options)
    : which_(options.frames) {
  if (guids.size() < 2) {
    throw ConfigError("a group needs the GUIDs of two or more cameras, separated by commas");
  }
  if (options.trigger_source == "software") {
    throw ConfigError(
        "--trigger-source: 'software' fires one camera after the other; cameras of a group run "
        "freely or share a pin");
  }
  for (const std::string& guid : guids) {
    const bool twice = std::any_of(sources_.begin(), sources_.end(), [&](const auto& source) {
      return source->guid() == parse_guid(guid);
    });
    if (twice) throw ConfigError("camera " + guid + " is given twice");
    sources_.push_back(std::make_unique<Dc1394Source>(guid, options, std::nullopt));
  }
}

std::optional<FrameSet> CameraGroup::next() {
  frames_.clear();
  std::vector<std::int64_t> lost;  // of each camera since the last set
  for (const auto& source : sources_) {
    frames_.push_back(source->next_timed(which_));
    lost.push_back(frames_.back().frame.lost_before);
  }
  const auto by_time = [](const TimedFrame& a, const TimedFrame& b) {
    return a.time_us < b.time_us;
  };
  for (int attempt = 0;; ++attempt) {
    const auto [first, last] = std::minmax_element(frames_.begin(), frames_.end(), by_time);
    const std::uint64_t spread_us = last->time_us - first->time_us;
    if (spread_us <= kTogether_us) {
      FrameSet set;
      set.spread_s = static_cast<double>(spread_us) * 1e-6;
      // Cameras in step lose frames of the same sets or of different ones; nothing tells which.
      set.lost_before = *std::max_element(lost.begin(), lost.end());
      for (TimedFrame& timed : frames_) set.frames.push_back(std::move(timed.frame));
      return set;
    }
    if (attempt == kMostAttempts) {
      char text[64];
      std::snprintf(text, sizeof text, "%.1f ms", static_cast<double>(spread_us) * 1e-3);
      throw CaptureError(description() + " do not expose together, they are " + text +
                         " apart; connect them to the same bus, give them the same frame rate and "
                         "no trigger of their own");
    }
    // In order, so that it does not overtake the others.
    const auto behind = static_cast<std::size_t>(first - frames_.begin());
    frames_[behind] = sources_[behind]->next_timed(Dc1394Options::Frames::every);
    lost[behind] += frames_[behind].frame.lost_before;
  }
}

std::string CameraGroup::description() const {
  std::string text;
  for (const auto& source : sources_) text += (text.empty() ? "" : " and ") + source->name();
  return text;
}

}  // namespace anneal6d::dc1394
