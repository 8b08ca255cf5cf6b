// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "gl_name.h"

#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {

void check_gl(const char* doing) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  throw GraphicsError(
      std::string("OpenGL failed while ") + doing +
      (error == GL_OUT_OF_MEMORY ? ": out of memory" : ": error " + std::to_string(error)));
}

}  // namespace anneal6d
