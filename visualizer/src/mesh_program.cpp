// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "mesh_program.h"

#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position_mm;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec3 albedo_bgr;

uniform mat4 clip_from_camera;
uniform mat3 rotation;
uniform vec3 translation_mm;
uniform vec3 to_light;
uniform float ambient;
uniform float diffuse;

// color * w, interpolated perspectively and divided by w at the pixel, is linear in the image. That
// is what `noperspective` stands for, but with it Mesa (22.3) is several grey levels off in large
// triangles that it clips at the image's border.
out Corner {
  vec3 color_w;
  vec2 uv;
} corner;
out vec3 vertex_color;  // for the clipping stage

void main() {
  float light = min(1.0, ambient + diffuse * abs(dot(rotation * normal, to_light)));
  gl_Position = clip_from_camera * vec4(rotation * position_mm + translation_mm, 1.0);
  vertex_color = albedo_bgr.bgr * light;
  corner.color_w = vertex_color * gl_Position.w;
  corner.uv = uv;
}
)";

// Sutherland-Hodgman at the near plane; w is the depth in the camera frame. What is left, three or
// four corners in the triangle's order, is drawn as a fan from the first.
constexpr const char* kClippingShader = R"(#version 330 core
layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;

uniform float near_mm;

in Corner {
  vec3 color_w;
  vec2 uv;
} vertex[3];
in vec3 vertex_color[3];

out Corner {
  vec3 color_w;
  vec2 uv;
} corner;

void main() {
  vec4 position[4];
  vec3 color[4];
  vec2 uv[4];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    int next = (i + 1) % 3;
    float here = gl_in[i].gl_Position.w - near_mm;
    float there = gl_in[next].gl_Position.w - near_mm;
    if (here >= 0.0) {
      position[count] = gl_in[i].gl_Position;
      color[count] = vertex_color[i];
      uv[count] = vertex[i].uv;
      ++count;
    }
    if ((here >= 0.0) != (there >= 0.0)) {
      float t = here / (here - there);
      position[count] = mix(gl_in[i].gl_Position, gl_in[next].gl_Position, t);
      color[count] = mix(vertex_color[i], vertex_color[next], t);
      uv[count] = mix(vertex[i].uv, vertex[next].uv, t);
      ++count;
    }
  }
  const int fan_as_strip[4] = int[4](1, 2, 0, 3);
  for (int i = 0; i < count; ++i) {
    int k = fan_as_strip[i];
    gl_Position = position[k];
    corner.color_w = color[k] * position[k].w;
    corner.uv = uv[k];
    EmitVertex();
  }
  EndPrimitive();
}
)";

constexpr const char* kFragmentShader = R"(#version 330 core
uniform sampler2D albedo_texture;

in Corner {
  vec3 color_w;
  vec2 uv;
} corner;

layout(location = 0) out vec4 color;
layout(location = 1) out float depth_mm;

void main() {
  color = vec4(corner.color_w * gl_FragCoord.w * texture(albedo_texture, corner.uv).rgb, 1.0);
  depth_mm = 1.0 / gl_FragCoord.w;
}
)";

void attach(const GlProgram& program, GLenum stage, const char* source) {
  const GlShader shader(glCreateShader(stage));
  glShaderSource(shader.get(), 1, &source, nullptr);
  glCompileShader(shader.get());
  glAttachShader(program.get(), shader.get());
}

void link(const GlProgram& program) {
  glLinkProgram(program.get());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.get(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  std::string log(2000, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(program.get(), static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  throw GraphicsError("the OpenGL driver refused the mesh shaders: " + log);
}

}  // namespace

MeshProgram::MeshProgram(bool clips) : program_(glCreateProgram()) {
  attach(program_, GL_VERTEX_SHADER, kVertexShader);
  if (clips) attach(program_, GL_GEOMETRY_SHADER, kClippingShader);
  attach(program_, GL_FRAGMENT_SHADER, kFragmentShader);
  link(program_);
  const auto locate = [this](const char* name) {
    return glGetUniformLocation(program_.get(), name);
  };
  clip_from_camera_ = locate("clip_from_camera");
  rotation_ = locate("rotation");
  translation_mm_ = locate("translation_mm");
  to_light_ = locate("to_light");
  ambient_ = locate("ambient");
  diffuse_ = locate("diffuse");
  if (clips) {
    glUseProgram(program_.get());
    glUniform1f(locate("near_mm"), static_cast<float>(kNearPlane_mm));
  }
}

void MeshProgram::use(const Eigen::Matrix4f& clip_from_camera,
                      const Eigen::Matrix3f& camera_from_object,
                      const Eigen::Vector3f& translation_mm, const Shading& shading) const {
  glUseProgram(program_.get());
  glUniformMatrix4fv(clip_from_camera_, 1, GL_FALSE, clip_from_camera.data());
  glUniformMatrix3fv(rotation_, 1, GL_FALSE, camera_from_object.data());
  glUniform3fv(translation_mm_, 1, translation_mm.data());
  glUniform3fv(to_light_, 1, shading.to_light.data());
  glUniform1f(ambient_, shading.ambient);
  glUniform1f(diffuse_, shading.diffuse);
}

}  // namespace anneal6d
