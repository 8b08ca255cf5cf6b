// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "emulated_bus.h"

#include <algorithm>
#include <cerrno>
#include <chrono>

#include "client.h"

namespace anneal6d::emulated {

EmulatedBus& EmulatedBus::instance() {
  // Never destroyed: files are closed by whoever is last at the end of the process.
  static EmulatedBus* bus = new EmulatedBus;
  return *bus;
}

EmulatedCamera& EmulatedBus::add_camera(std::string_view model, std::uint64_t guid,
                                        Pictures pictures) {
  const std::lock_guard lock(mutex_);
  cameras_.push_back(
      std::make_unique<EmulatedCamera>(find_camera_model(model), guid, std::move(pictures)));
  return *cameras_.back();
}

void EmulatedBus::clear() {
  const std::lock_guard lock(mutex_);
  cameras_.clear();
  pace_ = Pace::on_demand;
  channels_ = 0;
  bandwidth_ = 4915;
  open_error_ = 0;
  enumerations_ = 0;
}

void EmulatedBus::set_pace(Pace pace) {
  const std::lock_guard lock(mutex_);
  pace_ = pace;
}

void EmulatedBus::set_open_error(int error) {
  const std::lock_guard lock(mutex_);
  open_error_ = error;
}

void EmulatedBus::set_bandwidth(int units) {
  const std::lock_guard lock(mutex_);
  bandwidth_ = units;
}

int EmulatedBus::bandwidth() const {
  const std::lock_guard lock(mutex_);
  return bandwidth_;
}

std::uint64_t EmulatedBus::channels_in_use() const {
  const std::lock_guard lock(mutex_);
  return channels_;
}

int EmulatedBus::open_files() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(clients_.size());
}

int EmulatedBus::enumerations() const {
  const std::lock_guard lock(mutex_);
  return enumerations_;
}

void EmulatedBus::give_to_another_program(EmulatedCamera& camera) {
  const std::lock_guard lock(mutex_);
  camera.registers().set_iso(true, take_channel(0xFFFF));
}

void EmulatedBus::reset() {
  const std::lock_guard lock(mutex_);
  reset_locked();
}

void EmulatedBus::reset_locked() {
  ++generation_;
  for (const auto& [fd, client] : clients_) {
    if (!client->gone()) client->tell_reset(generation_);
  }
  changed_.notify_all();
}

void EmulatedBus::unplug(EmulatedCamera& camera) {
  const std::lock_guard lock(mutex_);
  unplug_locked(camera);
}

void EmulatedBus::unplug_locked(EmulatedCamera& camera) {
  camera.plugged = false;
  for (const auto& [fd, client] : clients_) {
    if (client->camera() == &camera && !client->gone()) client->vanish();
  }
  reset_locked();
}

void EmulatedBus::plug(EmulatedCamera& camera) {
  const std::lock_guard lock(mutex_);
  camera.power_cycle();
  camera.plugged = true;
  reset_locked();
}

std::string EmulatedBus::name_of(std::size_t device) const { return "fw" + std::to_string(device); }

std::vector<std::string> EmulatedBus::node_names() {
  const std::lock_guard lock(mutex_);
  ++enumerations_;
  if (cameras_.empty()) return {};
  std::vector<std::string> names = {name_of(0)};  // the computer itself
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    EmulatedCamera& camera = *cameras_[i];
    if (!camera.plugged && camera.replug_after >= 0 && camera.replug_after-- == 0) {
      camera.power_cycle();
      camera.plugged = true;
      reset_locked();
    }
    if (camera.plugged) names.push_back(name_of(i + 1));
  }
  return names;
}

int EmulatedBus::open(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (cameras_.empty()) {
    errno = ENOENT;
    return -1;
  }
  if (open_error_ != 0) {
    errno = open_error_;
    return -1;
  }
  for (std::size_t i = 0; i <= cameras_.size(); ++i) {
    EmulatedCamera* camera = i == 0 ? nullptr : cameras_[i - 1].get();
    if (name != name_of(i) || (camera != nullptr && !camera->plugged)) continue;
    auto client = std::make_shared<Client>(*this, camera);
    if (client->fd() < 0) return -1;
    const int fd = client->fd();
    clients_[fd] = std::move(client);
    return fd;
  }
  errno = ENOENT;
  return -1;
}

std::shared_ptr<Client> EmulatedBus::client(int fd) const {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(fd);
  return found == clients_.end() ? nullptr : found->second;
}

void EmulatedBus::close(int fd) {
  const std::shared_ptr<Client> closing = client(fd);
  if (!closing) return;
  closing->shut_down();
  const std::lock_guard lock(mutex_);
  clients_.erase(fd);
}

std::int64_t EmulatedBus::now_us() const {
  if (pace_ == Pace::on_demand) return time_us_;
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void EmulatedBus::advance_to(std::int64_t time_us) { time_us_ = std::max(time_us_, time_us); }

std::uint32_t EmulatedBus::cycle_timer() const {
  const std::int64_t now = now_us();
  const auto seconds = static_cast<std::uint32_t>(now / 1'000'000 % 128);
  const auto cycles = static_cast<std::uint32_t>(now % 1'000'000 / 125);
  const auto ticks = static_cast<std::uint32_t>(now % 125 * 3072 / 125);
  return seconds << 25 | cycles << 12 | ticks;
}

int EmulatedBus::take_channel(std::uint64_t mask) {
  for (int channel = 0; channel < 64; ++channel) {
    const std::uint64_t bit = std::uint64_t{1} << channel;
    if ((mask & bit) == 0 || (channels_ & bit) != 0) continue;
    channels_ |= bit;
    return channel;
  }
  return -1;
}

bool EmulatedBus::take_bandwidth(int units) {
  if (units > bandwidth_) return false;
  bandwidth_ -= units;
  return true;
}

void EmulatedBus::give_back(int channel, int units) {
  if (channel >= 0) channels_ &= ~(std::uint64_t{1} << channel);
  bandwidth_ += units;
}

}  // namespace anneal6d::emulated
