// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight/answer.h"

namespace arete {

std::string_view toString(NodataSight nodata) {
  return nodata == NodataSight::clear ? "clear" : nodata == NodataSight::blocked ? "blocked" : "unknown";
}

std::string_view toString(SightVerdict verdict) {
  switch (verdict) {
    case SightVerdict::visible:
      return "visible";
    case SightVerdict::blocked:
      return "blocked";
    case SightVerdict::unknown:
      return "unknown";
    default:
      return "undecided";
  }
}

}  // namespace arete
