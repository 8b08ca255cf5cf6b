// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <gtest/gtest.h>

#include "anneal6d/visualizer/headless_context.h"

namespace anneal6d::test {

/// A test that is skipped, with the reason, where there is no OpenGL.
class OpenGlTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string& reason = headless_opengl_unavailable_reason(); !reason.empty()) {
      GTEST_SKIP() << reason;
    }
  }
};

}  // namespace anneal6d::test
