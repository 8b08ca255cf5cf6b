// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <EGL/egl.h>

#include <string>

namespace anneal6d {

/// The process's connection to an EGL driver that makes OpenGL 3.3 core contexts without a window.
/// EGL shares one display among all its users, and terminating it kills every context in the
/// process; therefore it is opened once and stays open.
struct EglDisplay {
  EGLDisplay handle = EGL_NO_DISPLAY;
  EGLConfig config = nullptr;
  std::string why_not;  ///< empty if it can be used
};

const EglDisplay& shared_egl_display();

/// An OpenGL 3.3 core context of the display, or EGL_NO_CONTEXT (then eglGetError says why).
EGLContext create_core_context(EGLDisplay display, EGLConfig config);

/// "EGL_BAD_ALLOC" of the last EGL call of this thread.
std::string egl_error_text();

}  // namespace anneal6d
