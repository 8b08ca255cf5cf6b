// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// Stands before libc: calls that concern /dev/fw* go to the emulated bus, all others on to libc
// (or to the sanitizer that is next in line). Linked into a test program, or loaded with
// LD_PRELOAD.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/types.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "client.h"
#include "emulated_bus.h"

namespace {

using anneal6d::emulated::Client;
using anneal6d::emulated::EmulatedBus;

constexpr std::string_view kDevicePrefix = "/dev/fw";

// Which descriptors are emulated: asked in every read and close of the program, so without a lock.
constexpr std::size_t kMostDescriptors = 4096;
std::array<std::atomic<bool>, kMostDescriptors> emulated_descriptors;

bool is_emulated(int fd) {
  return fd >= 0 && static_cast<std::size_t>(fd) < kMostDescriptors &&
         emulated_descriptors[static_cast<std::size_t>(fd)].load(std::memory_order_acquire);
}

// A function of the next in line. Without the guard of a local static: some of these are called
// before a sanitizer is ready for guards.
struct Next {
  const char* name;
  std::atomic<void*> address{nullptr};

  template <class Function>
  Function* as() {
    void* found = address.load(std::memory_order_relaxed);
    if (found == nullptr) {
      found = dlsym(RTLD_NEXT, name);
      address.store(found, std::memory_order_relaxed);
    }
    return reinterpret_cast<Function*>(found);
  }
};
constinit Next next_open{"open"}, next_close{"close"}, next_read{"read"}, next_ioctl{"ioctl"},
    next_mmap{"mmap"}, next_opendir{"opendir"}, next_readdir{"readdir"}, next_closedir{"closedir"};

int open_device(const char* path) {
  const int fd = EmulatedBus::instance().open(path + std::strlen("/dev/"));
  if (fd >= 0 && static_cast<std::size_t>(fd) < kMostDescriptors) {
    emulated_descriptors[static_cast<std::size_t>(fd)].store(true, std::memory_order_release);
  }
  return fd;
}

bool is_device(const char* path) { return std::string_view(path).starts_with(kDevicePrefix); }

// A listing of /dev that is under way: first the emulated entries, then libc's but for its own fw*.
struct Listing {
  std::vector<dirent> entries;
  std::size_t at = 0;
};

std::atomic<int> listings_under_way = 0;

std::mutex& listings_mutex() {
  static auto* mutex = new std::mutex;
  return *mutex;
}

std::map<DIR*, Listing>& listings() {
  static auto* map = new std::map<DIR*, Listing>;
  return *map;
}

dirent* next_emulated_entry(DIR* folder, bool& listed) {
  if (listings_under_way.load() == 0) return nullptr;
  const std::lock_guard lock(listings_mutex());
  const auto found = listings().find(folder);
  listed = found != listings().end();
  if (!listed || found->second.at == found->second.entries.size()) return nullptr;
  return &found->second.entries[found->second.at++];
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & (O_CREAT | O_TMPFILE)) != 0) {
    va_list arguments;
    va_start(arguments, flags);
    mode = va_arg(arguments, mode_t);
    va_end(arguments);
  }
  if (is_device(path)) return open_device(path);
  return next_open.as<int(const char*, int, ...)>()(path, flags, mode);
}

int close(int fd) {
  if (is_emulated(fd)) {
    emulated_descriptors[static_cast<std::size_t>(fd)].store(false, std::memory_order_release);
    EmulatedBus::instance().close(fd);
    return 0;
  }
  return next_close.as<int(int)>()(fd);
}

ssize_t read(int fd, void* buffer, size_t bytes) {
  const ssize_t got = next_read.as<ssize_t(int, void*, size_t)>()(fd, buffer, bytes);
  if (got == 0 && is_emulated(fd)) {  // the device was unplugged
    errno = ENODEV;
    return -1;
  }
  return got;
}

int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (is_emulated(fd)) {
    const std::shared_ptr<Client> client = EmulatedBus::instance().client(fd);
    const int result = client ? client->control(request, argument) : -EBADF;
    if (result >= 0) return result;
    errno = -result;
    return -1;
  }
  return next_ioctl.as<int(int, unsigned long, ...)>()(fd, request, argument);
}

void* mmap(void* address, size_t length, int protection, int flags, int fd, off_t offset) noexcept {
  if (is_emulated(fd)) {
    const std::shared_ptr<Client> client = EmulatedBus::instance().client(fd);
    return client ? client->map(length) : MAP_FAILED;
  }
  return next_mmap.as<void*(void*, size_t, int, int, int, off_t)>()(address, length, protection,
                                                                    flags, fd, offset);
}

DIR* opendir(const char* path) {
  DIR* folder = next_opendir.as<DIR*(const char*)>()(path);
  if (folder == nullptr || std::string_view(path) != "/dev") return folder;
  Listing listing;
  for (const std::string& name : EmulatedBus::instance().node_names()) {
    dirent entry{};
    entry.d_ino = 1;
    entry.d_type = DT_CHR;
    name.copy(entry.d_name, sizeof entry.d_name - 1);
    listing.entries.push_back(entry);
  }
  const std::lock_guard lock(listings_mutex());
  listings()[folder] = std::move(listing);
  ++listings_under_way;
  return folder;
}

dirent* readdir(DIR* folder) {
  bool listed = false;
  if (dirent* entry = next_emulated_entry(folder, listed)) return entry;
  auto* next = next_readdir.as<dirent*(DIR*)>();
  dirent* entry = next(folder);
  while (listed && entry != nullptr && std::string_view(entry->d_name).starts_with("fw")) {
    entry = next(folder);
  }
  return entry;
}

int closedir(DIR* folder) {
  if (listings_under_way.load() > 0) {
    const std::lock_guard lock(listings_mutex());
    listings_under_way -= static_cast<int>(listings().erase(folder));
  }
  return next_closedir.as<int(DIR*)>()(folder);
}

}  // extern "C"
