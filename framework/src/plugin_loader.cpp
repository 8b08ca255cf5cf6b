// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include <string>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/rigid_object_tracker.h"

#ifdef _WIN32
#define NOMINMAX
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace anneal6d {
namespace {

constexpr const char* kEntryPoint = "anneal6d_tracker_plugins";
using EntryPoint = void (*)(TrackerTable&);

#ifdef _WIN32
EntryPoint entry_point_of(const std::filesystem::path& path) {
  const HMODULE library = LoadLibraryW(path.c_str());
  if (!library) {
    throw FileError(path, "", "cannot be loaded, Windows error " + std::to_string(GetLastError()));
  }
  return reinterpret_cast<EntryPoint>(
      reinterpret_cast<void*>(GetProcAddress(library, kEntryPoint)));
}
#else
EntryPoint entry_point_of(const std::filesystem::path& path) {
  // An absolute path keeps dlopen from searching the system's folders for a bare file name.
  void* const library = dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    const char* const reason = dlerror();
    throw FileError(path, "",
                    std::string("cannot be loaded: ") + (reason ? reason : "no reason given"));
  }
  return reinterpret_cast<EntryPoint>(dlsym(library, kEntryPoint));
}
#endif

}  // namespace

TrackerTable load_tracker_plugins(const std::filesystem::path& path) {
  const EntryPoint fill = entry_point_of(path);
  if (!fill) {
    throw ConfigError(path.string() + " is no tracker plugin: it does not export " + kEntryPoint);
  }
  TrackerTable table;
  fill(table);
  return table;
}

}  // namespace anneal6d
