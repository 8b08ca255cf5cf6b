// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// The isochronous side of a client: what camera, bus and receiving hardware do together.
#include <arpa/inet.h>
#include <linux/firewire-cdev.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <mutex>

#include "client.h"
#include "config_rom.h"
#include "emulated_bus.h"

namespace anneal6d::emulated {
namespace {

constexpr std::int64_t kCycle_us = 125;

// Seconds (three bits here, seven in the cycle timer) and cycles of a time on the bus.
std::uint32_t seconds_and_cycles(std::int64_t time_us, std::uint32_t seconds_mask) {
  const auto seconds = static_cast<std::uint32_t>(time_us / 1'000'000) & seconds_mask;
  const auto cycles = static_cast<std::uint32_t>(time_us % 1'000'000 / kCycle_us);
  return seconds << 13 | cycles;
}

}  // namespace

int Client::start() {
  if (!receives_ || thread_.joinable()) return -EINVAL;
  stop_ = false;
  thread_ = std::thread([this] { receive(); });
  return 0;
}

void Client::stop_receiving(std::unique_lock<std::mutex>& lock) {
  stop_ = true;
  bus_->changed().notify_all();
  std::thread thread = std::move(thread_);
  lock.unlock();
  if (thread.joinable()) thread.join();
  lock.lock();
  queue_.clear();
}

bool Client::ready() const {
  const CameraRegisters& registers = camera_->registers();
  return !gone_ && camera_->plugged && !camera_->dead && !camera_->stalled &&
         registers.transmitting() && registers.powered() && registers.iso_channel() == channel_ &&
         (!queue_.empty() || bus_->pace() == Pace::real_time) &&
         (!registers.waits_for_trigger() ||
          (registers.read(kCommandBase + 0x62C).value_or(0) & 0x80000000U) != 0);
}

std::int64_t Client::schedule() {
  std::int64_t& next = camera_->next_frame_us;
  if (next < 0 || camera_->registers().waits_for_trigger()) {
    // Cameras on one bus expose together, at multiples of their period.
    const std::int64_t period = std::max<std::int64_t>(camera_->registers().format().period_us, 1);
    next = (bus_->now_us() / period + 1) * period + camera_->skew_us;
  }
  return next;
}

void Client::receive() {
  std::unique_lock lock(bus_->mutex());
  while (!stop_) {
    bus_->changed().wait(lock, [this] { return stop_ || ready(); });
    if (stop_) return;
    const std::int64_t due = schedule();
    if (bus_->pace() == Pace::real_time && bus_->now_us() < due) {
      bus_->changed().wait_for(lock, std::chrono::microseconds(due - bus_->now_us()));
      continue;
    }
    bus_->advance_to(due);
    receive_frame(due);
  }
}

void Client::receive_frame(std::int64_t time_us) {
  CameraRegisters& registers = camera_->registers();
  const std::int64_t period = registers.format().period_us;
  registers.take_software_trigger();
  camera_->next_frame_us = time_us + period;
  bool drop = false, cut = false;
  for (const Fault::Kind fault : camera_->take_faults()) {
    switch (fault) {
      case Fault::Kind::drop:
        drop = true;
        break;
      case Fault::Kind::late:
        time_us += 2 * period;
        camera_->next_frame_us = time_us + period;
        break;
      case Fault::Kind::short_frame:
        cut = true;
        break;
      case Fault::Kind::bus_reset:
        bus_->reset_locked();
        break;
      case Fault::Kind::reset_stops:
        registers.stop_transmitting();
        bus_->reset_locked();
        return;
      case Fault::Kind::stall:
        camera_->stalled = true;
        return;
      case Fault::Kind::dies:
        camera_->dead = true;
        return;
      case Fault::Kind::unplug:
        bus_->unplug_locked(*camera_);
        return;
    }
  }
  if (drop || queue_.empty()) {
    camera_->miss();
    return;
  }
  const Buffer buffer = queue_.front();
  queue_.pop_front();
  bus_->advance_to(time_us);
  auto* memory = reinterpret_cast<std::uint8_t*>(static_cast<std::uintptr_t>(buffer.address));
  camera_->expose({memory, cut ? buffer.bytes / 2 : buffer.bytes}, seconds_and_cycles(time_us, 0x7F)
                                                                       << 12);
  finish(buffer, time_us);
}

void Client::finish(const Buffer& buffer, std::int64_t time_us) {
  const std::size_t packets = std::min<std::size_t>(buffer.packets, 480);
  std::vector<std::uint32_t> words(6 + 2 * packets);
  const std::int64_t end_us = time_us + static_cast<std::int64_t>(buffer.packets) * kCycle_us;
  fw_cdev_event_iso_interrupt head{};
  head.closure = iso_closure_;
  head.type = FW_CDEV_EVENT_ISO_INTERRUPT;
  head.cycle = seconds_and_cycles(end_us, 0x7);
  head.header_length = static_cast<std::uint32_t>(packets * 8);
  constexpr std::size_t head_bytes = offsetof(fw_cdev_event_iso_interrupt, header);
  std::memcpy(words.data(), &head, head_bytes);
  for (std::size_t i = 0; i < packets; ++i) {
    const std::int64_t at_us = time_us + static_cast<std::int64_t>(i) * kCycle_us;
    const std::uint32_t header[2] = {
        htonl(static_cast<std::uint32_t>(channel_) << 8 | 0xA0U | (i == 0 ? 1U : 0U)),
        htonl(seconds_and_cycles(at_us, 0x7))};
    std::memcpy(reinterpret_cast<char*>(words.data()) + head_bytes + i * 8, header, 8);
  }
  bus_->advance_to(end_us);
  send_event(words.data(), head_bytes + packets * 8);
}

}  // namespace anneal6d::emulated
