// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// Errors: unsupported: a glTF requires an extension that is not read; all of them are named.
Status checkRequiredExtensions(const nlohmann::json& document);

/// The names of the extensions that a glTF uses, without need, and that are neither read nor kept.
std::vector<std::string> extensionsLeftOut(const nlohmann::json& document);

/// An extension of a part of a glTF; nothing if the part does not have it.
const nlohmann::json* extensionOf(const nlohmann::json& part, const char* name);

}  // namespace arete
