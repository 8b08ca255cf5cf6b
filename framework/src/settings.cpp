// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "anneal6d/framework/settings.h"

#include "anneal6d/framework/error.h"
#include "anneal6d/framework/number.h"

namespace anneal6d {
namespace {

[[noreturn]] void refuse(std::string_view name, std::string_view value, const std::string& wanted) {
  throw ConfigError("--" + std::string(name) + ": '" + std::string(value) + "' is not " + wanted);
}

std::string plain(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

std::optional<std::string> Settings::text(std::string_view name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return std::nullopt;
  return found->second;
}

std::optional<int> Settings::integer(std::string_view name, int low, int high) const {
  const auto given = text(name);
  if (!given) return std::nullopt;
  const auto value = parse_integer(*given);
  if (!value || *value < low || *value > high) {
    refuse(name, *given,
           "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return static_cast<int>(*value);
}

std::optional<std::uint64_t> Settings::natural_number(std::string_view name) const {
  const auto given = text(name);
  if (!given) return std::nullopt;
  const auto value = parse_natural_number(*given);
  if (!value) refuse(name, *given, "a whole number from 0 to 18446744073709551615");
  return value;
}

std::optional<double> Settings::number(std::string_view name, double low, double high) const {
  const auto given = text(name);
  if (!given) return std::nullopt;
  const auto value = parse_number(*given);
  if (!value || *value < low || *value > high) {
    refuse(name, *given, "a number from " + plain(low) + " to " + plain(high));
  }
  return value;
}

std::optional<bool> Settings::flag(std::string_view name) const {
  const auto given = text(name);
  if (!given) return std::nullopt;
  if (*given == "on" || *given == "true" || *given == "1") return true;
  if (*given == "off" || *given == "false" || *given == "0") return false;
  refuse(name, *given, "on or off");
}

}  // namespace anneal6d
