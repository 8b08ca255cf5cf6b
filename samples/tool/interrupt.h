// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Anneal6D authors
#pragma once

namespace anneal6d {

/// From now on the first Ctrl-C (SIGINT) only makes `interrupted()` true; a second one ends the
/// program at once.
void catch_interrupt();

/// Thread safe.
bool interrupted();

}  // namespace anneal6d
