// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "view_model.h"

namespace anneal6d {

/// Identifies views: of a model, its texture, and how it is drawn.
using ViewKey = std::uint64_t;

/// The views in the format of the cache: numbers in the machine's byte order, places as 16-bit
/// fractions of the object's radius, a few megabytes.
std::string pack_views(const std::vector<ModelView>& views, ViewKey key,
                       const Eigen::Vector3d& center_mm, double radius_mm);

/// Reads what `pack_views` wrote; nothing if it is damaged, of another version, or of another key.
std::optional<std::vector<ModelView>> unpack_views(std::string_view bytes, ViewKey key,
                                                   const Eigen::Vector3d& center_mm,
                                                   double radius_mm);

}  // namespace anneal6d
