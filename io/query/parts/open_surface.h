// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/parts/lasting_file.h"
#include "io/query/parts/whole_model.h"
#include "io/query/request/extract_request.h"
#include "io/store/format/summary.h"
#include "surface/model/surface_model.h"

namespace arete {

/// A model of a surface as questions use it: all of it in memory, or a file in pages of which each cut reads
/// the part that it needs (io/query/surface/surface_part.h, which says what differs). What needs the whole
/// reads it once, and it stays in memory; so it is with a small file on this machine once its parts have come
/// to as many nodes as the whole has.
///
/// Thread-safe: questions may be asked from several threads at once.
class OpenSurface {
 public:
  using Shared = std::shared_ptr<const SurfaceModel>;

  explicit OpenSurface(SurfaceModel whole);
  /// Reads the outline of a file: its root, and the coarsest nodes, of which the largest error is. A file
  /// that is not in pages, or says no summary of itself, is read whole. Errors: as loadSurfaceAmt(), and as
  /// LastingFile::current().
  static Result<std::shared_ptr<OpenSurface>> open(LastingFile file, const RunContext& context = {});

  /// A part of the model, its root at least.
  const SurfaceModel& outline() const { return *outline_; }
  /// Whether cuts read parts of a file.
  bool isInParts() const { return file_.has_value(); }

  /// Of the whole model.
  std::uint64_t vertexCount() const { return vertices_; }
  std::uint64_t triangleCount() const { return triangles_; }
  std::uint64_t finestTriangleCount() const { return outline_->finestTriangles(); }
  /// MultiTriangulation::largestError(). Errors: as whole(), where the outline does not say it.
  Result<double> largestError(const RunContext& context = {}) const;

  /// All of the model. Errors: as loadSurfaceAmt(), and as LastingFile::current().
  Result<Shared> whole(const RunContext& context = {}) const;
  /// What a request needs. Errors: as readForExtract(), and as LastingFile::current().
  Result<Shared> forRequest(const ExtractRequest& request, const RunContext& context = {}) const;

 private:
  OpenSurface(LastingFile file, SurfaceModel outline);
  /// Null where the next part is better read alone. Errors: interrupted.
  Result<Shared> wholeIfReadOften(const RunContext& context) const;
  Result<Shared> readWhole(const RunContext& context) const;

  std::optional<LastingFile> file_;
  Shared outline_;
  std::uint64_t vertices_ = 0, triangles_ = 0, nodes_ = 0;
  bool isFar_ = false;
  std::unique_ptr<WholeModel<SurfaceModel>> whole_ = std::make_unique<WholeModel<SurfaceModel>>();
};

}  // namespace arete
