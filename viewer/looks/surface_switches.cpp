// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/looks/surface_switches.h"

#include <imgui.h>

#include <array>
#include <cstddef>

#include "viewer/panel/widgets.h"

namespace arete {
namespace {

template <class Enum, std::size_t N>
void choice(const char* label, Enum& value, const std::array<const char*, N>& names) {
  if (!ImGui::BeginCombo(label, names[static_cast<std::size_t>(value)])) return;
  for (std::size_t i = 0; i < N; ++i)
    if (ImGui::Selectable(names[i], static_cast<std::size_t>(value) == i)) value = static_cast<Enum>(i);
  ImGui::EndCombo();
}

void two(const char* first, bool& one, const char* second, bool& other) {
  ImGui::Checkbox(first, &one);
  ImGui::SameLine(9.5f * widget::em());
  ImGui::Checkbox(second, &other);
}

}  // namespace

void drawSurfaceSwitches(ViewLook& look) {
  SurfaceLook& own = look.surface;
  if (look.coloring == Coloring::material) {
    two("textures", own.hasTextures, "materials", own.hasMaterialColors);
    ImGui::Checkbox("colours of vertices", &own.hasVertexColors);
  }
  choice("sides", own.sides, std::array{"as the material", "both alike", "front alone"});
  if (!look.isShaded) return;
  choice("normals", own.shading, std::array{"flat", "smooth", "the file's"});
  two("sun", own.hasSun, "sky", own.hasSky);
  two("headlight", own.hasHeadlight, "highlights", own.hasHighlights);
  bool goesWithEye = !look.sun;
  if (ImGui::Checkbox("sun goes with the eye", &goesWithEye))
    look.sun = goesWithEye ? std::optional<Sun>() : Sun{};
}

}  // namespace arete
