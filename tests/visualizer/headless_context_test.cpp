// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/headless_context.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <thread>

#include "anneal6d/framework/error.h"
#include "opengl_test.h"

namespace anneal6d {
namespace {

using HeadlessContextTest = test::OpenGlTest;

TEST_F(HeadlessContextTest, SaysWhoDraws) {
  EXPECT_NE(HeadlessContext().description().find("OpenGL "), std::string::npos);
}

TEST_F(HeadlessContextTest, MayBeNestedWithAnother) {
  const HeadlessContext first;
  const HeadlessContext second;
  const HeadlessContext::Current outer(first);
  {
    const HeadlessContext::Current inner(second);
    const HeadlessContext::Current again(second);
  }
  // `first` is current again, so that no other thread can have it.
  bool refused = false;
  std::thread([&] {
    try {
      const HeadlessContext::Current current(first);
    } catch (const GraphicsError&) {
      refused = true;
    }
  }).join();
  EXPECT_TRUE(refused);
}

TEST_F(HeadlessContextTest, GoesFromThreadToThread) {
  const HeadlessContext context;
  { const HeadlessContext::Current here(context); }
  std::thread([&] { EXPECT_NO_THROW(HeadlessContext::Current{context}); }).join();
  EXPECT_NO_THROW(HeadlessContext::Current{context});
}

TEST(HeadlessContextDeathTest, WithoutADriverSaysWhatIsMissing) {
  // A process of its own, in which EGL finds no driver.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
        unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
        try {
          HeadlessContext();
        } catch (const BackendUnavailable& error) {
          std::cerr << error.what();
          std::_Exit(headless_opengl_unavailable_reason() == error.what() ? 3 : 4);
        }
        std::_Exit(5);
      },
      testing::ExitedWithCode(3), "EGL offers no OpenGL 3.3.*apt install");
}

}  // namespace
}  // namespace anneal6d
