// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tsl/robin_map.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/scattered_id.h"
#include "engine/memory/paged_array.h"
#include "engine/morph/geomorphed_cut.h"
#include "viewer/fronts/drawn_vertices.h"

namespace arete {

/// A drawn vertex with all that it has, as it lies in graphics memory.
struct OwnVertex {
  std::array<float, 3> position{}, normal{}, smoothNormal{};
  std::array<float, 4> textureCoords{};
  std::array<std::uint8_t, 4> color{255, 255, 255, 255};
};
static_assert(sizeof(OwnVertex) == 56);

/// The vertices of an object that are drawn elsewhere than the surface's vertices lie, as those on the move,
/// and others that triangles share with them. Attributes move as places do (docs/topics/geomorphing.md): a
/// vertex appears with what the floor has where it appears, on its side of a seam, and ends with its own.
/// Normals keep the length of 1. Memory: a byte a vertex of the MT where vertices have moved, and what is
/// listed.
class OwnVertices {
 public:
  /// Precondition: the model outlives this.
  OwnVertices(const SurfaceModel& model, const ZUpFrame& upright,
              std::shared_ptr<const DrawnVertices> resting);

  /// Lists the vertices that `moved` moves. O(moving).
  void begin(const GeomorphedSurface& moved);
  /// Lists nothing; vertices rest at these positions, 3 floats each.
  void begin(std::span<const float> positions);

  bool isMoving(std::uint32_t vertex) const { return isMoving_[vertex] != 0; }
  /// The place in the list of a drawn vertex, which is of this vertex of the MT: added where it is not listed
  /// yet.
  std::uint32_t slotOf(std::uint32_t drawn, std::uint32_t vertex);
  const std::vector<OwnVertex>& list() const { return list_; }

 private:
  /// Where a drawn vertex of a node's vertex starts.
  struct Start {
    std::uint32_t drawn = 0;
    std::array<std::uint32_t, 3> corner{};  ///< drawn vertices
    std::array<float, 2> weight{};
  };
  void clear();
  std::vector<Start> startsOf(NodeId n) const;
  void forgetResting(std::span<const GeomorphedSurface::Moving> moving);
  OwnVertex resting(std::uint32_t drawn) const;
  /// As it is listed; at rest where it is not.
  OwnVertex current(std::uint32_t drawn) const;
  /// How much of the offset that the law wants the clamp leaves: in [0, 1].
  double partOf(const GeomorphedSurface::Moving& moving) const;
  OwnVertex onTheWay(const Start& start, double share, double part) const;
  void move(OwnVertex& vertex, std::uint32_t drawn, std::uint32_t of) const;
  std::uint32_t add(std::uint32_t drawn, const OwnVertex& vertex);

  const SurfaceModel* model_;
  ZUpFrame upright_;
  std::shared_ptr<const DrawnVertices> resting_;
  std::span<const float> positions_;
  const GeomorphedSurface* moved_ = nullptr;
  PagedArray<std::uint8_t> isMoving_;  // by vertex of the MT
  std::vector<std::uint32_t> moving_;  // vertices
  std::vector<OwnVertex> list_;
  tsl::robin_map<std::uint32_t, std::uint32_t, ScatteredId> slotOf_;         // by drawn vertex
  tsl::robin_map<std::uint32_t, std::vector<Start>, ScatteredId> startsOf_;  // by node
};

}  // namespace arete
