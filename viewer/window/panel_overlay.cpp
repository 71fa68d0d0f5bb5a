// SPDX-License-Identifier: GPL-3.0-or-later
//
// Marks and help are drawn with ImGui over the picture; positions are projected as the picture is.
#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "viewer/window/panel.h"

namespace arete {
namespace {

constexpr ImU32 kVisible = IM_COL32(90, 220, 90, 190), kBlocked = IM_COL32(240, 70, 60, 200),
                kBehind = IM_COL32(200, 50, 45, 150), kUnknown = IM_COL32(170, 170, 170, 190);

}  // namespace

void drawMarks(const ViewerSession& s, double scale) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float em = ImGui::GetFontSize();
  const auto at = [&](const Vec3& metric) -> std::optional<ImVec2> {
    // ImGui places in points of the screen, the picture in pixels.
    const auto pixel = s.pixelOf(metric);
    if (!pixel) return std::nullopt;
    return ImVec2(float(pixel->x / scale), float(pixel->y / scale));
  };
  if (s.sight) {
    const SightPicture& sight = *s.sight;
    const SightVerdict verdict = sight.answer.sight.verdict;
    for (const SightPiece& piece : piecesOf(sight)) {
      const auto a = at(piece.from), b = at(piece.to);
      if (!a || !b) continue;
      const ImU32 color = verdict == SightVerdict::visible   ? kVisible
                          : verdict == SightVerdict::blocked ? (piece.isBefore ? kBlocked : kBehind)
                                                             : kUnknown;
      list.AddLine(*a, *b, color, (piece.isBefore ? 0.18f : 0.13f) * em);
    }
    if (const auto cross = sight.obstruction ? at(*sight.obstruction) : std::nullopt) {
      const float r = 0.45f * em;
      list.AddLine({cross->x - r, cross->y - r}, {cross->x + r, cross->y + r}, kBlocked, 0.2f * em);
      list.AddLine({cross->x - r, cross->y + r}, {cross->x + r, cross->y - r}, kBlocked, 0.2f * em);
    }
  }
  for (std::size_t i = 0; i < s.picks.size(); ++i) {
    const auto foot = at(s.picks[i].metric);
    if (!foot) continue;
    list.AddCircleFilled(*foot, 0.36f * em, IM_COL32(255, 255, 255, 230));
    list.AddCircleFilled(*foot, 0.25f * em, i == 0 ? IM_COL32(200, 30, 40, 255) : IM_COL32(30, 80, 200, 255));
    const std::string text = fmt::format("{}  {}", i == 0 ? "A" : "B", s.places.height(s.picks[i].height));
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
      "Keys, mouse and gamepad", &s.showsHelp,
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
    const auto keys = keyBindings();
    const std::size_t half = (keys.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i)
      for (const std::size_t k : {i, i + half}) {
        if (k >= keys.size()) continue;
        cell(keys[k].name);
        cell(keys[k].help);
      }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace arete
