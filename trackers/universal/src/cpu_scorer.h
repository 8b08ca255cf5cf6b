// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <memory>

#include "anneal6d/framework/pose_scorer.h"

namespace anneal6d {

/// The exact scorer without OpenGL: draws each pose into the object's part of the image only and
/// counts edge pixels on the way; poses are spread over the threads of `setup`.
std::unique_ptr<PoseScorer> make_cpu_scorer(const ScorerSetup& setup);

}  // namespace anneal6d
