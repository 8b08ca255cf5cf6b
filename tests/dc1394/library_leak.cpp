// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// libdc1394 2.2.6 can't stop the capture of a device that was unplugged: it returns before it frees
// what it allocated for the ring, and offers no other way to have that freed.
#ifdef __SANITIZE_ADDRESS__

extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:dc1394_juju_capture_setup\n";
}

#endif
