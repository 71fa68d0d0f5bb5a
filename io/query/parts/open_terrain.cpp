// SPDX-License-Identifier: GPL-3.0-or-later
//
// A question about places says which pages it needs, which the directory tells without reading one. A part
// that has these pages answers it as the whole does: full resolution at a place depends on nothing else.
#include "io/query/parts/open_terrain.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "engine/base/caught_failure.h"
#include "io/query/extract/part.h"
#include "terrain/model/relief.h"

namespace arete {
namespace {

/// Parts that are kept, and how many nodes each may have.
constexpr std::size_t kMostKept = 4;
constexpr std::uint64_t kMostNodesKept = 500'000;
/// The largest model that is read whole because its parts were read too often.
constexpr std::uint64_t kMostNodesWhole = 4'000'000;

Result<AmtFile> opened(const AmtContainer& container) {
  return openAmt(AmtContainer(container));
}

}  // namespace

OpenTerrain::OpenTerrain(TerrainModel whole)
    : outline_(std::make_shared<const LocatedTerrain>(std::move(whole))), state_(std::make_unique<State>()) {
  const MultiTriangulation& mt = outline_->model.mt;
  summary_.triangles = mt.triangleCount();
  summary_.finestTriangles = mt.finestTriangleCount();
  vertices_ = mt.vertexCount();
  nodes_ = mt.nodeCount();
  state_->whole.set(outline_);
}

OpenTerrain::OpenTerrain(LastingFile file, const AmtFile& amt, TerrainModel outline)
    : file_(std::move(file)),
      outline_(std::make_shared<const LocatedTerrain>(std::move(outline))),
      summary_(amt.summary()),
      vertices_(amt.counts().rootVertices + amt.counts().nodes),
      nodes_(amt.nodeCount()),
      isFar_(amt.container().owner()->isFar()),
      state_(std::make_unique<State>()) {
  if (outline_->model.mt.nodeCount() == nodes_) state_->whole.set(outline_);
}

Result<std::shared_ptr<OpenTerrain>> OpenTerrain::open(LastingFile file, const RunContext& context) try {
  std::optional<AmtFile> amt;
  const auto readOutline = [&](const AmtContainer& container) -> Result<TerrainModel> {
    ARETE_TRY(amt, opened(container));
    if (!amt->isPaged() || !amt->summary().isThere()) return amt->read({}, context);
    // Down to the first band with a node; 0 would be everything.
    const double error = amt->errorBeyond(1);
    return amt->read(
        {.wanted = error > 0 ? RequiredError([error](const Box3&) { return error; }) : requiredNowhere()},
        context);
  };
  ARETE_TRY(TerrainModel outline, file.ask(context, readOutline));
  if (!amt->isPaged() || !amt->summary().isThere()) return std::make_shared<OpenTerrain>(std::move(outline));
  return std::shared_ptr<OpenTerrain>(new OpenTerrain(std::move(file), *amt, std::move(outline)));
} catch (...) {
  return caughtFailure();
}

Result<double> OpenTerrain::largestError(const RunContext& context) const {
  if (outline().mt.nodeCount() > 0 || nodes_ == 0) return outline().mt.largestError();
  ARETE_TRY(const Located all, whole(context));
  return all->model.mt.largestError();
}

double OpenTerrain::relief() const {
  return file_ ? summary_.relief : reliefOf(outline());
}

std::optional<std::vector<CurvePoint>> OpenTerrain::statedCurve(std::size_t most) const {
  const auto& curve = summary_.curve;
  if (!file_ || (most > curve.size() && curve.size() >= kSummarySteps)) return std::nullopt;
  std::vector<CurvePoint> points;
  for (std::size_t i = curve.size() - std::min(most, curve.size()); i < curve.size(); ++i) {
    const auto& [maxError, minimal, saturated] = curve[i];
    points.push_back({maxError, static_cast<std::uint32_t>(minimal), static_cast<std::uint32_t>(saturated)});
  }
  return points;
}

// Parts that were kept are of no more use.
void OpenTerrain::keepWhole(Located all) const {
  state_->whole.set(std::move(all));
  const std::lock_guard lock(state_->mutex);
  state_->kept.clear();
}

// A server is not asked for more than its questions need.
Result<OpenTerrain::Located> OpenTerrain::wholeIfReadOften(const RunContext& context) const {
  if (isFar_ || nodes_ > kMostNodesWhole) return state_->whole.ifThere();
  return state_->whole.getIfReadOften(
      nodes_, [&] { return readWhole(context); }, context);
}

Result<OpenTerrain::Located> OpenTerrain::readWhole(const RunContext& context) const {
  const auto readAll = [&](const AmtContainer& container) -> Result<TerrainModel> {
    ARETE_TRY(const AmtFile file, opened(container));
    return file.read({}, context);
  };
  ARETE_TRY(TerrainModel all, file_->ask(context, readAll));
  auto located = std::make_shared<const LocatedTerrain>(std::move(all));
  keepWhole(located);
  return Located(std::move(located));
}

Result<OpenTerrain::Located> OpenTerrain::whole(const RunContext& context) const try {
  return state_->whole.get([&] { return readWhole(context); }, context);
} catch (...) {
  return caughtFailure();
}

OpenTerrain::Located OpenTerrain::keptWith(const std::vector<PageNeed>& needs) const {
  const std::lock_guard lock(state_->mutex);
  const auto found = std::ranges::find_if(state_->kept, [&](const Kept& kept) {
    auto at = kept.pages.begin();
    return std::ranges::all_of(needs, [&](const PageNeed& need) {
      at = std::lower_bound(at, kept.pages.end(), HeldPage(need.page, 0));
      return at != kept.pages.end() && at->first == need.page && at->second <= need.lowestBand;
    });
  });
  if (found == state_->kept.end()) return {};
  std::rotate(state_->kept.begin(), found, found + 1);
  return state_->kept.front().part;
}

OpenTerrain::Located OpenTerrain::keep(const std::vector<PageNeed>& needs, TerrainModel part) const {
  auto located = std::make_shared<const LocatedTerrain>(std::move(part));
  const std::uint64_t nodes = located->model.mt.nodeCount();
  Kept kept{{}, located};
  for (const PageNeed& need : needs) kept.pages.emplace_back(need.page, need.lowestBand);
  std::ranges::sort(kept.pages);
  state_->whole.countPart(nodes);
  if (nodes == nodes_) state_->whole.set(located);
  if (nodes > kMostNodesKept || state_->whole.ifThere()) return located;
  const std::lock_guard lock(state_->mutex);
  if (state_->kept.size() == kMostKept) state_->kept.pop_back();
  state_->kept.push_front(std::move(kept));
  return located;
}

Result<OpenTerrain::Located> OpenTerrain::at(const RequiredError& wanted, const RunContext& context) const
    try {
  if (!wanted || !outline().isRaster) return whole(context);
  if (Located there = state_->whole.ifThere()) return there;
  return file_->ask(context, [&](const AmtContainer& container) -> Result<Located> {
    ARETE_TRY(const AmtFile file, opened(container));
    ARETE_TRY(const std::vector<PageNeed> needs, file.pagesFor(wanted, context));
    if (Located there = keptWith(needs)) return there;
    ARETE_TRY(Located all, wholeIfReadOften(context));
    if (all) return all;
    ARETE_TRY(TerrainModel part, file.read({.wanted = wanted}, context));
    return keep(needs, std::move(part));
  });
} catch (...) {
  return caughtFailure();
}

Result<OpenTerrain::Taken> OpenTerrain::forRequest(const ExtractRequest& request,
                                                   const RunContext& context) const try {
  ARETE_TRY(const Located all, wholeIfReadOften(context));
  const auto modelOf = [](const Located& of) { return std::shared_ptr<const TerrainModel>(of, &of->model); };
  if (all) return Taken{modelOf(all), std::nullopt};
  const auto readPart = [&](const AmtContainer& container) -> Result<PartAndCut> {
    ARETE_TRY(const AmtFile file, opened(container));
    return readForExtract(file, {&request, 1}, outline(), context);
  };
  ARETE_TRY(PartAndCut read, file_->ask(context, readPart));
  const std::uint64_t nodes = read.model.mt.nodeCount();
  if (nodes == nodes_) {
    auto located = std::make_shared<const LocatedTerrain>(std::move(read.model));
    keepWhole(located);
    return Taken{modelOf(located), std::move(read.cut)};
  }
  state_->whole.countPart(nodes);
  return Taken{std::make_shared<const TerrainModel>(std::move(read.model)), std::move(read.cut)};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
