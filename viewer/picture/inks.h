// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/picture/picture.h"

namespace arete {

// The inks that maps, charts and legends share.

inline constexpr Rgb kInk = {34, 38, 46};
inline constexpr Rgb kQuietInk = {104, 110, 120};
inline constexpr Rgb kRule = {188, 193, 200};

}  // namespace arete
