// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace arete {

/// What a file in pages says of its model in its metadata, so that it is known without reading pages.
struct AmtSummary {
  std::uint64_t triangles = 0;        ///< of the whole MT; 0: the file has no summary
  std::uint64_t finestTriangles = 0;  ///< of the finest front
  double relief = 0;                  ///< reliefOf(); of a surface 0
  double rootError = 0;               ///< the largest error of a root triangle
  /// The error curve at the steps of its ladder (engine/cut/error_curve.h), rising: the tolerance, the
  /// triangles of the minimal and of the saturated cut.
  std::vector<std::array<double, 3>> curve;

  bool isThere() const { return triangles > 0; }
};

/// Its numbers as the metadata stores them: absent without a summary.
struct StoredSummary {
  std::optional<std::uint64_t> triangles = {}, finestTriangles = {};
  std::optional<double> relief = {}, rootError = {};

  static StoredSummary of(const AmtSummary& s) {
    const auto stored = [&](auto number) { return s.isThere() ? std::optional(number) : std::nullopt; };
    return {stored(s.triangles), stored(s.finestTriangles), stored(s.relief), stored(s.rootError)};
  }
  void giveTo(AmtSummary& s) const {
    s.triangles = triangles.value_or(0);
    s.finestTriangles = finestTriangles.value_or(0);
    s.relief = relief.value_or(0);
    s.rootError = rootError.value_or(0);
  }
};

/// Visits the fields of a summary, in the order of the file.
template <class Visitor, class Summary, class Stored>
void visitSummary(Visitor& top, Summary& s, Stored& stored) {
  top.optionalObject("summary", [&](auto& summary) {
    summary.optional("triangles", stored.triangles);
    summary.optional("finestTriangles", stored.finestTriangles);
    summary.optional("relief", stored.relief);
    summary.optional("rootError", stored.rootError);
    summary.optional("curve", s.curve);
  });
}

/// Steps of the curve that a summary holds at most.
inline constexpr std::size_t kSummarySteps = 40;

}  // namespace arete
