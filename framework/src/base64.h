// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace anneal6d {

/// The bytes of "data:...;base64,..."; empty for anything else and for malformed base64.
std::optional<std::string> decode_data_uri(std::string_view uri);

}  // namespace anneal6d
