// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "engine/mt/multitriangulation.h"
#include "io/store/entropy/numbers.h"
#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/layout.h"
#include "io/store/packed/nodes/tables.h"
#include "io/store/packed/surface/coordinates.h"
#include "io/store/packed/surface/geometry.h"

namespace arete::packed {

/// Tables of the errors of surfaces: by error class, in the place of those by area class.
inline constexpr unsigned kMaxErrorTable = kErrorTable, kRmsTable = kErrorTable + kErrorClasses,
                          kFinestTable = kErrorTable + 2 * kErrorClasses;

inline constexpr int kShiftBits = 3;

/// Codes the errors and root mean squares of the triangles of a surface: the error as its distance from the
/// end of the band, the RMS as its distance from the error.
/// @tparam Io  the reader's or the writer's, see node_coder.h
template <class Io>
class ErrorsWithRms {
 public:
  ErrorsWithRms(Arrays& arrays, Io& io) : a_(arrays), io_(io) {}

  /// Those of all triangles of a run's stars that have a remover.
  /// @param passing  their slots, counted from the run's first
  void ofRun(const Run& run, unsigned bandClass, std::span<const std::uint32_t> passing,
             const std::uint8_t*) {
    auto&& io = io_.values();
    for (const std::uint32_t slot : passing) code(io, a_.roots + run.firstSlot + slot, run.band, bandClass);
    io_.putBack(io);
  }
  /// Those of all triangles that stay, and of the root's.
  /// @param band  the highest one
  void ofRoot(std::uint32_t band, unsigned bandClass) {
    auto&& io = io_.values();
    const std::array<std::uint16_t, 2> actual = io_.actualFinest();
    const auto finest = [&](std::uint16_t value) {
      return static_cast<std::uint16_t>(
          codeNumber(io, kErrorStream, kFinestTable, [&] { return std::uint64_t{value}; }));
    };
    a_.errorShift = static_cast<unsigned>(io.raw(kShiftBits, a_.errorShift));
    a_.finestError = finest(actual[0]);
    a_.finestRms = finest(actual[1]);
    for (std::uint32_t t = 0; t < a_.roots; ++t) code(io, t, band, bandClass);
    io_.putBack(io);
  }

 private:
  template <class Values>
  void code(Values& io, std::uint32_t id, std::uint32_t band, unsigned bandClass) {
    const std::uint32_t top = (band + 1) << MultiTriangulation::kBandShift;
    const std::uint64_t below =
        codeNumber(io, kErrorStream, kMaxErrorTable + bandClass / 3,
                   [&] {
                     const std::uint16_t actual = io.actualError(id);
                     return actual == 0 ? std::uint64_t{0} : (std::uint64_t{top} - actual) >> a_.errorShift;
                   })
        << a_.errorShift;
    const auto error = static_cast<std::uint16_t>(below == 0 || below >= top ? 0 : top - below);
    const std::uint64_t less =
        codeNumber(io, kErrorStream, kRmsTable + bandClass / 3,
                   [&] {
                     return std::uint64_t{static_cast<std::uint16_t>(error - io.actualRms(id))} >>
                            a_.errorShift;
                   })
        << a_.errorShift;
    if constexpr (Io::kKeepsValues) {
      a_.error[id] = error;
      a_.rms[id] = static_cast<std::uint16_t>(error - less);
    }
  }

  Arrays& a_;
  Io& io_;
};

/// What the vertices and triangles of a surface carry: a place in space; error and RMS.
struct SurfaceForm {
  template <class Io>
  using Geometry = SpaceGeometry<Io>;
  template <class Io>
  using Values = ErrorsWithRms<Io>;
  static constexpr const char* kInvalidVertex = "has a vertex that is nowhere";

  /// Gives the writer's arrays the root's vertices, and what is one number of all triangles.
  static void prepare(Arrays& a, const MultiTriangulation& from) {
    for (std::uint32_t v = 0; v < from.rootVertexCount(); ++v)
      a.setPlace(v, from.vertices().place(VertexId(v)));
    const std::span<const std::uint16_t> rms = from.column(kRms);
    unsigned codes = 1u << ((1u << kShiftBits) - 1);
    bool isFirst = true;
    for (std::uint32_t t = 0; t < from.triangleIdCount(); ++t) {
      const std::uint16_t error = from.errorCode(TriangleId(t));
      codes |= unsigned{error} | rms[t];
      if (!isFirst || from.remover(TriangleId(t)).isValid()) continue;
      isFirst = false;
      a.finestError = error;
      a.finestRms = rms[t];
    }
    a.errorShift = static_cast<unsigned>(std::countr_zero(codes));
  }

  /// Codes the root's vertices: every coordinate as the difference from that of the vertex before. The
  /// writer's arrays hold them already; the reader's are filled.
  /// @return false if a coordinate is not finite
  template <class Io>
  static bool codeRootVertices(Arrays& a, Io& io) {
    const Coordinates coordinates(a);
    std::array<std::uint64_t, 3> last;
    last.fill(static_cast<std::uint64_t>(coordinates.whole(0)));
    for (std::uint32_t v = 0; v < a.rootVertices; ++v) {
      const Vec3 actual = a.place(v);
      std::array<double, 3> place = {actual.x, actual.y, actual.z};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto whole = static_cast<std::uint64_t>(coordinates.whole(place[k]));
        last[k] += static_cast<std::uint64_t>(
            codeSigned(io, kPlaceStream, kRootPlaceTable, static_cast<std::int64_t>(whole - last[k])));
        place[k] = coordinates.coordinate(static_cast<std::int64_t>(last[k]));
      }
      if (!isFinite({place[0], place[1], place[2]})) return false;
      a.setPlace(v, {place[0], place[1], place[2]});
    }
    return true;
  }
};

}  // namespace arete::packed
