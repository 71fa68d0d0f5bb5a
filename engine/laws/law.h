// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

namespace arete {

/// A law of docs/topics/multitriangulation.md, in the words that people read. Empty: it is not one of that
/// kind of model.
struct Law {
  int number;
  std::string_view ofTerrain, ofSurfaces;
};

/// Every law, by number.
inline constexpr std::array<Law, 10> kLaws = {{
    {1, "every parent is older than its child", "every parent is older than its child"},
    {2, "a node's floor and ceiling cover the same region",
     "a node's floor and ceiling have the same boundary"},
    {3, "a triangle has one creator, at most one remover, and occurs once",
     "a triangle has one creator, at most one remover, and occurs once"},
    {4, "no part of a node is a modification by itself", "no part of a node is a modification by itself"},
    {5, "every front is a conforming triangulation of the domain",
     "fronts are oriented manifolds of the topology of the source"},
    {6, "saturated errors and spheres contain those of the children",
     "saturated errors and spheres contain those of the children"},
    {7, "fixed vertices are in the root", ""},
    {8, "the finest front is the source's samples", "the finest front has all faces that the build kept"},
    {9, "every front is Delaunay", ""},
    {10, "stored errors and bounds are at least the true ones",
     "every sample of the source lies within the error of a triangle, in every front"},
}};

}  // namespace arete
