// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "fuzz_readers.h"

// The build makes one program of this file for each target: ANNEAL6D_FUZZ_TARGET is its function.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return anneal6d::fuzz::ANNEAL6D_FUZZ_TARGET(data, size);
}
