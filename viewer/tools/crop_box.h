// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "engine/base/box3.h"
#include "viewer/scene/layer.h"
#include "viewer/surface/surface_subject.h"

namespace arete {

/// A box along the axes of a surface's file, whose faces the mouse drags. Numbers are the file's own, as
/// doubles, wherever and however turned the surface is shown.
class CropBox {
 public:
  /// The layer of its edges.
  static constexpr const char* kLayer = "crop box";

  /// Around all of the surface. O(vertices of its shape).
  explicit CropBox(const SurfaceSubject& surface);

  Box3 box;
  /// The surface's own box: where the faces stand at first, and the range of the numbers.
  const Box3& whole() const { return whole_; }
  /// The middle of a face in the metric space of the scene; faces are the lower ones of x, y, z, then the
  /// upper ones.
  Vec3 handle(std::size_t face) const;
  SpaceVertices edges() const;
  /// The box in the surface's upright space: what lies outside is drawn tinted.
  KeptBox kept() const;

  /// Takes hold of the face whose handle is within `reach` pixels of the mouse, the nearest of them.
  void grab(const Camera& camera, Vec2 mouse, const ViewSettings& settings, double reach);
  std::optional<std::size_t> held() const { return held_; }
  /// Moves the face that is held along its axis to where its handle is nearest to the mouse on the screen. It
  /// stays before the other face. An axis that points at the eye moves nothing.
  void drag(const Camera& camera, Vec2 mouse, const ViewSettings& settings);
  void release() { held_.reset(); }

  /// A bound is moved, and the opposite one stays beyond it.
  void setBound(std::size_t face, double value);
  double bound(std::size_t face) const;

 private:
  Vec3 shown(const Vec3& inFile) const;
  Vec3 middleOf(std::size_t face, double bound) const;

  const SurfaceSubject& surface_;
  Box3 whole_;
  std::optional<std::size_t> held_;
};

}  // namespace arete
