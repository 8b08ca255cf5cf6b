// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
//
// The part of oneTBB that Anneal6D uses, on plain threads. The build under ThreadSanitizer finds
// these headers before oneTBB's. Distributions build oneTBB without ThreadSanitizer, which then
// cannot see that tasks start and end in order and reports every access in a task's body as a race;
// and silencing whatever has oneTBB on its stack would silence the bodies, too.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace tbb {

namespace stand_in {

/// More than a test machine may have cores: a race needs threads, not speed.
inline constexpr int kMostThreads = 4;

/// Which of the threads of a `parallel_for` this is; 0 also outside of one.
inline thread_local int thread_index = 0;
/// How many of them the arena that this thread is in allows.
inline thread_local int concurrency = kMostThreads;

}  // namespace stand_in

template <class Index>
class blocked_range {
 public:
  blocked_range(Index begin, Index end, std::size_t grain = 1)
      : begin_(begin), end_(end), grain_(grain) {}
  Index begin() const { return begin_; }
  Index end() const { return end_; }
  std::size_t grainsize() const { return grain_; }

 private:
  Index begin_, end_;
  std::size_t grain_;
};

template <class Index, class Body>
void parallel_for(const blocked_range<Index>& range, const Body& body) {
  // Relaxed, so that handing out work orders nothing that oneTBB would not order.
  std::atomic<std::size_t> taken{0};
  const std::size_t count = static_cast<std::size_t>(range.end() - range.begin());
  const auto work = [&](int index) {
    stand_in::thread_index = index;
    for (;;) {
      const std::size_t first = taken.fetch_add(range.grainsize(), std::memory_order_relaxed);
      if (first >= count) break;
      const std::size_t last = std::min(first + range.grainsize(), count);
      body(blocked_range<Index>(range.begin() + static_cast<Index>(first),
                                range.begin() + static_cast<Index>(last), range.grainsize()));
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < stand_in::concurrency; ++i) threads.emplace_back(work, i);
  for (auto& thread : threads) thread.join();
}

class task_arena {
 public:
  static constexpr int automatic = -1;

  explicit task_arena(int concurrency = automatic)
      : concurrency_(concurrency == automatic ? stand_in::kMostThreads
                                              : std::min(concurrency, stand_in::kMostThreads)) {}

  template <class Work>
  auto execute(Work&& work) {
    struct Restore {
      int before = stand_in::concurrency;
      ~Restore() { stand_in::concurrency = before; }
    } restore;
    stand_in::concurrency = concurrency_;
    return std::forward<Work>(work)();
  }

 private:
  int concurrency_;
};

namespace this_task_arena {

/// A thread that waits here never takes other tasks up.
template <class Work>
auto isolate(Work&& work) {
  return std::forward<Work>(work)();
}

}  // namespace this_task_arena

template <class Value>
class enumerable_thread_specific {
 public:
  template <class Make>
  explicit enumerable_thread_specific(Make make) : make_(std::move(make)) {}

  Value& local() {
    auto& value = values_[static_cast<std::size_t>(stand_in::thread_index)];
    if (!value) value = std::make_unique<Value>(make_());
    return *value;
  }

 private:
  std::function<Value()> make_;
  std::array<std::unique_ptr<Value>, stand_in::kMostThreads> values_;
};

}  // namespace tbb
