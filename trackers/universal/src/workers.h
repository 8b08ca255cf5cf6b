// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <optional>

namespace anneal6d {

/// Threads for loops whose passes do not depend on each other.
class Workers {
 public:
  /// 0 threads: the caller's own arena, which has all cores unless the caller says otherwise. Loops
  /// of several `Workers` then find each other's threads awake. 1: the calling thread alone.
  explicit Workers(int threads) : alone_(threads == 1) {
    if (threads > 1) arena_.emplace(threads);
  }

  /// Calls `pass(i)` for each i below `count`, in any order; `grain` passes are worth a task.
  template <class Pass>
  void each(std::size_t count, std::size_t grain, const Pass& pass) {
    if (alone_ || count <= grain) {
      for (std::size_t i = 0; i < count; ++i) pass(i);
      return;
    }
    const auto loop = [&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) pass(i);
      });
    };
    if (arena_) {
      arena_->execute(loop);
    } else {
      tbb::this_task_arena::isolate(loop);  // while waiting, no other task of the caller's
    }
  }

 private:
  bool alone_;
  std::optional<tbb::task_arena> arena_;
};

}  // namespace anneal6d
