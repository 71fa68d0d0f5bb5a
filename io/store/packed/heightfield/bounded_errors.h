// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "io/store/entropy/numbers.h"
#include "io/store/packed/heightfield/areas.h"
#include "io/store/packed/heightfield/bounds.h"
#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/errors.h"
#include "io/store/packed/nodes/layout.h"
#include "io/store/packed/nodes/tables.h"

namespace arete::packed {

/// Codes the errors and bounds of the triangles of a heightfield.
/// @tparam Real  number type of the positions (Arrays::places())
/// @tparam Io    the reader's or the writer's, see node_coder.h
template <class Real, class Io>
class BoundedErrors {
 public:
  BoundedErrors(Arrays& arrays, Io& io) : a_(arrays), io_(io) {}

  /// Errors and bounds of all triangles of a run's stars that have a remover.
  /// @param passing  their slots, counted from the run's first
  /// @param areas    the shownArea() of each slot of the run
  void ofRun(const Run& run, unsigned bandClass, std::span<const std::uint32_t> passing,
             const std::uint8_t* areas) {
    const std::uint32_t first = a_.roots + run.firstSlot;
    valuesOf(run.band, bandClass, [&](const auto& visit) {
      for (const std::uint32_t slot : passing) visit(first + slot, areas[slot]);
    });
  }
  /// The same for the root's triangles, whose errors no band bounds.
  /// @param band  the highest one
  void ofRoot(std::uint32_t band, unsigned bandClass) {
    const Place<Real>* const place = a_.places<Real>();
    valuesOf(band, bandClass, [&](const auto& visit) {
      for (std::uint32_t t = 0; t < a_.roots; ++t) {
        const auto& corners = a_.rootTriangles[t];
        const Place<Real>&p = place[corners[0]], &q = place[corners[1]], &r = place[corners[2]];
        const Real area = (q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y);
        visit(t, shownArea(a_.isLattice, static_cast<float>(std::fabs(area))));
      }
    });
  }

 private:
  /// Codes the errors and bounds of triangles. Precondition: no error is above the band.
  /// @param forEach  forEach(visit) calls visit(id, shown area) for each triangle
  template <class ForEach>
  void valuesOf(std::uint32_t band, unsigned bandClass, const ForEach& forEach) {
    if (a_.isLattice && a_.encoding.type == HeightEncoding::Type::int16)
      valuesOf<true>(band, bandClass, forEach);
    else
      valuesOf<false>(band, bandClass, forEach);
  }
  template <bool kIsWhole, class ForEach>
  void valuesOf(std::uint32_t band, unsigned bandClass, const ForEach& forEach) {
    const std::uint32_t top = (band + 1) << MultiTriangulation::kBandShift;
    const std::uint32_t withoutError = boundReference(0, band);
    std::uint16_t *const error = a_.error.get(), *const below = a_.below.get(), *const above = a_.above.get();
    auto&& io = io_.values();
    forEach([&](std::uint32_t id, unsigned shown) {
      const std::uint32_t code = triangleError<kIsWhole>(io, id, shown, bandClass, top);
      const std::uint32_t reference = code != 0 ? boundStep(code) : withoutError;
      const BoundBytes bytes = io.bounds(id, reference);
      if constexpr (Io::kKeepsValues) {
        const BoundSteps bounds = boundsOf(bytes, reference);
        error[id] = static_cast<std::uint16_t>(code);
        below[id] = boundCode(bounds.below);
        above[id] = boundCode(bounds.above);
      }
    });
    io_.putBack(io);
  }

  template <bool kIsWhole, class Values>
  std::uint32_t triangleError(Values& io, std::uint32_t id, unsigned shown, unsigned bandClass,
                              std::uint32_t top) {
    const unsigned table = kErrorTable + kAreaClass[shown] * kErrorClasses + bandClass / 3;
    if (!kIsWhole || shown > kLatticeErrorArea || shown == 0) {
      const std::uint64_t below = codeNumber(io, kErrorStream, table, [&] {
        const std::uint16_t actual = io.actualError(id);
        return actual == 0 ? std::uint64_t{0} : std::uint64_t{top} - actual;
      });
      return below == 0 || below >= top ? 0 : top - static_cast<std::uint32_t>(below);
    }
    std::uint64_t whole = 0;
    const unsigned symbol = io.code(kErrorStream, table, [&] {
      const auto found = io.wholeError(shown, io.actualError(id));
      whole = found.value_or(0);
      return found ? bucketOf(whole).symbol : kPlainError;
    });
    if (symbol < 16) return a_.wholeErrors[shown * 16 + symbol];
    if (symbol == kPlainError) return static_cast<std::uint32_t>(io.raw(16, io.actualError(id)));
    const int bits = rawBitsOf(symbol);
    whole = bucketValue(symbol, io.raw(bits, whole & ((std::uint64_t{1} << bits) - 1)));
    return wholeErrorCode(a_.scale, a_.encoding, whole, shown);
  }

  Arrays& a_;
  Io& io_;
};

}  // namespace arete::packed
