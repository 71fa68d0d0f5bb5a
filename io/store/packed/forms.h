// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/store/packed/heightfield/form.h"
#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/surface/form.h"

namespace arete::packed {

/// Calls f with the form of the vertices and triangles of an MT: the one place where packing and unpacking
/// tell the kinds of models apart.
template <class F>
auto withForm(const Arrays& arrays, const F& f) {
  if (!arrays.hasPlan()) return f(SurfaceForm{});
  return arrays.holdsFloats() ? f(HeightfieldForm<float>{}) : f(HeightfieldForm<double>{});
}

}  // namespace arete::packed
