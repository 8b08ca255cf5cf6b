// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <string>

namespace anneal6d {

/// An OpenGL 3.3 core context without window, display server or GPU, made through EGL. Any number
/// of them may exist in a process. One may be used from any thread, but from one thread at a time;
/// two contexts may be in use on two threads at once.
class HeadlessContext {
 public:
  /// Throws BackendUnavailable (no EGL driver offers such a context, see
  /// `headless_opengl_unavailable_reason`) or GraphicsError (the driver failed to make another
  /// one).
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  /// Makes the context current on the calling thread for as long as it lives; then whatever was
  /// current before is so again, so that the next user may be another thread. May be nested.
  class [[nodiscard]] Current {
   public:
    /// Throws GraphicsError: the context is current on another thread, or the thread holds one of
    /// another window system (GLX).
    explicit Current(const HeadlessContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

   private:
    bool switched_ = false;
    unsigned previous_api_ = 0;
    void* previous_display_ = nullptr;
    void* previous_context_ = nullptr;
    void* previous_draw_surface_ = nullptr;
    void* previous_read_surface_ = nullptr;
  };

  /// Who draws, for people: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5".
  std::string description() const;

 private:
  void* context_ = nullptr;
};

/// Empty if a HeadlessContext can be made on this machine; otherwise why not and what to do. Found
/// out once in a process; thread safe.
const std::string& headless_opengl_unavailable_reason();

}  // namespace anneal6d
