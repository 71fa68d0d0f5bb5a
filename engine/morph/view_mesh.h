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

/// A terrain for a renderer: takes views, and updates vertex and index buffers incrementally. The mesh is
/// conforming, and within the tolerance, in pixels, of every sample in sight; vertices appear on the surface
/// that they refine and move to their own height (docs/topics/geomorphing.md).
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
/// Positions are floats relative to origin(), in the metric space of mt(), as views are. Subtract the eye
/// from the origin in double precision, and large coordinates do not make the picture shake: a float is off
/// by half a millimetre at 8 km from the origin, and by 4 mm at 100 km. The tolerance does not include that.
///
/// Triangles are counter-clockwise in plan coordinates, and so in metric space, seen against the z axis, when
/// its scales are positive, as those of Arete's models are. Metric space may be mirrored against the map
/// (TerrainModel::isFlipped()): a renderer then mirrors the picture, which reverses every triangle.
///
/// Not thread-safe: one thread at a time. Parallel inside. Memory: 6 bytes per node of the MT, about 80 per
/// triangle drawn.
class ViewMesh {
 public:
  struct Options {
    /// Vertical exaggeration, > 0: mt() is then exaggerated (engine/mt/exaggerated_mt.h), and so is the space
    /// of views and positions.
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
    /// The mesh does not change after it. Changes are still collected, so an update ends a little later.
    std::optional<Deadline> deadline{};
    /// False: vertices appear at their own height, and the errors of triangles may take the whole tolerance.
    bool geomorph = true;
  };
  struct Report {
    std::uint32_t triangles = 0;
    std::uint32_t refined = 0, coarsened = 0;  ///< modifications
    std::uint32_t moving = 0;                  ///< vertices between two heights
    /// False when the budget, the deadline or an interruption ended the update.
    bool isComplete = true;
    /// The tolerance that holds: the given one, or the one reached if the update is not complete. Infinity if
    /// coarse triangles are around the eye of a view without a near distance.
    double pixels = 0;
    /// An upper bound of the pixels by which the modifications of this update move the surface, without the
    /// motion of the camera and of vertices; infinity if unknown, as around the eye.
    double jumpPixels = 0;
  };
  /// Brings the mesh to a view. O(triangles drawn) at most. Without a deadline the result does not depend on
  /// the threads. Errors: usage: an invalid view or tolerance, or a budget below the root; then nothing has
  /// changed.
  Result<Report> update(const View& view, const UpdateOptions& options, const RunContext& context = {});

  /// The positions of all vertices of the MT, the root's first, as they are drawn now. Computed by the call,
  /// O(V).
  std::vector<std::array<float, 3>> positions() const;
  /// The index buffer: the vertices of each triangle. A triangle keeps its index as long as it is drawn, or
  /// until it moves to a gap.
  std::span<const std::array<std::uint32_t, 3>> triangles() const;
  /// The MT triangle of each index.
  std::span<const std::uint32_t> triangleIds() const;

  struct Places {
    std::uint32_t first = 0, count = 0;
  };
  /// The ranges of triangles() that changed in the last update, rising; they may contain a few unchanged
  /// triangles.
  std::span<const Places> changedPlaces() const;

  struct HeightChange {
    std::uint32_t vertex = 0;
    float height = 0;  ///< the z of its position
  };
  /// The vertices whose drawn heights changed in the last update.
  std::span<const HeightChange> heightChanges() const;

  const Vec3& origin() const;
  const MultiTriangulation& mt() const;

 private:
  class State;
  explicit ViewMesh(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
