// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <Eigen/Core>
#include <filesystem>

namespace anneal6d {

using FloatMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Reads IVT's `CFloatMatrix` (thesis App. B): the 29-byte header "MATRIX columns rows ", then
/// little-endian float32, row-major. Strict: a wrong magic, count or size, trailing bytes and
/// non-finite values throw FileError with the byte.
FloatMatrix load_float_matrix(const std::filesystem::path& path);

/// Writes the same format, atomically. Throws FileError.
void save_float_matrix(const FloatMatrix& matrix, const std::filesystem::path& path);

}  // namespace anneal6d
