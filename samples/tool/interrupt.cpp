// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#include "interrupt.h"

#include <atomic>
#include <csignal>

namespace anneal6d {

namespace {

std::atomic<bool> seen = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not lock");

void handle_interrupt(int) {
  seen = true;
  std::signal(SIGINT, SIG_DFL);
}

}  // namespace

void catch_interrupt() { std::signal(SIGINT, handle_interrupt); }
bool interrupted() { return seen; }

}  // namespace anneal6d
