// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/parallel/each_task.h"

#include <mutex>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"

namespace arete {

Status forEachTask(std::size_t count, const RunContext& context, const char* stage,
                   const std::function<void(std::size_t task)>& task) {
  std::mutex reporting;
  std::size_t done = 0;
  withThreads(context, [&] {
    parallelForTasks(std::size_t{0}, count, [&](std::size_t i) {
      if (context.cancelled()) return;
      task(i);
      const std::lock_guard lock(reporting);
      context.report(stage, static_cast<double>(++done) / static_cast<double>(count));
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the work was interrupted");
  return {};
}

}  // namespace arete
