// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/objects/objects_section.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/panel/widgets.h"

namespace arete {
namespace {

using widget::dim;
using widget::em;
using widget::row;
using widget::slider;

/// Rows of the list that are seen at once.
constexpr std::size_t kRows = 8;

void drawList(ObjectList& objects, const std::function<void(std::string)>& say) {
  const auto rows = float(std::min(objects.count(), kRows));
  ImGui::BeginChild("objects", {0, rows * ImGui::GetFrameHeightWithSpacing() + 4});
  ImGuiListClipper clipper;
  clipper.Begin(int(objects.count()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const auto at = std::size_t(i);
      ShownObject& object = objects.object(at);
      ImGui::PushID(i);
      ImGui::Checkbox("##shown", &object.isShown);
      ImGui::SameLine();
      if (ImGui::Selectable(objects.nameOf(at).c_str(), at == objects.selected(), 0, {8.5f * em(), 0}))
        say(objects.select(at));
      ImGui::SameLine();
      ImGui::TextUnformatted(object.isShown ? widget::grouped(object.figures.triangles).c_str() : "hidden");
      ImGui::PopID();
    }
  ImGui::EndChild();
}

void drawLevel(ObjectList& objects, const std::function<void(std::string)>& say) {
  ShownObject& object = objects.object();
  const SubjectFacts facts = objects.subject().facts();
  int kind = !object.level ? 0 : object.level->triangles > 0 ? 2 : 1;
  if (ImGui::Combo("level", &kind, "by the view\0an error\0triangles\0")) {
    const HandLevel error{.error = facts.largestError / 64},
        triangles{.triangles = std::max(object.figures.triangles, 4u)};
    say(objects.setLevel(kind == 0 ? std::nullopt : std::optional(kind == 1 ? error : triangles)));
  }
  if (!object.level) return;
  if (object.level->triangles > 0) {
    double most = object.level->triangles;
    if (slider("at most", most, 4, std::max(double(facts.triangles), 8.0), "%.0f", true))
      object.level->triangles = std::uint32_t(std::max(std::lround(most), 1L));
  } else {
    slider("within", object.level->error, 0, facts.largestError, "%.4g", false);
  }
}

void drawTurn(ObjectList& objects) {
  const std::optional<Turn> turn = objects.turn();
  if (!turn) return;
  Turn now = *turn;
  slider("heading", now.heading, -180, 180, "%.0f°");
  slider("pitch", now.pitch, -180, 180, "%.0f°");
  slider("roll", now.roll, -180, 180, "%.0f°");
  if (now != *turn) objects.setTurn(now);
}

}  // namespace

void drawObjectsSection(ObjectList& objects, const std::function<void(std::string)>& say) {
  const bool isOne = objects.count() == 1;
  const char* const one = objects.subject().isTerrain() ? "Terrain" : "Surface";
  if (!widget::section(isOne ? one : "Objects", !widget::isNarrow() && !isOne)) return;
  if (!isOne) drawList(objects, say);
  const SubjectFacts facts = objects.subject().facts();
  const ShownObject& object = objects.object();
  if (!isOne) {
    row("selected", objects.nameOf(objects.selected()));
    bool isAlone = objects.isAlone();
    if (ImGui::Checkbox("alone", &isAlone)) say(objects.toggleAlone());
    row("tolerance", fmt::format("{:.2f} px", object.figures.pixels));
  }
  row("triangles",
      fmt::format("{} of {}", widget::grouped(object.figures.triangles), widget::grouped(facts.triangles)));
  row("vertices", widget::grouped(facts.vertices));
  if (facts.materials > 0) row("materials", widget::grouped(facts.materials));
  const MetricBox& box = objects.subject().box();
  const Vec3 size = box.high - box.low;
  row("box", fmt::format("{:.4g} x {:.4g} x {:.4g}", size.x, size.y, size.z));
  row("coarsest", fmt::format("within {:.4g}", facts.largestError));
  drawLevel(objects, say);
  drawTurn(objects);
}

void drawDistanceSection(DistancePicks& distance, const ObjectList& objects, const std::string& unit) {
  if (!widget::section("Places and distance", !widget::isNarrow() || !distance.picks().empty())) return;
  if (distance.picks().empty())
    return dim("Click on the surface: one place shows its coordinates, two their distance.");
  for (std::size_t i = 0; i < distance.picks().size(); ++i) {
    const Pick& pick = distance.picks()[i];
    // One below the other: coordinates of a map have many digits.
    row(i == 0 ? "A" : "B", fmt::format("x {:.11g}", pick.inObject.x));
    row("", fmt::format("y {:.11g}", pick.inObject.y));
    row("", fmt::format("z {:.11g}", pick.inObject.z));
    if (objects.count() > 1) row("", objects.nameOf(pick.object));
    if (!pick.material.empty()) row("", pick.material);
    if (!pick.parts.empty()) row("", pick.parts);
    if (pick.drawnError) {
      row("", "of the drawn triangle:");
      row("", storedErrorText(*pick.drawnError, unit));
    }
  }
  if (distance.picks().size() == 2) {
    const Vec3 way = distance.way();
    row("distance", fmt::format("{:.7g}{}", norm(way), unit.empty() ? "" : " " + unit));
    row("", fmt::format("dx {:+.9g}", way.x));
    row("", fmt::format("dy {:+.9g}", way.y));
    row("", fmt::format("dz {:+.9g}", way.z));
  }
  if (ImGui::Button("clear")) return distance.clear();
  ImGui::SameLine();
  if (ImGui::Button("copy")) ImGui::SetClipboardText(distance.text(unit).c_str());
}

}  // namespace arete
