// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <functional>
#include <string_view>

namespace anneal6d {

enum class LogLevel { debug, info, warning, error };

/// Receives every message of the library. Called from any thread, one call at a time.
using LogSink = std::function<void(LogLevel, std::string_view message)>;

/// Replaces the sink; an empty one silences the library. The default sink discards everything.
void set_log_sink(LogSink sink);

/// Hands a message to the current sink. Thread safe.
void log(LogLevel level, std::string_view message);

}  // namespace anneal6d
