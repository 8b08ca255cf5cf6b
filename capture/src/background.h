// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

namespace anneal6d {

/// The picture behind a simulated object, CV_8UC3: `background` as in SimulationOptions. Throws
/// FileError.
cv::Mat make_background(const std::string& background, const cv::Size& size, std::uint64_t seed);

}  // namespace anneal6d
