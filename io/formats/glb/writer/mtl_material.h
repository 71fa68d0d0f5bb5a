// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

namespace arete {

/// Adds to the material of a glTF what the statements of an MTL say, as Blender reads them: Pm and Pr are
/// metallic and roughness, Ns makes a roughness where there is no Pr, Ke is emissive, brighter than 1 by
/// KHR_materials_emissive_strength. Without statements the material is not metallic and rough.
///
/// @param lost Gets the names of the statements that have no place; Kd, d and Tr are in Material's fields.
void addMtlStatements(std::string_view statements, nlohmann::ordered_json& material,
                      std::set<std::string>& lost);

}  // namespace arete
