// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/warning.h"
#include "io/formats/off/keyword.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// A number of a text, and whether its word looks like a float.
struct OffNumber {
  double value = 0;
  bool isFloat = false;
};

/// The colors of vertices or faces, some of which may have none.
class OffColors {
 public:
  /// @param numbers three or four: red, green, blue and perhaps alpha.
  void add(std::size_t element, std::span<const OffNumber> numbers);

  bool isEmpty() const { return count_ == 0; }
  std::size_t missing(std::size_t elements) const { return elements - count_; }

  /// Whole numbers up to 255 are bytes, unless all are 0 and 1 and the file is not `isExact`: programs write
  /// floats without a point as well. Other numbers are as in the file. Elements without a color are white;
  /// where some have an alpha, the others are opaque.
  Attribute attribute(std::size_t elements, bool isExact) const;

  /// Calls change(the four numbers) for each color, where alpha is NaN if there is none; they are not floats
  /// then.
  template <class Change>
  void changeAll(const Change& change) {
    for (std::size_t i = 0; i + 4 <= values_.size(); i += 4) change(std::span<double, 4>(&values_[i], 4));
    hasFloats_ = false;
  }

 private:
  std::vector<double> values_;  // four for each element up to the last that has a color; NaN: none
  std::size_t count_ = 0;       // of colors
  bool hasAlpha_ = false, hasFloats_ = false;
};

/// What the vertices of an OFF have behind their coordinates.
class OffVertices {
 public:
  explicit OffVertices(const OffKeyword& keyword) : keyword_(keyword) {}

  /// Takes the numbers behind the coordinates of a vertex: as many as the keyword says, but a color may lack
  /// its alpha. A vertex that has others has no attributes.
  void add(std::span<const OffNumber> numbers);

  /// Gives the mesh its attributes. Three or four whole numbers up to 255 that the keyword does not announce
  /// are colors if all vertices have them.
  ///
  /// @param isExact the file is Arete's own. @param withoutAlpha it has the comment kOffWithoutAlpha.
  void finish(SurfaceMesh& mesh, bool isExact, bool withoutAlpha, Warnings& warnings);

 private:
  void takeMeshLabOrder();

  OffKeyword keyword_;
  std::size_t vertices_ = 0, misfits_ = 0, surplus_ = 0;
  std::vector<double> normals_, texcoords_;
  OffColors colors_, unannounced_;
  bool areGeomviews_ = true, areMeshLabs_ = true;  // the order of normal and color
};

}  // namespace arete
