// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/warning.h"

namespace arete {

std::string_view nameOf(WarningCode code) {
  switch (code) {
    case WarningCode::position:
      return "position";
    case WarningCode::unit:
      return "unit";
    case WarningCode::heights:
      return "heights";
    case WarningCode::choice:
      return "choice";
    case WarningCode::omitted:
      return "omitted";
    case WarningCode::completed:
      return "completed";
    case WarningCode::geometry:
      return "geometry";
    case WarningCode::damaged:
      return "damaged";
    case WarningCode::bound:
      return "bound";
    case WarningCode::library:
      return "library";
    case WarningCode::display:
      return "display";
  }
  return "unknown";
}

}  // namespace arete
