// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "dc1394_source.h"

#include <algorithm>
#include <cstdio>
#include <thread>
#include <utility>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "extras.h"
#include "mode_names.h"

namespace anneal6d::dc1394 {
namespace {

using std::chrono::milliseconds;

// After this long without a frame the camera is asked whether it still sends.
constexpr milliseconds kQuiet{250};
constexpr milliseconds kBetweenSearches{100};

milliseconds in_ms(double seconds) {
  return milliseconds(static_cast<std::int64_t>(seconds * 1000));
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", seconds);
  return text;
}

RawPicture picture_of(const dc1394video_frame_t& frame, const VideoFormat& format,
                      dc1394color_filter_t filter) {
  RawPicture picture;
  picture.bytes = frame.image;
  picture.size = format.size;
  picture.coding = format.coding;
  picture.filter = filter;
  picture.depth_bits = static_cast<int>(frame.data_depth);
  picture.little_endian = frame.little_endian == DC1394_TRUE;
  return picture;
}

}  // namespace

Dc1394Source::Dc1394Source(const std::string& guid, Dc1394Options options,
                           std::optional<CameraModel> camera)
    : options_(std::move(options)), calibration_(std::move(camera)) {
  const auto wanted = guid.empty() ? std::nullopt : std::optional(parse_guid(guid));
  auto found = std::make_unique<Camera>(wanted);
  guid_ = found->guid();
  name_ = found->name();
  start(std::move(found));
}

Dc1394Source::~Dc1394Source() {
  stop();
  if (camera_ && options_.power_down) dc1394_camera_set_power(camera_->get(), DC1394_OFF);
}

void Dc1394Source::start(std::unique_ptr<Camera> camera) {
  silence(*camera);
  if (features_) features_->restore(*camera);
  configuration_ = configure(*camera, options_, calibration_);
  decoder_.emplace(configuration_.format, options_);
  if (!features_) {  // the first time
    check_patience(*camera, options_, configuration_.period_s);
    save_memory(*camera, options_);
    features_.emplace(*camera);
  }
  generation_ = camera->generation();
  stream_ = std::make_unique<IsoStream>(*camera, options_);
  camera_ = std::move(camera);
  if (!clock_) clock_.emplace(configuration_.period_s);
  clock_->restart();
  unsettled_ = options_.settle_frames;
}

void Dc1394Source::stop() { stream_.reset(); }

// What follows is the same for a silent and for an unplugged camera: find it, set it up, start it.
void Dc1394Source::let_go(const std::string& why) {
  log(LogLevel::warning, name_ + " " + why);
  stop();
  camera_.reset();
}

// Until the camera is back, at most for the recovery timeout.
void Dc1394Source::wait_for_camera() {
  const auto begin = Clock::now();
  const auto deadline = begin + in_ms(options_.recovery_timeout_s);
  std::string reason;
  do {
    try {
      start(std::make_unique<Camera>(guid_));
      const double waited = std::chrono::duration<double>(Clock::now() - begin).count();
      log(LogLevel::info,
          name_ + " sends again after " + seconds_text(waited) + ", with its settings restored");
      return;
    } catch (const Error& error) {  // not there, or plugged in, but not yet awake
      reason = error.what();
    }
    std::this_thread::sleep_for(kBetweenSearches);
  } while (Clock::now() < deadline);
  throw CaptureError(name_ + " was unplugged or lost its power and did not come back within " +
                     seconds_text(options_.recovery_timeout_s) +
                     "; check cable and power (last: " + reason + ")");
}

void Dc1394Source::fire_trigger() {
  if (!camera_ || !configuration_.triggered || options_.trigger_source != "software") return;
  const dc1394error_t result = dc1394_software_trigger_set_power(camera_->get(), DC1394_ON);
  if (result == DC1394_SUCCESS) return;
  dc1394switch_t on = DC1394_OFF;
  if (dc1394_video_get_transmission(camera_->get(), &on) == DC1394_SUCCESS) {
    check(result, name_, "trigger it");
  }
  let_go("was unplugged; waiting for it");
}

// Lets a camera go that does not send any more.
void Dc1394Source::look_after_silent_camera(bool patience_is_short) {
  dc1394switch_t on = DC1394_OFF;
  if (dc1394_video_get_transmission(camera_->get(), &on) != DC1394_SUCCESS) {
    let_go("does not answer any more");
    return;
  }
  const std::uint32_t generation = camera_->generation();
  const bool was_reset = std::exchange(generation_, generation) != generation;
  if (on == DC1394_OFF) {
    let_go(was_reset ? "was stopped by a bus reset" : "stopped sending");
  } else if (patience_is_short && !configuration_.triggered) {
    let_go("gives no frame although it should send");
  }
}

std::optional<TimedFrame> Dc1394Source::take(IsoStream::Received received) {
  passed_unsettled_ += received.passed_over;
  if (unsettled_ > 0) {
    unsettled_ -= static_cast<int>(std::min<std::int64_t>(received.passed_over + 1, unsettled_));
    ++passed_unsettled_;
    return std::nullopt;
  }
  const dc1394video_frame_t& raw = *received.frame;
  const RawPicture picture = picture_of(raw, configuration_.format, decoder_->filter());
  std::optional<std::uint32_t> counter;
  if (configuration_.counts_frames) counter = take_frame_counter(picture);
  const FrameClock::Stamp stamp =
      clock_->stamp(raw.timestamp, counter, std::exchange(passed_unsettled_, 0));
  TimedFrame timed;
  timed.frame.image = decoder_->decode(picture);
  timed.frame.index = stamp.index;
  timed.frame.timestamp_s = stamp.timestamp_s;
  timed.frame.lost_before = stamp.lost_before;
  timed.time_us = raw.timestamp;
  return timed;
}

TimedFrame Dc1394Source::next_timed(Dc1394Options::Frames which) {
  const milliseconds patience = in_ms(options_.stall_timeout_s);
  const bool newest = which == Dc1394Options::Frames::newest;
  auto since = Clock::now();
  bool started_again = false;
  fire_trigger();
  for (;;) {
    if (!camera_ || !stream_) {
      wait_for_camera();
      // Starting it again is no excuse for a camera that stays silent.
      if (!started_again) since = Clock::now();
      fire_trigger();
      continue;
    }
    const auto waited = std::chrono::duration_cast<milliseconds>(Clock::now() - since);
    if (waited >= patience) {
      throw CaptureError(name_ + " gives no frame for " + seconds_text(options_.stall_timeout_s) +
                         (configuration_.triggered
                              ? "; it waits for its trigger (--trigger off lets it run freely)"
                              : "; check the cable, switch it off and on again") +
                         ", or allow more time with --stall-timeout");
    }
    IsoStream::Received received = stream_->receive(std::min(kQuiet, patience - waited), newest);
    if (received.outcome == IsoStream::Outcome::frame) {
      if (auto frame = take(std::move(received))) return *std::move(frame);
      since = Clock::now();  // it sends, though nothing that is wanted yet
      fire_trigger();
    } else if (received.outcome == IsoStream::Outcome::gone) {
      let_go("was unplugged; waiting for it");
    } else {
      // One attempt to start it again in the second half of the patience.
      const bool late = !started_again && Clock::now() - since > patience / 2;
      look_after_silent_camera(late);
      started_again = started_again || late;
    }
  }
}

std::string Dc1394Source::description() const {
  std::string text = name_ + ", frames of " + size_text(configuration_.format.size) + " (" +
                     configuration_.format.name + ")";
  if (configuration_.period_s > 0) {
    char rate[32];
    std::snprintf(rate, sizeof rate, " at %.4g fps", 1.0 / configuration_.period_s);
    text += rate;
  }
  return text + (configuration_.triggered ? ", triggered" : "");
}

}  // namespace anneal6d::dc1394
