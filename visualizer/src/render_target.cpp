// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "render_target.h"

#include <opencv2/imgproc.hpp>
#include <string>

#include "anneal6d/framework/error.h"

namespace anneal6d {
namespace {

GlRenderbuffer make_renderbuffer(cv::Size size_px, GLenum format) {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  GlRenderbuffer renderbuffer(name);
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorage(GL_RENDERBUFFER, format, size_px.width, size_px.height);
  return renderbuffer;
}

GlFramebuffer make_framebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  return GlFramebuffer(name);
}

void attach(GLenum point, const GlRenderbuffer& renderbuffer) {
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, renderbuffer.get());
}

void check_complete() {
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw GraphicsError("the OpenGL driver cannot draw into memory (framebuffer status " +
                        std::to_string(status) + ")");
  }
}

cv::Size checked(cv::Size size_px) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
  if (size_px.width > limit || size_px.height > limit) {
    throw GraphicsError("an image of " + std::to_string(size_px.width) + "x" +
                        std::to_string(size_px.height) + " is larger than OpenGL's limit of " +
                        std::to_string(limit));
  }
  return size_px;
}

}  // namespace

RenderTarget::RenderTarget(cv::Size size_px)
    : size_px_(checked(size_px)),
      color_(make_renderbuffer(size_px, GL_RGBA8)),
      depth_mm_(make_renderbuffer(size_px, GL_R32F)),
      depth_test_(make_renderbuffer(size_px, GL_DEPTH_COMPONENT24)) {
  check_gl("making room for the image");

  color_only_ = make_framebuffer();
  attach(GL_COLOR_ATTACHMENT0, color_);
  attach(GL_DEPTH_ATTACHMENT, depth_test_);
  check_complete();

  color_and_depth_ = make_framebuffer();
  attach(GL_COLOR_ATTACHMENT0, color_);
  attach(GL_COLOR_ATTACHMENT1, depth_mm_);
  attach(GL_DEPTH_ATTACHMENT, depth_test_);
  const GLenum outputs[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(2, outputs);
  check_complete();
}

void RenderTarget::begin(bool with_depth) const {
  glBindFramebuffer(GL_FRAMEBUFFER, (with_depth ? color_and_depth_ : color_only_).get());
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void RenderTarget::read_color(cv::Mat& color_bgr) {
  color_rgba_.create(size_px_, CV_8UC4);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, size_px_.width, size_px_.height, GL_RGBA, GL_UNSIGNED_BYTE, color_rgba_.data);
  cv::cvtColor(color_rgba_, color_bgr, cv::COLOR_RGBA2BGR);
}

void RenderTarget::read_depth(cv::Mat& depth_mm) const {
  depth_mm.create(size_px_, CV_32FC1);
  const bool packed = depth_mm.isContinuous();
  cv::Mat whole = packed ? depth_mm : cv::Mat(size_px_, CV_32FC1);
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, size_px_.width, size_px_.height, GL_RED, GL_FLOAT, whole.data);
  if (!packed) whole.copyTo(depth_mm);
}

}  // namespace anneal6d
