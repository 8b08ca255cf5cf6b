// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <memory>

#include "anneal6d/framework/pose_scorer.h"
#include "view_model.h"

namespace anneal6d {

/// The views of a scorer's model: those that something in this program uses already; else those of
/// an earlier run, from `setup.view_cache`; else made now, with news for `setup.progress`, and kept
/// there. A cache that cannot be read or written is no error: views are made again. Thread safe.
std::shared_ptr<const ViewModel> view_model_of(const ScorerSetup& setup);

}  // namespace anneal6d
