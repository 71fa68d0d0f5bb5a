// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/glb/draco.h"

namespace arete {

Result<DracoMesh> decodeDraco(std::string_view, std::uint64_t) {
  return failure(ErrorCode::unsupported, "is compressed by Draco, which this build does not read");
}

}  // namespace arete
