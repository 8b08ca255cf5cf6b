// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace anneal6d::emulated {

class EmulatedBus;
class EmulatedCamera;

/// One open file of /dev/fw*: what Linux's firewire-core does for it (linux/firewire-cdev.h).
/// Events reach the program through a socket pair, so that its own read and poll work on them.
/// Functions expect the bus's lock unless they say otherwise.
class Client {
 public:
  /// `camera` is null for the computer itself.
  Client(EmulatedBus& bus, EmulatedCamera* camera);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  int fd() const { return fd_; }
  EmulatedCamera* camera() const { return camera_; }
  bool gone() const { return gone_; }

  /// 0 or a negative errno. Takes the lock itself.
  int control(unsigned long request, void* argument);
  /// Takes the lock itself.
  void* map(std::size_t length);

  void tell_reset(std::uint32_t generation);
  /// The device is gone: reading and controlling fail with ENODEV.
  void vanish();
  /// Stops the receiver and gives back channels and bandwidth. Takes the lock itself.
  void shut_down();

 private:
  struct Buffer {
    std::uint64_t address = 0;
    std::size_t bytes = 0;
    std::size_t packets = 0;
  };
  struct Resource {
    int channel = -1;
    int bandwidth = 0;
    std::uint64_t closure = 0;
  };

  int get_info(void* argument);
  int send_request(const void* argument);
  int allocate(void* argument);
  int deallocate(const void* argument);
  int queue(const void* argument);
  int start();
  void stop_receiving(std::unique_lock<std::mutex>& lock);
  void send_event(const void* event, std::size_t bytes);

  // Receiver thread.
  void receive();
  bool ready() const;
  std::int64_t schedule();
  void receive_frame(std::int64_t time_us);
  void finish(const Buffer& buffer, std::int64_t time_us);

  EmulatedBus* bus_;
  EmulatedCamera* camera_;
  int fd_ = -1;
  int peer_ = -1;
  bool gone_ = false;
  std::uint64_t reset_closure_ = 0;
  std::map<std::uint32_t, Resource> resources_;
  std::uint32_t next_handle_ = 1;

  bool receives_ = false;  // has an isochronous context
  int channel_ = -1;
  std::uint64_t iso_closure_ = 0;
  std::deque<Buffer> queue_;
  std::thread thread_;
  bool stop_ = false;
};

}  // namespace anneal6d::emulated
