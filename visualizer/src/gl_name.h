// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace anneal6d {

/// Owns one OpenGL object. Made and destroyed while its context is current; without any context the
/// destruction does nothing, and the object goes with its context.
template <void (*Delete)(GLuint)>
class GlName {
 public:
  explicit GlName(GLuint name = 0) : name_(name) {}
  ~GlName() {
    if (name_ != 0) Delete(name_);
  }
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GLuint get() const { return name_; }

 private:
  GLuint name_;
};

// libepoxy's entry points are macros over run-time pointers, which cannot be template arguments.
inline void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void delete_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
inline void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void delete_shader(GLuint name) { glDeleteShader(name); }
inline void delete_program(GLuint name) { glDeleteProgram(name); }

using GlBuffer = GlName<delete_buffer>;
using GlVertexArray = GlName<delete_vertex_array>;
using GlTexture = GlName<delete_texture>;
using GlRenderbuffer = GlName<delete_renderbuffer>;
using GlFramebuffer = GlName<delete_framebuffer>;
using GlShader = GlName<delete_shader>;
using GlProgram = GlName<delete_program>;

/// Throws GraphicsError if OpenGL recorded an error since the last check; `doing` is for the
/// message.
void check_gl(const char* doing);

}  // namespace anneal6d
