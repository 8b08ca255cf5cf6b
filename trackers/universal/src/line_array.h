// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <cstddef>
#include <vector>

namespace anneal6d {

/// An array of numbers, zero at first, that begins at a cache line: vectors at multiples of their
/// own size do not lie across two lines.
template <class T>
class LineArray {
 public:
  static constexpr std::size_t kEntriesOfALine = 64 / sizeof(T);

  void resize(std::size_t size) { lines_.resize((size + kEntriesOfALine - 1) / kEntriesOfALine); }
  T* data() { return lines_.data()->entries; }

 private:
  struct alignas(64) Line {
    T entries[kEntriesOfALine];
  };
  std::vector<Line> lines_;
};

}  // namespace anneal6d
