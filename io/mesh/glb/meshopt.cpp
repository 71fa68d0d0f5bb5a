// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/glb/meshopt.h"

namespace arete {

Result<std::string> decodeMeshopt(std::string_view, std::uint64_t, std::uint64_t, std::string_view,
                                  std::string_view) {
  return failure(ErrorCode::unsupported, "is compressed by meshopt, which this build does not read");
}

}  // namespace arete
