// SPDX-License-Identifier: GPL-3.0-or-later
//
// Extensions of materials are data that materials keep (materials.h). What has a warning of its own, as
// lights have, is not named once more.
#include "io/formats/glb/extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "io/files/text_scan.h"

namespace arete {

namespace {

constexpr std::string_view kMaterials = "KHR_materials_";
constexpr std::array<std::string_view, 14> kRead = {"KHR_mesh_quantization",   "MSFT_lod",
                                                    "KHR_texture_transform",   "KHR_draco_mesh_compression",
                                                    "EXT_meshopt_compression", "KHR_meshopt_compression",
                                                    "EXT_mesh_gpu_instancing", "KHR_texture_basisu",
                                                    "EXT_texture_webp",        "EXT_texture_avif",
                                                    "MSFT_texture_dds",        "KHR_lights_punctual",
                                                    "KHR_xmp_json_ld",         "KHR_xmp"};

bool isRead(const std::string& name) {
  return name.starts_with(kMaterials) || std::ranges::find(kRead, name) != kRead.end();
}

std::vector<std::string> unknownIn(const nlohmann::json& document, const char* list) {
  std::vector<std::string> names;
  const auto found = document.find(list);
  if (found == document.end() || !found->is_array()) return names;
  for (const auto& name : *found)
    if (name.is_string() && !isRead(name.get_ref<const std::string&>())) names.push_back(name);
  return names;
}

}  // namespace

Status checkRequiredExtensions(const nlohmann::json& document) {
  const auto required = document.find("extensionsRequired");
  if (required == document.end()) return {};
  if (!required->is_array()) return failure(ErrorCode::corrupt, "\"extensionsRequired\" is not a list");
  const std::vector<std::string> names = unknownIn(document, "extensionsRequired");
  if (names.empty()) return {};
  std::string list;
  for (const std::string& name : names) {
    constexpr std::size_t kLongest = 400;
    if (list.size() > kLongest) {
      list += ", ...";
      break;
    }
    list += (list.empty() ? "" : ", ") + text::quotedToken(name);
  }
  return failure(ErrorCode::unsupported,
                 fmt::format("requires the extension {}, which Arete does not read", list));
}

std::vector<std::string> extensionsLeftOut(const nlohmann::json& document) {
  return unknownIn(document, "extensionsUsed");
}

const nlohmann::json* extensionOf(const nlohmann::json& part, const char* name) {
  const auto extensions = part.find("extensions");
  if (extensions == part.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() || !found->is_object() ? nullptr : &*found;
}

}  // namespace arete
