// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <set>
#include <string>

namespace anneal6d {

/// Gives `command`, already parsed, the options that the TOML file names and the command line does
/// not, and returns their names. Keys are the options' names without dashes, at the top level of
/// the file. Throws FileError if the file cannot be read and ConfigError naming file and key for an
/// unknown key, one given twice, and a value of the wrong type.
std::set<std::string> apply_config_file(CLI::App& command, const std::filesystem::path& path);

}  // namespace anneal6d
