// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "iso_stream.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "iso_channel.h"

namespace anneal6d::dc1394 {
namespace {

// libdc1394 can't tell that a frame arrived only in part (its `is_frame_corrupt` is always false on
// Linux). So the end of each buffer is marked before it is filled: a mark that is still there was
// not written over. Sixteen random bytes will not be a picture's.
constexpr std::array<unsigned char, 16> kMark = {0x9E, 0x37, 0x79, 0xB9, 0x7F, 0x4A, 0x7C, 0x15,
                                                 0xF3, 0x9C, 0xC0, 0x60, 0x5C, 0xED, 0xC8, 0x34};

unsigned char* mark_of(const dc1394video_frame_t& frame) {
  return frame.image_bytes < kMark.size() ? nullptr
                                          : frame.image + frame.image_bytes - kMark.size();
}

void mark(dc1394video_frame_t& frame) {
  if (unsigned char* end = mark_of(frame)) std::memcpy(end, kMark.data(), kMark.size());
}

bool is_complete(const dc1394video_frame_t& frame) {
  const unsigned char* end = mark_of(frame);
  return end == nullptr || std::memcmp(end, kMark.data(), kMark.size()) != 0;
}

void set_speed(const Camera& camera, const Dc1394Options& options) {
  const bool b_mode = options.iso_speed > 400;
  if (b_mode && camera.get()->bmode_capable == DC1394_FALSE) {
    throw ConfigError("--iso-speed: '" + std::to_string(options.iso_speed) + "' can't be set on " +
                      camera.name() + ": it has no 1394b mode; it allows 100, 200 and 400");
  }
  if (camera.get()->bmode_capable == DC1394_TRUE) {
    check(dc1394_video_set_operation_mode(
              camera.get(), b_mode ? DC1394_OPERATION_MODE_1394B : DC1394_OPERATION_MODE_LEGACY),
          camera.name(), "set the operation mode");
  }
  const dc1394speed_t speed = options.iso_speed == 100   ? DC1394_ISO_SPEED_100
                              : options.iso_speed == 200 ? DC1394_ISO_SPEED_200
                              : options.iso_speed == 400 ? DC1394_ISO_SPEED_400
                                                         : DC1394_ISO_SPEED_800;
  check(dc1394_video_set_iso_speed(camera.get(), speed), camera.name(), "set the bus speed");
}

// The kernel takes a channel and bandwidth together and, if one is missing, reports neither: the
// library then speaks of the channel, also where the bandwidth is what is short.
[[noreturn]] void explain_refusal(const Camera& camera, dc1394error_t result) {
  if (result != DC1394_NO_BANDWIDTH && result != DC1394_NO_ISO_CHANNEL) {
    check(result, camera.name(), "start capturing");
  }
  std::uint32_t needed = 0;
  dc1394_video_get_bandwidth_usage(camera.get(), &needed);
  throw BackendUnavailable(
      camera.name() +
      ": the FireWire bus has not enough bandwidth (or no channel) left for this picture, which "
      "needs " +
      std::to_string(needed) +
      " of 4915 units; stop other cameras of the bus or choose a lower --fps, a smaller --roi or "
      "--packet-size, or a --video-mode of fewer bits");
}

}  // namespace

void GiveBack::operator()(dc1394video_frame_t* frame) const {
  mark(*frame);
  dc1394_capture_enqueue(frame->camera, frame);  // fails only if the device is gone
}

void silence(const Camera& camera) {
  dc1394switch_t on = DC1394_OFF;
  check(dc1394_video_get_transmission(camera.get(), &on), camera.name(), "ask whether it sends");
  if (on == DC1394_OFF) return;
  std::uint32_t channel = 64;
  dc1394_video_get_iso_channel(camera.get(), &channel);
  if (!is_channel_free(camera.guid(), static_cast<int>(channel))) {
    throw BackendUnavailable(camera.name() + " is in use: it sends on channel " +
                             std::to_string(channel) +
                             ", which another program holds; close that program");
  }
  log(LogLevel::info, camera.name() + " was left sending by a program that ended; it is stopped");
  check(dc1394_video_set_transmission(camera.get(), DC1394_OFF), camera.name(), "stop it");
}

IsoStream::IsoStream(const Camera& camera, const Dc1394Options& options)
    : camera_(&camera), ring_size_(options.buffers) {
  set_speed(camera, options);
  const dc1394error_t result = dc1394_capture_setup(
      camera.get(), static_cast<std::uint32_t>(options.buffers), DC1394_CAPTURE_FLAGS_DEFAULT);
  if (result != DC1394_SUCCESS) explain_refusal(camera, result);
  const dc1394error_t started = dc1394_video_set_transmission(camera.get(), DC1394_ON);
  if (started != DC1394_SUCCESS) {
    dc1394_capture_stop(camera.get());
    check(started, camera.name(), "have it send");
  }
}

IsoStream::~IsoStream() {
  dc1394_video_set_transmission(camera_->get(), DC1394_OFF);
  const int fd = dc1394_capture_get_fileno(camera_->get());
  // The library (2.2.6) can't stop the capture of a device that is gone: it keeps the file open and
  // the ring allocated. The file can be closed for it; the ring is lost, 2.5 MB at 640x480 mono8.
  if (dc1394_capture_stop(camera_->get()) != DC1394_SUCCESS) close(fd);
}

// One frame if there is one; false if the device is gone.
bool IsoStream::take_next(RingFrame& frame) {
  dc1394video_frame_t* raw = nullptr;
  if (dc1394_capture_dequeue(camera_->get(), DC1394_CAPTURE_POLICY_POLL, &raw) != DC1394_SUCCESS) {
    return false;
  }
  frame.reset(raw);
  return true;
}

IsoStream::Received IsoStream::receive(std::chrono::milliseconds patience, bool newest) {
  Received received;
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!gone_) {
    RingFrame frame;
    if (!take_next(frame)) {
      gone_ = true;
      break;
    }
    if (frame) {
      if (!is_complete(*frame)) {
        log(LogLevel::warning, camera_->name() + ": a frame arrived only in part and is left out");
        continue;
      }
      if (received.frame) ++received.passed_over;
      received.frame = std::move(frame);
      // A camera as fast as this loop must not keep it going for ever.
      if (!newest || received.passed_over >= ring_size_) break;
      continue;
    }
    if (received.frame) break;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) return received;
    pollfd waiting{dc1394_capture_get_fileno(camera_->get()), POLLIN, 0};
    const int events = poll(&waiting, 1, static_cast<int>(std::min<long long>(left.count(), 1000)));
    if (events < 0 && errno != EINTR) gone_ = true;
    // A hang-up comes with what can still be read; without it there is nothing more to come.
    if (events > 0 && (waiting.revents & POLLIN) == 0) gone_ = true;
  }
  received.outcome = received.frame ? Outcome::frame : Outcome::gone;
  return received;
}

}  // namespace anneal6d::dc1394
