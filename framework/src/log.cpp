// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/log.h"

#include <mutex>
#include <utility>

namespace anneal6d {
namespace {

std::mutex sink_mutex;
LogSink& current_sink() {
  static LogSink sink;
  return sink;
}

}  // namespace

void set_log_sink(LogSink sink) {
  const std::lock_guard lock(sink_mutex);
  current_sink() = std::move(sink);
}

void log(LogLevel level, std::string_view message) {
  const std::lock_guard lock(sink_mutex);
  if (const LogSink& sink = current_sink()) sink(level, message);
}

}  // namespace anneal6d
