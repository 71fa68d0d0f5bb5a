// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "io/query/request/cut_request.h"
#include "io/store/format/layout.h"

namespace arete {

/// Whether a model of this kind can answer all of a request: nothing in it is for the other kind, and nothing
/// excludes something else, so that no field is silently left aside. Errors: usage, with the field as
/// culprit. O(1).
Status checkRequest(const CutRequest& request, ModelKind kind);

}  // namespace arete
