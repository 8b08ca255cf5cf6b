// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "emulated_camera.h"

namespace anneal6d::emulated {

class Client;

/// When frames come.
enum class Pace {
  on_demand,  ///< as soon as there is a buffer for them; time on the bus is counted, not measured
  real_time,
};

/// A FireWire bus with cameras, as programs see it through Linux's /dev/fw*: the files are opened,
/// read, mapped and controlled through the functions below, which an interposer calls in place of
/// libc's. One bus a process. Thread safe.
class EmulatedBus {
 public:
  static EmulatedBus& instance();

  // For tests.
  EmulatedCamera& add_camera(std::string_view model, std::uint64_t guid, Pictures pictures = {});
  /// Back to an empty bus. All files must be closed.
  void clear();
  void set_pace(Pace pace);
  /// Nobody may open /dev/fw* (EACCES), or another program has them (EBUSY); 0: all can.
  void set_open_error(int error);
  /// Isochronous bandwidth that is left, in units of 1/4915 of what IEEE 1394 allows.
  void set_bandwidth(int units);
  int bandwidth() const;
  /// Channels that somebody holds.
  std::uint64_t channels_in_use() const;
  /// Somebody else receives from this camera: it sends on a channel that is taken.
  void give_to_another_program(EmulatedCamera& camera);
  void unplug(EmulatedCamera& camera);
  void plug(EmulatedCamera& camera);
  void reset();
  int open_files() const;
  /// How often programs looked for devices.
  int enumerations() const;
  std::mutex& mutex() { return mutex_; }

  // For the interposer.
  std::vector<std::string> node_names();
  /// A file descriptor, or -1 with errno.
  int open(const std::string& name);
  std::shared_ptr<Client> client(int fd) const;
  void close(int fd);

  // For clients and receivers, with the lock held.
  std::condition_variable& changed() { return changed_; }
  Pace pace() const { return pace_; }
  std::int64_t now_us() const;
  void advance_to(std::int64_t time_us);
  std::uint32_t cycle_timer() const;
  std::uint32_t generation() const { return generation_; }
  void reset_locked();
  void unplug_locked(EmulatedCamera& camera);
  /// The first free channel of the mask, or -1.
  int take_channel(std::uint64_t mask);
  bool take_bandwidth(int units);
  void give_back(int channel, int units);

 private:
  EmulatedBus() = default;
  std::string name_of(std::size_t device) const;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::unique_ptr<EmulatedCamera>> cameras_;
  std::map<int, std::shared_ptr<Client>> clients_;
  Pace pace_ = Pace::on_demand;
  std::int64_t time_us_ = 1'000'000;
  std::uint32_t generation_ = 1;
  std::uint64_t channels_ = 0;
  int bandwidth_ = 4915;
  int open_error_ = 0;
  int enumerations_ = 0;
};

}  // namespace anneal6d::emulated
