// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace anneal6d {

/// Parses the whole of `text` as a number, independent of the locale; surrounding blanks and a
/// leading '+' are allowed. Empty for anything else, for overflow and for non-finite values.
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);
std::optional<std::uint64_t> parse_natural_number(std::string_view text);

}  // namespace anneal6d
