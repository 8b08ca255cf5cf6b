// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/visualizer/reference_scorer.h"

#include <cassert>
#include <opencv2/imgproc.hpp>

#include "anneal6d/visualizer/headless_context.h"

namespace anneal6d {
namespace {

const ScorerSetup& checked(const ScorerSetup& setup) {
  setup.validate();
  return setup;
}

}  // namespace

ReferenceScorer::ReferenceScorer(const ScorerSetup& setup)
    : renderer_(checked(setup).mesh, setup.camera, setup.textured),
      edge_options_(setup.edges),
      shading_(setup.shading),
      frame_edges_(cv::Mat::zeros(setup.camera.height_px, setup.camera.width_px, CV_8UC1)) {}

void ReferenceScorer::set_edges(const EdgeImage& edges) {
  check_edge_image(edges, frame_edges_.size());
  frame_edges_ = edges.binary;
}

void ReferenceScorer::score(std::span<const Pose> camera_from_object,
                            std::span<EdgeMatch> matches) {
  assert(camera_from_object.size() == matches.size());
  for (std::size_t i = 0; i < camera_from_object.size(); ++i) {
    renderer_.render_color(camera_from_object[i], shading_, color_);  // thesis Fig. 4.5
    cv::cvtColor(color_, grey_, cv::COLOR_BGR2GRAY);                  // thesis 4.2.2
    edge_detector_.detect(grey_, edge_options_, rendered_);           // thesis Fig. 4.6
    cv::bitwise_and(rendered_.binary, frame_edges_, matched_);        // thesis Fig. 4.7
    matches[i] = {cv::countNonZero(rendered_.binary), cv::countNonZero(matched_)};  // thesis Alg. 4
  }
}

namespace visualizer {

ScorerTable scorer_plugins() {
  return {{"reference", "OpenGL rendering and OpenCV edges, pose by pose, as in the thesis",
           [] { return headless_opengl_unavailable_reason(); },
           [](const ScorerSetup& setup) { return std::make_unique<ReferenceScorer>(setup); }}};
}

}  // namespace visualizer
}  // namespace anneal6d
