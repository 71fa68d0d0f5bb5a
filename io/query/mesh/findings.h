// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "surface/diagnosis/diagnosis.h"

namespace arete {

/// What the elements of a finding are.
enum class FindingElements : std::uint8_t { vertices, edge, faces, vertexAndEdge };

/// A kind of finding: where the diagnosis has it, and how it is named.
struct FindingKind {
  const MeshFindings* (*of)(const MeshDiagnosis& diagnosis);  ///< null: was not searched for
  FindingElements elements;
  const char* key;      ///< of JSON
  const char* one;      ///< "duplicate face"
  const char* several;  ///< "duplicate faces"
  bool isFault;         ///< else it is worth to know
};

/// All kinds, in the order in which they are listed.
std::span<const FindingKind> findingKinds();

/// "3 duplicate faces".
std::string countText(const FindingKind& kind, std::uint64_t count);

/// One line: whether the mesh is manifold, closed, coherent and of how many components, and its faults.
std::string verdictOf(const MeshDiagnosis& diagnosis);

bool isManifold(const MeshDiagnosis& diagnosis);
bool isClosed(const MeshDiagnosis& diagnosis);  ///< has triangles and no border
bool isOrientable(const MeshDiagnosis& diagnosis);
/// Whether it encloses a volume.
bool isSolid(const MeshDiagnosis& diagnosis);

}  // namespace arete
