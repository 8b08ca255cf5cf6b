// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// What ThreadSanitizer reports about libraries and not about us.
#ifdef __SANITIZE_THREAD__

// GDAL, which Debian's OpenCV asks about every image that it reads, takes its locks in two orders. OpenCV
// spreads Canny over threads of its own, whose synchronisation ThreadSanitizer does not see.
extern "C" const char* __tsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "deadlock:libgdal.so\nrace:libopencv_imgproc.so\nrace:libopencv_core.so\n";
}

#endif
