// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "io/store/packed/nodes/layout.h"
#include "surface/model/surface_model.h"

namespace arete::packed {

/// What vertices and triangles of a surface in pages carry (docs/topics/amt-format.md, "Surfaces in pages"):
/// the numbers of the source, wedges, displacements, errors of attributes, and all values. Each segment of a
/// page has it for its nodes, behind their streams, so that a part is a model in itself.
struct CarriedBytes {
  std::vector<std::byte> tables;                            ///< the chunk PNUM
  std::vector<std::vector<std::vector<std::byte>>> ofPage;  ///< by page, by segment
  std::vector<std::byte> rest;  ///< the chunk ATTR: values of wedges and faces that no triangle has
};

/// @param model  in the order of the MT that the pages unpack to; its wedges are numbered as the pages name
///               them first, those of no corner last, and coarse triangles without faces of their own inherit
///               them (inheritFaces())
/// @param pages  all of them, with their runs and segments; numbered
/// Precondition: model.validate(). O(size), one thread.
CarriedBytes packCarried(SurfaceModel& model, const Directory& pages);

/// The chunks beside the pages.
struct CarriedChunks {
  std::span<const std::byte> tables, rest;
};

/// Fills vertexOf, faceOf, wedgesOf, displacement, and the values of attributes and of their errors.
///
/// @param nodes  the bytes of all pages, of which `pages` are loaded
/// @param pages  those that were unpacked, with their headers read
/// @param isPart some of the whole model's pages, or nodes of a page, were not unpacked: faces with values
/// are
///               numbered anew (SurfaceModel::partFaces), and wedges
/// @param model  everything else; attributes and errors are declared and have no values; faces that have
///               objects, groups, materials or numbers have one of each
/// Errors, without a culprit: corrupt. Numbers are below the counts of the metadata; a part's wedges and
/// faces are numbers of rows. O(size), one thread.
Status unpackCarried(const CarriedChunks& chunks, std::span<const std::byte> nodes, const Directory& pages,
                     bool isPart, SurfaceModel& model);

}  // namespace arete::packed
