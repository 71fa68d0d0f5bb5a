// SPDX-License-Identifier: GPL-3.0-or-later
//
// One engine's answer for each place, rows in parallel. It works for every engine and every Earth.

#include <algorithm>
#include <atomic>
#include <mutex>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/shared_progress.h"
#include "engine/parallel/with_threads.h"
#include "terrain/viewshed/methods.h"

namespace arete {
namespace {

/// Calls body(row), which returns a Status, for all rows in parallel. Returns the error of the lowest row
/// that failed.
template <class Body>
Status forRows(std::uint32_t rows, const RunContext& context, const Body& body) {
  SharedProgress progress(context, "viewshed", rows);
  std::atomic<bool> isBroken = false;
  std::mutex mutex;
  std::pair<std::uint32_t, Error> first{rows, {}};
  withThreads(context, [&] {
    parallelFor(0u, rows, [&](std::uint32_t row) {
      if (context.cancelled() || isBroken) return;
      if (const Status status = body(row); !status) {
        isBroken = true;
        const std::lock_guard lock(mutex);
        if (row < first.first) first = {row, status.error()};
        return;
      }
      progress.add();
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the viewshed was stopped");
  if (isBroken) return tl::unexpected(first.second);
  return {};
}

}  // namespace

Status viewshedRays(const ViewshedTask& task, const RunContext& context, Viewshed& result) {
  const std::uint32_t columns = task.grid.columns(), rows = task.grid.rows();
  std::vector<std::uint64_t> counts(rows);
  Status status = forRows(rows, context, [&](std::uint32_t row) -> Status {
    const double* heights = task.grid.row(row);
    // The last column of a raster that goes round the Earth is the first one again.
    const bool isClosed = task.model.georeference.repeatsFirstColumn && columns > 1;
    for (std::uint32_t column = 0; column < columns; ++column) {
      if (isClosed && column + 1 == columns) {
        const std::size_t first = std::size_t{row} * columns, last = first + column;
        result.cells[last] = result.cells[first];
        if (!result.values.empty()) result.values[last] = result.values[first];
        continue;
      }
      ARETE_TRY(const auto answer, task.exact.at({double(column), double(row)}, heights[column]));
      const std::size_t at = std::size_t{row} * columns + column;
      result.cells[at] = answer.cell;
      if (!result.values.empty()) result.values[at] = answer.value;
      counts[row] += answer.cell != ViewshedCell::outside;
    }
    return {};
  });
  for (const std::uint64_t count : counts) result.rays += count;
  return status;
}

Status viewshedOfPlaces(const ViewshedExact& exact, const SightGrid& grid, std::span<const Vec2> places,
                        const RunContext& context, Viewshed& result) {
  constexpr std::size_t kPerRow = 1024;
  const auto rows = static_cast<std::uint32_t>((places.size() + kPerRow - 1) / kPerRow);
  return forRows(rows, context, [&](std::uint32_t row) -> Status {
    for (std::size_t i = row * kPerRow; i < std::min(places.size(), (row + 1) * kPerRow); ++i) {
      ARETE_TRY(const auto answer, exact.at(places[i], grid.at(places[i])));
      result.cells[i] = answer.cell;
      if (!result.values.empty()) result.values[i] = answer.value;
    }
    return {};
  });
}

}  // namespace arete
