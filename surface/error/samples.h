// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/vec.h"
#include "surface/error/original.h"
#include "surface/error/pieces.h"

namespace arete {

/// A place of the original with the area that it stands for.
struct SurfaceSample {
  Vec3 place;
  double area = 0;
  std::uint32_t face = 0;
  std::array<double, 3> shares{};  ///< of the face's corners
};

/// Samples of the original for integrals over it: every vertex, and the middle of every piece. Over a face
/// the weights integrate quadratic functions exactly.
class SurfaceSamples {
 public:
  explicit SurfaceSamples(const OriginalSurface& original);

  /// Appends the samples of a piece. A vertex belongs to one of its faces.
  void append(const Piece& piece, std::vector<SurfaceSample>& samples) const;

 private:
  const OriginalSurface& original_;
  std::vector<std::uint32_t> faceOf_;  // by vertex
  std::vector<float> areaOf_;          // by vertex
  std::vector<float> faceArea_;        // of the middle of a whole face
};

}  // namespace arete
