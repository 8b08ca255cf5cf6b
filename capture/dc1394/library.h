// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <dc1394/dc1394.h>

#include <memory>
#include <string>

namespace anneal6d::dc1394 {

/// A session with libdc1394. Its messages go to our log.
class Library {
 public:
  /// Throws BackendUnavailable: libdc1394 can't be started.
  Library();
  dc1394_t* get() const { return session_.get(); }

 private:
  struct Free {
    void operator()(dc1394_t* session) const { dc1394_free(session); }
  };
  std::unique_ptr<dc1394_t, Free> session_;
};

/// Throws CaptureError "CAMERA: can't ACTION: what the library says" unless `result` is success.
void check(dc1394error_t result, const std::string& camera, const std::string& action);

}  // namespace anneal6d::dc1394
