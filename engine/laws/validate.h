// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"

namespace arete {

struct ValidateOptions {
  /// The build allowed rims to cover NODATA: a floor may then cover more than its star (law 2), and a front
  /// more than the finest one (law 5).
  bool allowsFills = false;
};

/// Checks laws 1, 2, 3, 4 and 6 of docs/topics/multitriangulation.md on every node, and the order of the
/// arrays. Errors: brokenPromise: the violation with the smallest node; the message names the law, the node
/// and the triangles.
///   1  acyclic: a floor's triangles were created by older nodes
///   2  floor and ceiling have the same boundary cycle and, of a heightfield, the same signed area
///   3  one creator, at most one remover, no triangle twice
///   4  minimal: the floor is one polygon, connected across its inner edges, and no part of it is a
///      modification by itself
///   6  saturated errors and spheres contain the node's own and its children's, those of clusters and cluster
///      groups their nodes'
/// Orientation is evaluated in double precision with an error bound, and reported only if it is certainly
/// wrong; terrain/laws checks it exactly. Precondition: indices are in range. O(triangles), parallel.
Status validate(const MultiTriangulation& mt, const ValidateOptions& options = {},
                const RunContext& context = {});

/// The domain of the multitriangulation of a heightfield: the area that its finest front covers.
struct DomainExtent {
  double area = 0;          ///< of the plan
  double borderLength = 0;  ///< outer border and rims
};
DomainExtent domainExtent(const MultiTriangulation& mt);

/// Law 5 on one front of a heightfield (of a surface: surface/laws/validate_surface.h): every triangle
/// positively oriented; every edge with one or two triangles, in opposite directions; areas that sum to the
/// domain's, borders as long as the domain's (so no T-junction and no overlap). O(triangles), parallel.
Status validateFront(const MultiTriangulation& mt, const Cut& cut, const DomainExtent& domain,
                     const ValidateOptions& options = {});

}  // namespace arete
