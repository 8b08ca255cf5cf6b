// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace anneal6d::emulated {

/// Where the command registers lie, from the start of the register space (0xFFFFF0000000).
constexpr std::uint64_t kCommandBase = 0xF00000;

/// The configuration ROM of an IIDC 1.31 camera (IEEE 1212; IIDC 1.31, chapter 2), in the
/// processor's byte order, as the kernel hands it out.
std::vector<std::uint32_t> make_config_rom(std::uint64_t guid, std::string_view vendor,
                                           std::string_view model);

}  // namespace anneal6d::emulated
