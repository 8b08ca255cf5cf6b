// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <map>
#include <span>
#include <string>

#include "evaluation_run.h"

namespace anneal6d {

/// `report.html` of `evaluate`: one page that needs no other file and no network, for whoever
/// judges a tracker. `evaluations` is not empty; `options` are those of the run, as in
/// summary.json.
std::string html_report(std::span<const SequenceEvaluation> evaluations,
                        const std::map<std::string, std::string>& options);

}  // namespace anneal6d
