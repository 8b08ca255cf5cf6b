// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include "evaluation_run.h"
#include "reliability.h"
#include "svg_plot.h"

namespace anneal6d {

// The diagrams of report.html. Errors beyond a few times the limit of success are cut off, so that
// one lost frame does not flatten all others; the title tells the largest.

/// Estimate minus truth along each axis of the camera, over the frames.
Plot translation_plot(const SequenceEvaluation& evaluation);

/// Error of the rotation over the frames.
Plot rotation_plot(const SequenceEvaluation& evaluation);

/// Quality over the frames; frames that the tracker called lost are shaded, restarts marked.
Plot quality_plot(const SequenceEvaluation& evaluation);

/// Milliseconds of `track()` over the frames, with median and 95 % quantile.
Plot time_plot(const SequenceEvaluation& evaluation);

/// Share of frames whose translation is off by less than a threshold, over thresholds up to
/// kSuccess_mm; and the same of the rotation, up to kSuccess_deg.
Plot translation_success_plot(const SequenceEvaluation& evaluation);
Plot rotation_success_plot(const SequenceEvaluation& evaluation);

/// Share of right frames over quality, with the diagonal on which the quality is a probability.
Plot reliability_plot(const Reliability& reliability);

/// How many frames each bin of `reliability_plot` has.
Plot reliability_count_plot(const Reliability& reliability);

}  // namespace anneal6d
