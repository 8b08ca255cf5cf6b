// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <hwy/highway.h>

#include <cstdint>
#include <vector>

namespace anneal6d::test {

/// Highway's targets that were compiled and that this machine has.
inline std::vector<std::int64_t> instruction_sets() { return hwy::SupportedAndGeneratedTargets(); }

/// While it lives, the inner loops are those of one of them.
class OnInstructionSet {
 public:
  explicit OnInstructionSet(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~OnInstructionSet() { hwy::SetSupportedTargetsForTest(0); }
  OnInstructionSet(const OnInstructionSet&) = delete;
  OnInstructionSet& operator=(const OnInstructionSet&) = delete;
};

}  // namespace anneal6d::test
