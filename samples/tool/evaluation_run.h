// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "anneal6d/framework/pose_file.h"
#include "evaluation.h"
#include "evaluation_pictures.h"
#include "options.h"
#include "run_outputs.h"

namespace anneal6d {

enum class Protocol {
  free,  ///< the tracker is never reset
  rbot,  ///< after a failed frame it is reset to that frame's ground truth
};

/// "free", "rbot"; anything else throws ConfigError.
Protocol parse_protocol(std::string_view text);
std::string_view to_string(Protocol protocol);

struct EvaluationOptions {
  TrackingOptions tracking;
  OutputOptions outputs;  ///< of one sequence
  Protocol protocol = Protocol::free;
  std::string reference;  ///< poses to judge against; empty: the sequence's groundtruth.csv
  int jobs = 1;           ///< sequences at the same time
  bool pictures = false;  ///< some frames are wanted, drawn over
};

struct SequenceEvaluation {
  std::vector<PoseRow> rows;        ///< of all frames; the first was given
  std::vector<JudgedFrame> judged;  ///< those of them whose truth is known
  Summary summary;
  std::vector<EvaluationPicture> pictures;
};

/// Tracks each folder and judges it. The first frame's pose is given, from `--init` or the ground
/// truth, and thus not judged; neither are frames without ground truth. Throws Error if one
/// sequence fails or on Ctrl-C.
std::vector<SequenceEvaluation> evaluate_sequences(std::span<const std::string> folders,
                                                   std::span<const std::string> names,
                                                   const EvaluationOptions& options);

}  // namespace anneal6d
