// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/task_arena.h>

#include "engine/parallel/run_context.h"

namespace arete {

/// Runs body() in an arena of as many threads as the context allows. @return the result of body()
template <class Body>
auto withThreads(const RunContext& context, const Body& body) {
  if (context.threads <= 0) return body();
  tbb::task_arena arena(context.threads);
  return arena.execute(body);
}

}  // namespace arete
