// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts go down the raster, and share a row with the one before, so that every cell lies in one of them. The
// number of rows is halved while the memory is refused; it stays so, because the terrain goes on alike.
#include "io/query/parts/validate_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/memory/pages.h"
#include "engine/memory/required_memory.h"
#include "terrain/laws/model_rows.h"
#include "terrain/model/heights_checksum.h"

namespace arete {
namespace {

/// What the checks of a part take for each of its nodes: fronts, their edges, triangles to be compared.
constexpr std::uint64_t kBytesOfChecks = 150;

/// Fewer rows take no fewer pages, which are as high as some tiles of 64 samples.
constexpr std::uint32_t kFewestRows = 32;

/// Full resolution in these rows, and nothing elsewhere.
RequiredError wantedInRows(const ModelRows& rows) {
  return requiredInPlan([rows](const Box2& box) {
    const bool meets = box.yMax >= double(rows.first) - 1 && box.yMin <= double(rows.last) + 1;
    return meets ? 0.0 : std::numeric_limits<double>::infinity();
  });
}

class PartsValidation {
 public:
  PartsValidation(const AmtFile& file, const ValidatePartsOptions& options, const RunContext& context)
      : file_(file),
        options_(options),
        context_(context),
        heights_(file.model().columns, file.model().rows),
        rowsAtOnce_(std::max<std::uint32_t>(options.mostRows, 2)) {}

  Result<ValidatedParts> run() {
    ARETE_TRY(const std::vector<PageNeed> all, file_.pagesFor({}, context_));
    isRead_.assign(all.size(), false);
    const std::uint32_t last = file_.model().rows - 1;
    for (std::uint32_t first = 0;;) {
      ModelRows rows{first, std::min<std::uint32_t>(last, first + std::min(rowsAtOnce_ - 1, last))};
      ARETE_CHECK(checkFitting(rows));
      context_.report("validate", double(rows.last) / std::max(1u, last));
      if (rows.last == last) break;
      first = rows.last;
    }
    found_.pages = static_cast<std::uint64_t>(std::ranges::count(isRead_, true));
    if (found_.pages != all.size())
      return failure(ErrorCode::brokenPromise, fmt::format("law 8: {} of {} pages belong to no row",
                                                           all.size() - found_.pages, all.size()));
    const std::string& stated = file_.model().sourceChecksum;
    if (const std::string sum = heights_.text(); stated.starts_with("xxh3-128:") && stated != sum)
      return failure(
          ErrorCode::brokenPromise,
          fmt::format("law 8: the heights have the checksum {}, those of the source had {}", sum, stated));
    return found_;
  }

 private:
  /// Checks as many of these rows as fit.
  /// @param rows  receives which ones
  Status checkFitting(ModelRows& rows) {
    for (;;) {
      giveFreeHeapBack();  // what the part before has freed counts as in use until then
      const Status checked = checkGuarded(rows);
      const std::uint32_t count = rows.last - rows.first + 1;
      if (checked || checked.error().code != ErrorCode::outOfMemory || count <= kFewestRows) return checked;
      rowsAtOnce_ = count / 2;
      rows.last = rows.first + rowsAtOnce_ - 1;
    }
  }

  Status checkGuarded(const ModelRows& rows) try { return check(rows); } catch (...) {
    return caughtFailure();
  }

  Status check(const ModelRows& rows) {
    const RequiredError wanted = wantedInRows(rows);
    ARETE_TRY(const std::vector<PageNeed> pages, file_.pagesFor(wanted, context_));
    ARETE_TRY(const TerrainModel part, file_.read({.wanted = wanted}, context_));
    ARETE_CHECK(checkBudget(kBytesOfChecks * part.mt.nodeCount(), "read fewer rows at once"));
    ValidateModelOptions laws = options_.laws;
    laws.rows = rows;
    RunContext quiet = context_;
    quiet.progress = {};
    ErrorsChecked errors;
    Status valid = validateModel(part, laws, quiet, &errors);
    if (!valid && valid.error().code == ErrorCode::brokenPromise)
      valid.error().message +=
          fmt::format(" (in the part of rows {} to {}, by its numbers)", rows.first, rows.last);
    ARETE_CHECK(valid);
    // The row that the next part begins with is its own.
    const RasterHeightfield samples = samplesInRows(part, rows);
    const bool isLast = rows.last + 1 == part.rows;
    heights_.add(std::span(samples.heights).first(samples.heights.size() - (isLast ? 0 : part.columns)));
    for (const PageNeed& page : pages)
      if (page.lowestBand == 0 && page.page < isRead_.size()) isRead_[page.page] = true;
    ++found_.parts;
    found_.errors.triangles += errors.triangles;
    found_.errors.checked += errors.checked;
    return {};
  }

  const AmtFile& file_;
  const ValidatePartsOptions& options_;
  const RunContext& context_;
  HeightsChecksum heights_;
  std::uint32_t rowsAtOnce_;
  std::vector<bool> isRead_;  // by page
  ValidatedParts found_;
};

}  // namespace

Result<ValidatedParts> validateInParts(const AmtFile& file, const ValidatePartsOptions& options,
                                       const RunContext& context) try {
  return PartsValidation(file, options, context).run();
} catch (...) {
  return caughtFailure(file.path());
}

}  // namespace arete
