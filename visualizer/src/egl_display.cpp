// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "egl_display.h"

#include <EGL/eglext.h>

#include <array>
#include <string_view>
#include <vector>

namespace anneal6d {
namespace {

bool has_extension(EGLDisplay display, std::string_view name) {
  const char* text = eglQueryString(display, EGL_EXTENSIONS);
  if (text == nullptr) return false;
  const std::string list = ' ' + std::string(text) + ' ';
  return list.find(' ' + std::string(name) + ' ') != std::string::npos;
}

/// Tries to use `candidate`; on failure the result says why not, naming it `name`.
EglDisplay try_display(EGLDisplay candidate, const std::string& name) {
  EglDisplay display;
  EGLint major = 0;
  EGLint minor = 0;
  if (candidate == EGL_NO_DISPLAY) {
    display.why_not = name + ": no such display";
  } else if (!eglInitialize(candidate, &major, &minor)) {
    display.why_not = name + ": no driver (" + egl_error_text() + ")";
  } else if (major == 1 && minor < 5) {
    display.why_not = name + ": EGL 1." + std::to_string(minor) + " is older than 1.5";
  } else if (!has_extension(candidate, "EGL_KHR_surfaceless_context")) {
    display.why_not = name + ": no contexts without a surface";
  } else {
    const std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                          EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    EGLContext probe = EGL_NO_CONTEXT;
    if (eglChooseConfig(candidate, wanted.data(), &display.config, 1, &count) && count == 1) {
      probe = create_core_context(candidate, display.config);
    }
    if (probe == EGL_NO_CONTEXT) {
      display.why_not = name + ": no OpenGL 3.3 core (" + egl_error_text() + ")";
    } else {
      eglDestroyContext(candidate, probe);
      display.handle = candidate;
    }
  }
  return display;
}

std::vector<EGLDeviceEXT> enumerate_devices() {
  if (!has_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base") &&
      !has_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    return {};
  }
  const auto query =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  EGLint count = 0;
  if (query == nullptr || !query(0, nullptr, &count) || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (!query(count, devices.data(), &count)) return {};
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

/// The first of these that works: Mesa without any surface, the graphics devices in the driver's
/// order, whatever the system calls its default display.
EglDisplay open_display() {
  std::string reasons;
  EglDisplay display;
  const auto works = [&](EGLDisplay candidate, const std::string& name) {
    display = try_display(candidate, name);
    if (!display.why_not.empty()) reasons += (reasons.empty() ? "" : "; ") + display.why_not;
    return display.why_not.empty();
  };

  if (has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") &&
      works(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
            "surfaceless")) {
    return display;
  }
  const std::vector<EGLDeviceEXT> devices = enumerate_devices();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (works(eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr),
              "device " + std::to_string(i))) {
      return display;
    }
  }
  if (works(eglGetDisplay(EGL_DEFAULT_DISPLAY), "default display")) return display;

  display.why_not = "EGL offers no OpenGL 3.3 core context without a window (" + reasons +
                    "); install a driver, on Debian: apt install libegl-mesa0 libgl1-mesa-dri";
  return display;
}

}  // namespace

EGLContext create_core_context(EGLDisplay display, EGLConfig config) {
  const std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                            3,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            3,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
  // The API is a state of the thread, and OpenGL ES by default: put it back for other users.
  const EGLenum previous_api = eglQueryAPI();
  if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
  // Binding again would overwrite the error that the caller wants to report.
  if (context != EGL_NO_CONTEXT) eglBindAPI(previous_api);
  return context;
}

std::string egl_error_text() {
  const EGLint code = eglGetError();
  switch (code) {
    case EGL_SUCCESS:
      return "no reason given";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
      return "EGL_BAD_CONTEXT";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    default:
      return "EGL error " + std::to_string(code);
  }
}

const EglDisplay& shared_egl_display() {
  static const EglDisplay display = open_display();
  return display;
}

}  // namespace anneal6d
