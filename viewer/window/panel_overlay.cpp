// SPDX-License-Identifier: GPL-3.0-or-later
//
// Marks and help are drawn with ImGui over the picture; positions are projected as the picture is.
#include <fmt/format.h>
#include <imgui.h>

#include <string>
#include <vector>

#include "viewer/window/panel.h"

namespace arete {
namespace {

constexpr ImU32 kBlocked = IM_COL32(240, 70, 60, 200);

}  // namespace

void drawMarks(const ViewerSession& s, double scale) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float em = ImGui::GetFontSize();
  const auto at = [&](const Vec3& metric) -> std::optional<ImVec2> {
    // ImGui places in points of the screen, the picture in pixels.
    const auto pixel = pixelOf(s.subject, s.rig.camera(), metric, s.settings);
    if (!pixel) return std::nullopt;
    return ImVec2(float(pixel->x / scale), float(pixel->y / scale));
  };
  if (s.tools && s.tools->sight) {
    const SightPicture& sight = *s.tools->sight;
    for (const SightPiece& piece : piecesOf(sight)) {
      const auto a = at(piece.from), b = at(piece.to);
      if (!a || !b) continue;
      const ImU32 color = IM_COL32(piece.color[0], piece.color[1], piece.color[2], 190);
      list.AddLine(*a, *b, color, (piece.isBefore ? 0.18f : 0.13f) * em);
    }
    if (const auto cross = sight.obstruction ? at(*sight.obstruction) : std::nullopt) {
      const float r = 0.45f * em;
      list.AddLine({cross->x - r, cross->y - r}, {cross->x + r, cross->y + r}, kBlocked, 0.2f * em);
      list.AddLine({cross->x - r, cross->y + r}, {cross->x + r, cross->y - r}, kBlocked, 0.2f * em);
    }
  }
  const std::vector<Pick>& picks = s.tools ? s.tools->picks : s.distance.picks();
  for (std::size_t i = 0; i < picks.size(); ++i) {
    const auto foot = at(picks[i].metric);
    if (!foot) continue;
    list.AddCircleFilled(*foot, 0.36f * em, IM_COL32(255, 255, 255, 230));
    list.AddCircleFilled(*foot, 0.25f * em, i == 0 ? IM_COL32(200, 30, 40, 255) : IM_COL32(30, 80, 200, 255));
    std::string text = i == 0 ? "A" : "B";
    if (s.tools) text += "  " + s.tools->places.height(picks[i].height);
    if (!s.tools && i == 1)
      text += fmt::format("  {:.6g} {}", norm(s.distance.way()), s.subject.heightUnit());
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    // A dark plate keeps the text readable on any terrain.
    const ImVec2 corner{foot->x + 0.7f * em, foot->y - 1.6f * em};
    list.AddRectFilled({corner.x - 0.3f * em, corner.y - 0.15f * em},
                       {corner.x + size.x + 0.3f * em, corner.y + size.y + 0.15f * em},
                       IM_COL32(20, 22, 28, 190), 0.25f * em);
    list.AddText(corner, IM_COL32(255, 255, 255, 255), text.c_str());
  }
}

void drawHelp(ViewerSession& s) {
  const ImGuiIO& io = ImGui::GetIO();
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
  ImGui::Begin(
      "Keys, mouse and gamepad", &s.shows.help,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse);
  constexpr ImGuiTableFlags kTable = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerH;
  const auto cell = [](std::string_view text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
  };
  if (ImGui::BeginTable("held", 3, kTable)) {
    ImGui::TableSetupColumn("held or moved");
    ImGui::TableSetupColumn("orbit");
    ImGui::TableSetupColumn("free flight");
    ImGui::TableHeadersRow();
    for (const HeldControl& c : heldControls()) {
      cell(c.what);
      cell(c.orbit);
      cell(c.free);
    }
    ImGui::EndTable();
  }
  ImGui::Dummy({0, 0.4f * em});
  if (ImGui::BeginTable("keys", 4, kTable)) {
    // The keys fill two pairs of columns, the first half on the left.
    std::vector<const KeyBinding*> keys;
    for (const KeyBinding& key : keyBindings())
      if (s.tools || key.refusal.empty()) keys.push_back(&key);
    const std::size_t half = (keys.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i)
      for (const std::size_t k : {i, i + half}) {
        if (k >= keys.size()) continue;
        cell(keys[k]->name);
        cell(keys[k]->help);
      }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace arete
