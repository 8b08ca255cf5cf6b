// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "client.h"

#include <arpa/inet.h>
#include <linux/firewire-cdev.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <mutex>

#include "emulated_bus.h"

namespace anneal6d::emulated {
namespace {

constexpr std::uint64_t kRegisterSpace = 0xFFFFF0000000;
constexpr std::uint32_t kKernelInterface = 4;

template <class T>
T from_user(const void* argument) {
  T value;
  std::memcpy(&value, argument, sizeof value);
  return value;
}

template <class T>
T* pointer(std::uint64_t address) {
  return reinterpret_cast<T*>(static_cast<std::uintptr_t>(address));
}

}  // namespace

Client::Client(EmulatedBus& bus, EmulatedCamera* camera) : bus_(&bus), camera_(camera) {
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) == 0) {
    fd_ = ends[0];
    peer_ = ends[1];
    const int room = 1 << 20;
    setsockopt(peer_, SOL_SOCKET, SO_SNDBUF, &room, sizeof room);
  }
}

Client::~Client() {
  // libc's close is interposed; these ends are ours alone.
  if (fd_ >= 0) syscall(SYS_close, fd_);
  if (peer_ >= 0) syscall(SYS_close, peer_);
}

void Client::send_event(const void* event, std::size_t bytes) {
  if (peer_ >= 0) send(peer_, event, bytes, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void Client::tell_reset(std::uint32_t generation) {
  fw_cdev_event_bus_reset event{};
  event.closure = reset_closure_;
  event.type = FW_CDEV_EVENT_BUS_RESET;
  event.node_id = 0xFFC1;
  event.local_node_id = 0xFFC0;
  event.generation = generation;
  send_event(&event, sizeof event);
}

void Client::vanish() {
  gone_ = true;
  if (peer_ >= 0) syscall(SYS_close, peer_);  // the program's poll sees a hang-up
  peer_ = -1;
}

int Client::get_info(void* argument) {
  auto info = from_user<fw_cdev_get_info>(argument);
  if (info.rom != 0) {
    static const std::vector<std::uint32_t> computer = {0x04040000, 0x31333934, 0xE000A002, 0,
                                                        1,          0x00010000, 0x0C0083C0};
    const std::vector<std::uint32_t>& rom = camera_ != nullptr ? camera_->config_rom() : computer;
    const std::size_t bytes = rom.size() * 4;
    std::memset(pointer<void>(info.rom), 0, info.rom_length);
    std::memcpy(pointer<void>(info.rom), rom.data(), std::min<std::size_t>(bytes, info.rom_length));
    info.rom_length = static_cast<std::uint32_t>(bytes);
  }
  if (info.bus_reset != 0) {
    fw_cdev_event_bus_reset state{};
    state.type = FW_CDEV_EVENT_BUS_RESET;
    state.node_id = 0xFFC1;
    state.local_node_id = 0xFFC0;
    state.generation = bus_->generation();
    std::memcpy(pointer<void>(info.bus_reset), &state, sizeof state);
  }
  reset_closure_ = info.bus_reset_closure;
  info.version = kKernelInterface;
  info.card = 0;
  std::memcpy(argument, &info, sizeof info);
  return 0;
}

int Client::send_request(const void* argument) {
  const auto request = from_user<fw_cdev_send_request>(argument);
  fw_cdev_event_response answer{};
  answer.closure = request.closure;
  answer.type = FW_CDEV_EVENT_RESPONSE;
  answer.rcode = RCODE_ADDRESS_ERROR;
  std::uint32_t data = 0;
  const std::uint64_t offset = request.offset - kRegisterSpace;
  if (request.generation != bus_->generation()) {
    answer.rcode = RCODE_GENERATION;
  } else if (camera_ == nullptr || request.length != 4) {
    answer.rcode = RCODE_TYPE_ERROR;
  } else if (request.tcode == TCODE_READ_QUADLET_REQUEST) {
    if (const auto value = camera_->read(offset)) {
      answer.rcode = RCODE_COMPLETE;
      answer.length = 4;
      data = htonl(*value);
    }
  } else if (request.tcode == TCODE_WRITE_QUADLET_REQUEST) {
    CameraRegisters& registers = camera_->registers();
    const bool was_sending = registers.transmitting();
    const std::uint32_t value = ntohl(*pointer<std::uint32_t>(request.data));
    if (registers.write(offset, value)) answer.rcode = RCODE_COMPLETE;
    if (!was_sending && registers.transmitting()) {
      camera_->stalled = false;
      camera_->next_frame_us = -1;
    }
    bus_->changed().notify_all();
  }
  constexpr std::size_t head_bytes = offsetof(fw_cdev_event_response, data);
  std::array<char, head_bytes + sizeof data> event{};
  std::memcpy(event.data(), &answer, head_bytes);
  std::memcpy(event.data() + head_bytes, &data, sizeof data);
  send_event(event.data(), event.size());
  return 0;
}

int Client::allocate(void* argument) {
  auto request = from_user<fw_cdev_allocate_iso_resource>(argument);
  Resource resource;
  resource.closure = request.closure;
  const bool fits = bus_->take_bandwidth(static_cast<int>(request.bandwidth));
  if (fits) {
    resource.bandwidth = static_cast<int>(request.bandwidth);
    resource.channel = bus_->take_channel(request.channels);
    if (request.channels != 0 && resource.channel < 0) {
      bus_->give_back(-1, resource.bandwidth);
      resource.bandwidth = 0;
    }
  }
  request.handle = next_handle_++;
  fw_cdev_event_iso_resource event{};
  event.closure = request.closure;
  event.type = FW_CDEV_EVENT_ISO_RESOURCE_ALLOCATED;
  event.handle = request.handle;
  // Without enough bandwidth the kernel keeps neither.
  event.channel = resource.channel;
  event.bandwidth = resource.bandwidth;
  resources_[request.handle] = resource;
  std::memcpy(argument, &request, sizeof request);
  send_event(&event, sizeof event);
  return 0;
}

int Client::deallocate(const void* argument) {
  // The program may hand over the longer structure of the allocation: its handle is what counts.
  const auto request = from_user<fw_cdev_deallocate>(argument);
  auto found = resources_.find(request.handle);
  if (found == resources_.end()) return -EINVAL;
  fw_cdev_event_iso_resource event{};
  event.closure = found->second.closure;
  event.type = FW_CDEV_EVENT_ISO_RESOURCE_DEALLOCATED;
  event.handle = request.handle;
  event.channel = found->second.channel;
  event.bandwidth = found->second.bandwidth;
  bus_->give_back(found->second.channel, found->second.bandwidth);
  resources_.erase(found);
  send_event(&event, sizeof event);
  return 0;
}

int Client::queue(const void* argument) {
  const auto request = from_user<fw_cdev_queue_iso>(argument);
  Buffer buffer;
  buffer.address = request.data;
  const auto* packet = pointer<const std::uint32_t>(request.packets);
  for (std::size_t i = 0; i < request.size / 4; ++i) {
    buffer.bytes += packet[i] & 0xFFFFU;
    buffer.packets += (packet[i] >> 24) / 8;  // eight bytes of header a packet
  }
  queue_.push_back(buffer);
  bus_->changed().notify_all();
  return 0;
}

int Client::control(unsigned long request, void* argument) {
  std::unique_lock lock(bus_->mutex());
  if (gone_) return -ENODEV;
  switch (request) {
    case FW_CDEV_IOC_GET_INFO:
      return get_info(argument);
    case FW_CDEV_IOC_SEND_REQUEST:
      return send_request(argument);
    case FW_CDEV_IOC_INITIATE_BUS_RESET:
      bus_->reset_locked();
      return 0;
    case FW_CDEV_IOC_GET_CYCLE_TIMER: {
      const fw_cdev_get_cycle_timer timer{static_cast<std::uint64_t>(bus_->now_us()),
                                          bus_->cycle_timer()};
      std::memcpy(argument, &timer, sizeof timer);
      return 0;
    }
    case FW_CDEV_IOC_ALLOCATE_ISO_RESOURCE:
      return allocate(argument);
    case FW_CDEV_IOC_DEALLOCATE_ISO_RESOURCE:
      return deallocate(argument);
    case FW_CDEV_IOC_CREATE_ISO_CONTEXT: {
      auto context = from_user<fw_cdev_create_iso_context>(argument);
      if (receives_) return -EBUSY;
      receives_ = true;
      channel_ = static_cast<int>(context.channel);
      iso_closure_ = context.closure;
      context.handle = 0;
      std::memcpy(argument, &context, sizeof context);
      return 0;
    }
    case FW_CDEV_IOC_QUEUE_ISO:
      return queue(argument);
    case FW_CDEV_IOC_START_ISO:
      return start();
    case FW_CDEV_IOC_STOP_ISO:
      stop_receiving(lock);
      return 0;
    default:
      return -ENOTTY;
  }
}

void* Client::map(std::size_t length) {
  void* memory = reinterpret_cast<void*>(syscall(SYS_mmap, nullptr, length, PROT_READ | PROT_WRITE,
                                                 MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  return memory;
}

void Client::shut_down() {
  std::unique_lock lock(bus_->mutex());
  stop_receiving(lock);
  for (const auto& [handle, resource] : resources_) {
    bus_->give_back(resource.channel, resource.bandwidth);
  }
  resources_.clear();
}

}  // namespace anneal6d::emulated
