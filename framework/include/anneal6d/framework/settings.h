// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace anneal6d {

/// Named values as the user typed them, on the command line or in a configuration file; the names
/// are those of the tool's options without dashes ("sigma-mm"). A plugin's options struct reads the
/// ones it knows; numbers are parsed independently of the locale.
class Settings {
 public:
  void set(std::string name, std::string value) { values_[std::move(name)] = std::move(value); }
  bool has(std::string_view name) const { return values_.find(name) != values_.end(); }

  /// The value, or empty if it was not given. Throws ConfigError naming the setting if the text is
  /// not of the type or not within [low, high].
  std::optional<std::string> text(std::string_view name) const;
  std::optional<int> integer(std::string_view name, int low, int high) const;
  std::optional<std::uint64_t> natural_number(std::string_view name) const;  ///< from 0 on: a seed
  std::optional<double> number(std::string_view name, double low, double high) const;
  std::optional<bool> flag(std::string_view name) const;

  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

 private:
  std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace anneal6d
