// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/criteria/view.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/deadline.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// A terrain for a renderer: camera numbers in, vertex and index buffers out, by changes. The mesh that is
/// drawn is conforming, and within the tolerance, in pixels, of every sample in sight; vertices appear on the
/// surface that they refine and move to their own height (docs/topics/geomorphing.md).
///
///     auto mesh = ViewMesh::create(model.mt);
///     upload(mesh->positions());                              // once: all vertices of the model
///     upload(mesh->triangles());                              // and the root's triangles
///     every frame:
///       mesh->update(view, {.pixels = 1});
///       for (range : mesh->changedPlaces()) upload(mesh->triangles(), range);
///       for (change : mesh->heightChanges()) write(change.vertex, change.height);
///       draw(mesh->triangles().size(), eye - mesh->origin());
///
/// Positions are floats relative to origin(), in the metric space of mt(). Views are in that space too. The
/// eye is subtracted from the origin in double, so nothing shakes however large coordinates are: a float is
/// off by half a millimetre at 8 km from the origin, by 4 mm at 100 km, and that is all that the tolerance
/// does not count.
///
/// Triangles are counter-clockwise in plan coordinates, and so in metric space, seen against the z axis, when
/// its scales are positive, as those of Arete's models are. Metric space may be mirrored against the map
/// (TerrainModel::isFlipped()): a renderer then mirrors the picture, which turns every triangle round.
///
/// Not thread-safe: one thread at a time, which may be one of the caller's own. Works in parallel inside.
/// Memory: 6 bytes per node of the MT, some 80 per triangle drawn.
class ViewMesh {
 public:
  struct Options {
    /// Vertical exaggeration, > 0: mt() is then a exaggerated one (engine/mt/exaggerated_mt.h), of the space
    /// in which views and positions are.
    double heightScale = 1;
  };
  /// Starts at the root. O(nodes). Errors: usage.
  static Result<ViewMesh> create(MultiTriangulation mt, const Options& options);
  static Result<ViewMesh> create(MultiTriangulation mt) { return create(std::move(mt), {}); }
  ~ViewMesh();
  ViewMesh(ViewMesh&&) noexcept;
  ViewMesh& operator=(ViewMesh&&) noexcept;

  struct UpdateOptions {
    double pixels = 1;  ///< tolerance, > 0
    std::optional<std::uint32_t> maxTriangles{};
    /// When the mesh changes no more. What was changed is then told, so an update ends a little later.
    std::optional<Deadline> deadline{};
    /// False: vertices appear at their own height, and the whole tolerance is for the errors of triangles.
    bool geomorph = true;
  };
  struct Report {
    std::uint32_t triangles = 0;
    std::uint32_t refined = 0, coarsened = 0;  ///< modifications
    std::uint32_t moving = 0;                  ///< vertices between two heights
    /// False when the budget, the deadline or an interruption ended the update.
    bool isComplete = true;
    /// The tolerance that holds: the one asked for, or the one reached where the update is not complete. It
    /// is infinite where coarse triangles are around the eye of a view without a near distance.
    double pixels = 0;
    /// What the modifications of this update move on the screen at most, the motion of vertices with the
    /// camera apart; infinite when that cannot be said, as around the eye.
    double jumpPixels = 0;
  };
  /// O(triangles drawn) tests, the rest by what changes and moves. The same whatever the number of threads,
  /// without a deadline. Errors: usage; then nothing has changed.
  Result<Report> update(const View& view, const UpdateOptions& options, const RunContext& context = {});

  /// Of every vertex of the MT, the root's first, as they are drawn now: O(V), made for the call.
  std::vector<std::array<float, 3>> positions() const;
  /// The index buffer: vertices of each triangle. A triangle keeps its place as long as it is drawn, or until
  /// it fills a gap.
  std::span<const std::array<std::uint32_t, 3>> triangles() const;
  /// The MT's ids of the triangles, place by place.
  std::span<const std::uint32_t> triangleIds() const;

  struct Places {
    std::uint32_t first = 0, count = 0;
  };
  /// What of triangles() differs since the last update, as ranges, rising; they may hold a few that do not.
  std::span<const Places> changedPlaces() const;

  struct HeightChange {
    std::uint32_t vertex = 0;
    float height = 0;  ///< the z of its position
  };
  /// Heights that differ from those last told, of vertices that have come to rest as well.
  std::span<const HeightChange> heightChanges() const;

  const Vec3& origin() const;
  const MultiTriangulation& mt() const;

 private:
  class State;
  explicit ViewMesh(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
