// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "config_file.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "anneal6d/framework/atomic_file.h"
#include "anneal6d/framework/error.h"

namespace anneal6d {

namespace {

constexpr std::size_t kLargestConfig_bytes = 1 << 20;

/// CLI11's reader accepts an unfinished string and hands its quote on.
bool has_stray_quote(const std::string& value) {
  return !value.empty() && (value.front() == '"' || value.back() == '"');
}

/// Keys of a file that is no TOML may hold anything; a message shows only what prints.
std::string printable(std::string text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c >= 0x7F; }, '?');
  return text;
}

std::string known_keys(const CLI::App& command) {
  std::string keys;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_configurable() || option->get_lnames().empty()) continue;
    keys += (keys.empty() ? "" : ", ") + option->get_lnames().front();
  }
  return keys;
}

}  // namespace

// CLI11 2.1 reads a configuration file only for the top-level application and its errors name
// neither file nor, for values, key: so its reader is used here, but not its dispatch.
std::set<std::string> apply_config_file(CLI::App& command, const std::filesystem::path& path) {
  std::istringstream content(read_file(path, kLargestConfig_bytes));
  const std::vector<CLI::ConfigItem> items = CLI::ConfigTOML().from_config(content);
  std::set<std::string> seen, applied;
  for (const CLI::ConfigItem& item : items) {
    const std::string key = item.fullname();
    const std::string place = path.string() + ": key '" + printable(key) + "'";
    CLI::Option* option = command.get_option_no_throw("--" + key);
    if (option == nullptr || !option->get_configurable()) {
      throw ConfigError(place + " is not an option of '" + command.get_name() +
                        "'; there are: " + known_keys(command));
    }
    if (!seen.insert(key).second) throw ConfigError(place + " is given twice");
    if (std::any_of(item.inputs.begin(), item.inputs.end(), has_stray_quote)) {
      throw ConfigError(place + ": a quote is missing at the start or end of the value");
    }
    if (option->count() > 0) continue;  // the command line wins
    if (item.inputs.size() != 1) {
      throw ConfigError(place + " needs one value, not " + std::to_string(item.inputs.size()));
    }
    try {
      option->add_result(item.inputs.front());
      option->run_callback();
      applied.insert(key);
    } catch (const CLI::ParseError& error) {
      throw ConfigError(place + ": " + error.what());
    }
  }
  return applied;
}

}  // namespace anneal6d
