// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles are checked one by one, in parallel. A sample of them finds what is wrong everywhere, as errors
// of another model; a single wrong triangle is found for certain by checking all.
#include "terrain/laws/validate_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/parallel/first_bad.h"
#include "engine/parallel/with_threads.h"
#include "terrain/laws/point_error_law.h"
#include "terrain/laws/raster_error_law.h"

namespace arete {
namespace {

constexpr std::uint32_t kSampled = 1 << 16;

/// Whether a triangle id is one: the last slot of an open fan is not.
bool isTriangle(const MultiTriangulation& mt, std::uint32_t t) {
  const NodeId creator = mt.creator(TriangleId(t));
  return !creator.isValid() || mt.remover(TriangleId(t)) != creator;
}

std::vector<std::uint32_t> choose(const MultiTriangulation& mt, bool everyTriangle, std::uint64_t seed) {
  const std::uint32_t ids = mt.triangleIdCount();
  std::vector<std::uint32_t> chosen;
  if (everyTriangle || ids <= kSampled) {
    for (std::uint32_t t = 0; t < ids; ++t)
      if (isTriangle(mt, t)) chosen.push_back(t);
    return chosen;
  }
  for (std::uint32_t t = 0; t < std::min(mt.rootTriangleCount(), kSampled / 2); ++t) chosen.push_back(t);
  while (chosen.size() < kSampled) {
    seed += 0x9E3779B97F4A7C15ull;  // SplitMix64
    std::uint64_t z = (seed ^ (seed >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    const auto t = static_cast<std::uint32_t>((z ^ (z >> 31)) % ids);
    if (isTriangle(mt, t)) chosen.push_back(t);
  }
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

}  // namespace

Result<ErrorsChecked> validateErrors(const TerrainModel& model, const Cut& finest, bool everyTriangle,
                                     std::uint64_t seed, const RunContext& context,
                                     const std::optional<ModelRows>& rows) try {
  const MultiTriangulation& mt = model.mt;
  std::unique_ptr<const laws::ErrorLaw> law;
  if (rows)
    law = std::make_unique<laws::RasterErrorLaw>(mt, samplesInRows(model, *rows), rows->first);
  else if (model.isRaster)
    law = std::make_unique<laws::RasterErrorLaw>(mt, model.rasterSamples());
  else
    law = std::make_unique<laws::PointErrorLaw>(mt, finest);
  const std::vector<std::uint32_t> chosen = choose(mt, everyTriangle, seed);
  std::optional<std::uint32_t> bad;
  withThreads(context, [&] {
    bad = firstBad(chosen.size(), context, [&](std::uint32_t i) { return !law->holds(chosen[i]); });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the validation was interrupted");
  if (bad) {
    const std::uint32_t t = chosen[*bad];
    const laws::StoredErrors stored = laws::storedErrors(mt, t);
    return failure(
        ErrorCode::brokenPromise,
        fmt::format("law 10: over triangle {} the heights differ by more than its stored error {} or "
                    "its bound [-{}, {}]",
                    t, stored.error, stored.below, stored.above));
  }
  return ErrorsChecked{mt.triangleCount(), chosen.size()};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
