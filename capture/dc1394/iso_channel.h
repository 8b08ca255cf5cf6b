// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>

namespace anneal6d::dc1394 {

/// Whether nobody holds this isochronous channel of the camera's bus. A program that ended, even by
/// a crash, holds none: the kernel takes channel and bandwidth back with its files. True also if
/// the question can't be put.
bool is_channel_free(std::uint64_t guid, int channel);

/// Whether so much bandwidth, of 4915 units, is left on the camera's bus. True also if the question
/// can't be put.
bool is_bandwidth_free(std::uint64_t guid, std::uint32_t units);

}  // namespace anneal6d::dc1394
