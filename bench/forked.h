// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "bench/figure.h"
#include "engine/base/result.h"

namespace arete::bench {

/// Runs `work` in a process of its own and hands back what it returns, so that one stage's memory, threads
/// and caches are not the next one's. The caller must not have started threads. Errors: those of `work`;
/// unreadable when the process ends otherwise (out of memory, a crash).
Result<Json> runForked(const std::function<Result<Json>()>& work);

/// The most memory this process has had resident since it was forked, in bytes.
double peakBytes();

}  // namespace arete::bench
