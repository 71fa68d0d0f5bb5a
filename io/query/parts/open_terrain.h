// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/cut/error_curve.h"
#include "engine/parallel/run_context.h"
#include "io/query/parts/lasting_file.h"
#include "io/query/parts/whole_model.h"
#include "io/query/request/extract_request.h"
#include "io/store/amt/file.h"
#include "io/store/format/required_error.h"
#include "terrain/locate/ground_height.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A model of terrain, or a part of one, with its point location.
struct LocatedTerrain {
  explicit LocatedTerrain(TerrainModel of) : model(std::move(of)), heights(model) {}
  LocatedTerrain(const LocatedTerrain&) = delete;
  LocatedTerrain& operator=(const LocatedTerrain&) = delete;

  const TerrainModel model;
  const GroundHeights heights;
};

/// A model of terrain as questions use it: all of it in memory, or a file in pages of which each question
/// reads the part that it needs. Both give the same answers (readForExtract() names one exception).
///
/// Some parts that were read last are kept, and answer whatever needs nothing else. Once the parts of a file
/// on this machine have come to as many nodes as the whole has, it is read whole and stays in memory, where
/// it is small enough. What needs the whole reads it once; it stays as well.
///
/// Thread-safe: questions may be asked from several threads at once.
class OpenTerrain {
 public:
  using Located = std::shared_ptr<const LocatedTerrain>;

  explicit OpenTerrain(TerrainModel whole);
  /// Reads the outline of a file: its root, and the coarsest nodes, of which the largest error is. A file
  /// that is not in pages, or says no summary of itself, is read whole. Errors: as openAmt() and
  /// AmtFile::read(), and as `file`'s current().
  static Result<std::shared_ptr<OpenTerrain>> open(LastingFile file, const RunContext& context = {});

  /// A part of the model, its root at least; with everything that is not of its triangles.
  const TerrainModel& outline() const { return outline_->model; }
  const GroundHeights& outlineHeights() const { return outline_->heights; }
  /// Whether questions read parts of a file.
  bool isInParts() const { return file_.has_value(); }

  /// Of the whole model; O(1) of a file in pages, which says it of itself.
  std::uint64_t vertexCount() const { return vertices_; }
  std::uint64_t triangleCount() const { return summary_.triangles; }
  std::uint64_t finestTriangleCount() const { return summary_.finestTriangles; }
  /// MultiTriangulation::largestError(). Errors: as whole(), where the outline does not say it.
  Result<double> largestError(const RunContext& context = {}) const;
  /// reliefOf(). O(samples) of a model in memory.
  double relief() const;
  /// The error curve at the largest tolerances of the ladder (toleranceLadder()) where the file says it of
  /// itself; else nothing.
  std::optional<std::vector<CurvePoint>> statedCurve(std::size_t most) const;

  /// All of the model. Errors: as AmtFile::read(), and as LastingFile::current().
  Result<Located> whole(const RunContext& context = {}) const;
  /// What a question about places requires (io/query/parts/asked_places.h); of points the whole, as
  /// outlineOf() does. Errors: as whole().
  Result<Located> at(const RequiredError& wanted, const RunContext& context = {}) const;

  struct Taken {
    std::shared_ptr<const TerrainModel> model;
    std::optional<Cut> cut;  ///< PartAndCut::cut
  };
  /// What a request needs. Errors: as readForExtract(), and as LastingFile::current().
  Result<Taken> forRequest(const ExtractRequest& request, const RunContext& context = {}) const;

 private:
  /// A page, and the lowest band of it that is there.
  using HeldPage = std::pair<std::uint64_t, std::uint32_t>;
  struct Kept {
    std::vector<HeldPage> pages;  // by rising page
    Located part;
  };
  struct State {
    WholeModel<LocatedTerrain> whole;
    std::mutex mutex;       // of what is kept; not held while something is read
    std::deque<Kept> kept;  // the last used first
  };

  OpenTerrain(LastingFile file, const AmtFile& amt, TerrainModel outline);
  /// Null where the next part is better read alone. Errors: interrupted.
  Result<Located> wholeIfReadOften(const RunContext& context) const;
  Result<Located> readWhole(const RunContext& context) const;
  void keepWhole(Located all) const;
  Located keptWith(const std::vector<PageNeed>& needs) const;
  Located keep(const std::vector<PageNeed>& needs, TerrainModel part) const;

  std::optional<LastingFile> file_;
  Located outline_;
  AmtSummary summary_;
  std::uint64_t vertices_ = 0, nodes_ = 0;
  bool isFar_ = false;
  std::unique_ptr<State> state_;
};

}  // namespace arete
