// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "library.h"

#include <mutex>
#include <string_view>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"

namespace anneal6d::dc1394 {
namespace {

// Whatever concerns the user is thrown by us with more detail.
void hand_on(dc1394log_t, const char* message, void*) {
  std::string_view text = message;
  while (text.ends_with('\n')) text.remove_suffix(1);
  log(LogLevel::debug, "libdc1394: " + std::string(text));
}

void redirect_messages() {
  static std::once_flag once;
  std::call_once(once, [] {
    for (const dc1394log_t kind : {DC1394_LOG_ERROR, DC1394_LOG_WARNING}) {
      dc1394_log_register_handler(kind, hand_on, nullptr);
    }
  });
}

}  // namespace

Library::Library() {
  redirect_messages();
  session_.reset(dc1394_new());
  if (!session_) throw BackendUnavailable("libdc1394 can't be started; is memory short?");
}

void check(dc1394error_t result, const std::string& camera, const std::string& action) {
  if (result == DC1394_SUCCESS) return;
  throw CaptureError(camera + ": can't " + action + ": " + dc1394_error_get_string(result));
}

}  // namespace anneal6d::dc1394
