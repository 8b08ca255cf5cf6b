// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/headless_context.h"

#include <epoxy/gl.h>

#include "anneal6d/framework/error.h"
#include "egl_display.h"

namespace anneal6d {

HeadlessContext::HeadlessContext() {
  const EglDisplay& display = shared_egl_display();
  if (!display.why_not.empty()) throw BackendUnavailable(display.why_not);
  context_ = create_core_context(display.handle, display.config);
  if (context_ == EGL_NO_CONTEXT) {
    throw GraphicsError("cannot make an OpenGL context (" + egl_error_text() +
                        "); too many may be open in this process");
  }
}

HeadlessContext::~HeadlessContext() { eglDestroyContext(shared_egl_display().handle, context_); }

std::string HeadlessContext::description() const {
  const Current current(*this);
  const int version = epoxy_gl_version();
  return std::string(reinterpret_cast<const char*>(glGetString(GL_RENDERER))) + ", OpenGL " +
         std::to_string(version / 10) + '.' + std::to_string(version % 10);
}

HeadlessContext::Current::Current(const HeadlessContext& context) : previous_api_(eglQueryAPI()) {
  eglBindAPI(EGL_OPENGL_API);
  previous_context_ = eglGetCurrentContext();
  if (previous_context_ == context.context_) {
    eglBindAPI(previous_api_);
    return;
  }
  previous_display_ = eglGetCurrentDisplay();
  previous_draw_surface_ = eglGetCurrentSurface(EGL_DRAW);
  previous_read_surface_ = eglGetCurrentSurface(EGL_READ);
  if (!eglMakeCurrent(shared_egl_display().handle, EGL_NO_SURFACE, EGL_NO_SURFACE,
                      context.context_)) {
    const std::string reason = egl_error_text();
    eglBindAPI(previous_api_);
    throw GraphicsError("cannot use the OpenGL context on this thread (" + reason +
                        "): another thread is using it, or this thread holds a context of another "
                        "window system");
  }
  switched_ = true;
}

HeadlessContext::Current::~Current() {
  if (!switched_) return;
  if (previous_context_ == EGL_NO_CONTEXT) {
    eglMakeCurrent(shared_egl_display().handle, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  } else {
    eglMakeCurrent(previous_display_, previous_draw_surface_, previous_read_surface_,
                   previous_context_);
  }
  eglBindAPI(previous_api_);
}

const std::string& headless_opengl_unavailable_reason() { return shared_egl_display().why_not; }

}  // namespace anneal6d
