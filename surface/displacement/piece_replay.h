// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"
#include "surface/error/original.h"
#include "surface/error/pieces.h"
#include "surface/model/parts.h"
#include "surface/model/surface_model.h"

namespace arete {

/// A triangle that is not of the finest front, with the pieces of that front that it stands for.
struct CoarseTriangle {
  std::uint32_t id = 0;
  std::array<std::uint32_t, 3> corners{};
  const PieceList& pieces;
};

/// Sees every coarse triangle once.
class CoarseTriangleVisitor {
 public:
  virtual ~CoarseTriangleVisitor() = default;
  /// Triangles 0 to count - 1 of a batch follow.
  virtual void begin(std::size_t count) { static_cast<void>(count); }
  /// Called for all of a batch, from all threads at once.
  virtual void visit(std::size_t number, const CoarseTriangle& triangle) = 0;
  /// Called once after them.
  virtual void end() {}
};

/// Goes through a multitriangulation as its build did, from the finest front to the root, and divides that
/// front among the coarse triangles: PieceDivision, node by node.
class PieceReplay {
 public:
  explicit PieceReplay(const SurfaceModel& model);
  PieceReplay(const PieceReplay&) = delete;
  PieceReplay& operator=(const PieceReplay&) = delete;

  /// Its positions are by vertex of the MT.
  const OriginalSurface& original() const { return original_; }

  /// The batches and their triangles are the same for any number of threads.
  /// @param stage named in reports of progress. Errors: interrupted.
  Status run(CoarseTriangleVisitor& visitor, const char* stage, const RunContext& context) const;

 private:
  void sortByHeight();
  StarLine lineOf(NodeId n) const;

  const SurfaceModel& model_;
  const MultiTriangulation& mt_;
  std::vector<std::uint32_t> partOf_;
  SurfaceParts parts_;
  std::vector<Vec3> positions_;
  std::vector<std::array<std::uint32_t, 3>> faces_;  // the finest front
  std::vector<std::uint32_t> faceOf_;                // by triangle of the finest front
  OriginalSurface original_;
  std::vector<std::uint32_t> nodes_;       // lowest first: the star of a node has no floor of a later one
  std::vector<std::size_t> heightBegins_;  // in nodes_
};

}  // namespace arete
