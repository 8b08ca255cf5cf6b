// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// The `anneal6d` tool: a table of subcommands, and what they have in common.

#include <cstdio>
#include <exception>
#include <set>
#include <string>

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/log.h"
#include "command.h"
#include "config_file.h"
#include "progress.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

/// A setting that a plugin refuses is named by its option; this adds the file it came from.
std::string with_origin(std::string message, const std::string& config,
                        const std::set<std::string>& keys_from_config) {
  for (const std::string& key : keys_from_config) {
    if (message.starts_with("--" + key + ":")) return config + ": " + message.substr(2);
  }
  if (!keys_from_config.empty()) message += " (" + config + " gives options, too)";
  return message;
}

/// CLI11 only says that a command is required, also when one was given that does not exist.
std::string explain(const CLI::ParseError& error, const CLI::App& tool, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  std::string names;
  for (const CLI::App* command : tool.get_subcommands({})) {
    if (command->get_name() == word) {
      return std::string(error.what()) + "; see anneal6d " + word + " --help";
    }
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  if (word.empty() || word.starts_with('-')) {
    return std::string(error.what()) + "; there are the commands " + names;
  }
  return "there is no command '" + word + "'; there are: " + names;
}

int run(const anneal6d::Command& command, const std::string& config) {
  std::set<std::string> keys_from_config;
  try {
    if (!config.empty()) keys_from_config = anneal6d::apply_config_file(*command.app, config);
    const int status = command.run();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw anneal6d::Error("standard output cannot be written");
    }
    return status;
  } catch (const anneal6d::ConfigError& error) {
    anneal6d::log(anneal6d::LogLevel::error, with_origin(error.what(), config, keys_from_config));
    return kWrongUsage;
  } catch (const std::exception& error) {
    anneal6d::log(anneal6d::LogLevel::error, error.what());
    return kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  anneal6d::log_to_stderr();

  CLI::App tool("Tracks known rigid objects in six degrees of freedom from one camera", "anneal6d");
  tool.require_subcommand(1);
  const std::string version = std::string("anneal6d ") + ANNEAL6D_VERSION;
  tool.set_version_flag("--version", version, "Print the version and exit");

  const anneal6d::Command commands[] = {
      anneal6d::add_track_command(tool),    anneal6d::add_evaluate_command(tool),
      anneal6d::add_simulate_command(tool), anneal6d::add_record_command(tool),
      anneal6d::add_list_command(tool),     anneal6d::add_bench_command(tool)};
  std::string config;
  for (const anneal6d::Command& command : commands) {
    command.app->set_version_flag("--version", version, "Print the version and exit")
        ->configurable(false);
    command.app->get_help_ptr()->configurable(false);
    command.app
        ->add_option("--config", config,
                     "Read options from this TOML file: their names without dashes; the command "
                     "line goes first")
        ->type_name("FILE")
        ->configurable(false);
  }

  try {
    tool.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return tool.exit(success);
  } catch (const CLI::ParseError& error) {
    anneal6d::log(anneal6d::LogLevel::error, explain(error, tool, argc, argv));
    return kWrongUsage;
  }
  for (const anneal6d::Command& command : commands) {
    if (command.app->parsed()) return run(command, config);
  }
  return kWrongUsage;  // not reached: a subcommand is required
}
