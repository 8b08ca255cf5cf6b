// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "anneal6d/framework/error.h"

namespace anneal6d {

/// A row of a plugin table: something that can be made by name.
template <class Product, class Setup>
struct Plugin {
  std::string name;
  std::string summary;  ///< one line for `anneal6d list`
  /// Returns an empty text if it can be used here, otherwise why not and what to do. May be left
  /// out: then it always can.
  std::function<std::string()> why_unavailable;
  std::function<std::unique_ptr<Product>(const Setup&)> make;

  /// What `why_unavailable` returns.
  std::string obstacle() const { return why_unavailable ? why_unavailable() : std::string(); }
};

template <class Product, class Setup>
using PluginTable = std::vector<Plugin<Product, Setup>>;

/// Makes the product called `name`. `kind` ("scorer") is for messages. Throws ConfigError listing
/// the names that exist if there is no such row, BackendUnavailable with the reason if it can't be
/// used here, and what the maker throws.
template <class Product, class Setup>
std::unique_ptr<Product> make_plugin(const PluginTable<Product, Setup>& table,
                                     std::string_view kind, std::string_view name,
                                     const Setup& setup) {
  const auto row = std::find_if(table.begin(), table.end(),
                                [&](const auto& plugin) { return plugin.name == name; });
  if (row == table.end()) {
    std::string known;
    for (const auto& plugin : table) known += (known.empty() ? "" : ", ") + plugin.name;
    throw ConfigError("unknown " + std::string(kind) + " '" + std::string(name) +
                      "'; there are: " + (known.empty() ? "none" : known));
  }
  if (const std::string reason = row->obstacle(); !reason.empty()) {
    throw BackendUnavailable(std::string(kind) + " '" + std::string(name) +
                             "' is not available: " + reason);
  }
  return row->make(setup);
}

}  // namespace anneal6d
