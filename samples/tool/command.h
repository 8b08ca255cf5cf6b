// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace anneal6d {

/// A subcommand of the tool. `run` is called once its options are parsed and returns the exit
/// status; it throws ConfigError for wrong usage and anything else for failures.
struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

Command add_track_command(CLI::App& tool);
Command add_evaluate_command(CLI::App& tool);
Command add_simulate_command(CLI::App& tool);
Command add_record_command(CLI::App& tool);
Command add_list_command(CLI::App& tool);
Command add_bench_command(CLI::App& tool);

}  // namespace anneal6d
