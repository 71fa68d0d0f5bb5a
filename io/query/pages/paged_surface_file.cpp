// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/pages/paged_surface_file.h"

namespace arete {

Result<PagedSurfaceFile> PagedSurfaceFile::open(AmtContainer container) {
  if (!container.isOfSurface())
    return failure(ErrorCode::unsupported, "is of terrain, and a surface is wanted here", container.path());
  if (!container.isPaged()) return failure(ErrorCode::unsupported, "is not in pages", container.path());
  ARETE_TRY(SurfaceFacts facts, surfaceFacts(container));
  return PagedSurfaceFile(std::move(container), std::move(facts));
}

// A guess at what to read; where it cannot be made all is read, and says why.
double PagedSurfaceFile::errorBeyond(std::uint64_t nodes) const {
  return surfaceErrorBeyond(container_, nodes).value_or(0);
}

}  // namespace arete
