// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cpl_error.h>

#include "engine/base/result.h"

namespace arete {

/// Hands an error to the handler of GDAL's errors.
inline void reportError(const Error& error) {
  const CPLErrorNum number = error.code == ErrorCode::notFound      ? CPLE_OpenFailed
                             : error.code == ErrorCode::usage       ? CPLE_IllegalArg
                             : error.code == ErrorCode::outOfMemory ? CPLE_OutOfMemory
                                                                    : CPLE_AppDefined;
  CPLError(CE_Failure, number, "%s", error.describe().c_str());
}

}  // namespace arete
