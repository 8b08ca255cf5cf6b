// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "iso_channel.h"

#include <fcntl.h>
#include <linux/firewire-cdev.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <optional>
#include <string>

#include "device_nodes.h"

namespace anneal6d::dc1394 {
namespace {

// The bus manager may be asked only a second after a bus reset; the kernel waits for that.
constexpr int kAnswerTimeout_ms = 3000;

class File {
 public:
  explicit File(const std::string& path) : fd_(open(path.c_str(), O_RDWR | O_CLOEXEC)) {}
  ~File() {
    if (fd_ >= 0) close(fd_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int fd() const { return fd_; }

 private:
  int fd_;
};

bool is_camera(int fd, std::uint64_t guid) {
  std::array<std::uint32_t, 256> rom{};
  fw_cdev_get_info info{};
  info.version = 4;
  info.rom = reinterpret_cast<std::uintptr_t>(rom.data());
  info.rom_length = sizeof rom;
  return ioctl(fd, FW_CDEV_IOC_GET_INFO, &info) == 0 &&
         (std::uint64_t{rom[3]} << 32 | rom[4]) == guid;
}

// The kernel has no question for it: what is asked about is taken and given back with the file.
// Empty if the question can't be put.
std::optional<fw_cdev_event_iso_resource> try_to_take(std::uint64_t guid, std::uint64_t channels,
                                                      std::uint32_t bandwidth) {
  for (const DeviceNode& node : list_device_nodes()) {
    const File file(node.path);
    if (file.fd() < 0 || !is_camera(file.fd(), guid)) continue;
    fw_cdev_allocate_iso_resource request{};
    request.channels = channels;
    request.bandwidth = bandwidth;
    if (ioctl(file.fd(), FW_CDEV_IOC_ALLOCATE_ISO_RESOURCE, &request) != 0) return std::nullopt;
    for (;;) {
      pollfd waiting{file.fd(), POLLIN, 0};
      std::array<std::uint64_t, 64> bytes{};
      if (poll(&waiting, 1, kAnswerTimeout_ms) <= 0) return std::nullopt;
      if (read(file.fd(), bytes.data(), sizeof bytes) < 0) return std::nullopt;
      fw_cdev_event_iso_resource event{};
      std::memcpy(&event, bytes.data(), sizeof event);
      if (event.type == FW_CDEV_EVENT_ISO_RESOURCE_ALLOCATED) return event;
    }
  }
  return std::nullopt;
}

}  // namespace

bool is_channel_free(std::uint64_t guid, int channel) {
  if (channel < 0 || channel > 63) return true;
  const auto answer = try_to_take(guid, std::uint64_t{1} << channel, 0);
  return !answer || answer->channel >= 0;
}

bool is_bandwidth_free(std::uint64_t guid, std::uint32_t units) {
  if (units == 0) return true;
  const auto answer = try_to_take(guid, 0, units);
  return !answer || answer->bandwidth > 0;
}

}  // namespace anneal6d::dc1394
