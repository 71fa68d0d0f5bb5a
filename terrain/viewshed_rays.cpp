// SPDX-License-Identifier: GPL-3.0-or-later
//
// One answer for each cell, rows in parallel: what works for every engine and every Earth.
#include <tbb/parallel_for.h>

#include <mutex>

#include "engine/with_threads.h"
#include "terrain/viewshed_methods.h"

namespace arete {

Status viewshedRays(const ViewshedTask& task, const RunContext& context, Viewshed& result) {
  const std::uint32_t columns = task.grid.columns(), rows = task.grid.rows();
  std::atomic<std::uint32_t> done = 0;
  std::atomic<bool> isReporting = false, isBroken = false;
  std::mutex mutex;
  std::pair<std::uint32_t, Error> first{rows, {}};  // of the first row that fails, whoever comes first
  std::vector<std::uint64_t> counts(rows);
  withThreads(context, [&] {
    tbb::parallel_for(0u, rows, [&](std::uint32_t row) {
      if (context.cancelled() || isBroken) return;
      const double* heights = task.grid.row(row);
      for (std::uint32_t column = 0; column < columns; ++column) {
        const auto answer = task.exact.at({double(column), double(row)}, heights[column]);
        if (!answer) {
          isBroken = true;
          const std::lock_guard lock(mutex);
          if (row < first.first) first = {row, answer.error()};
          return;
        }
        const std::size_t at = std::size_t{row} * columns + column;
        result.cells[at] = answer->cell;
        if (!result.values.empty()) result.values[at] = answer->value;
        counts[row] += answer->cell != ViewshedCell::outside;
      }
      const std::uint32_t count = ++done;
      if (!isReporting.exchange(true)) {
        context.report("viewshed", double(count) / rows);
        isReporting = false;
      }
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the viewshed was stopped");
  if (isBroken) return tl::unexpected(first.second);
  for (const std::uint64_t count : counts) result.rays += count;
  return {};
}

}  // namespace arete
