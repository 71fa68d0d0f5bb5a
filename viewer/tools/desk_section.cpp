// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/tools/desk_section.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>

#include "viewer/panel/widgets.h"

namespace arete {
namespace {

using widget::dim;
using widget::em;
using widget::tip;

constexpr std::array<const char*, 6> kFaces = {"x from", "y from", "z from", "x to", "y to", "z to"};

void drawBox(SurfaceDesk& desk, const std::function<void(std::string)>& say) {
  bool isShown = desk.box().has_value();
  if (ImGui::Checkbox("box", &isShown)) desk.toggleBox();
  tip("A box along the axes of the file. The mouse drags its six handles; numbers are the file's.");
  if (!desk.box()) return;
  CropBox& box = *desk.box();
  ImGui::SameLine();
  if (ImGui::SmallButton("all of it")) box.box = box.whole();
  for (std::size_t face = 0; face < 6; ++face) {
    double value = box.bound(face);
    if (ImGui::InputDouble(kFaces[face], &value, 0, 0, "%.10g", ImGuiInputTextFlags_EnterReturnsTrue))
      box.setBound(face, value);
  }
  ImGui::InputText("##cropped", &desk.fields.cropped);
  ImGui::SameLine();
  if (ImGui::Button("crop")) say(desk.crop());
  ImGui::Checkbox("whole triangles", &desk.fields.keepsWhole);
  tip("Triangles that touch the box are kept whole; else they are cut at its faces.");
}

void drawDecimation(SurfaceDesk& desk, const std::function<void(std::string)>& say) {
  SurfaceDesk::Fields& f = desk.fields;
  if (ImGui::BeginCombo("method", f.method.c_str())) {
    for (const char* const method : decimationMethods())
      if (ImGui::Selectable(method, f.method == method)) f.method = method;
    ImGui::EndCombo();
  }
  ImGui::InputTextWithHint("most", "N or P%", &f.triangles);
  tip("The largest number of triangles, or a share of them: 5000, 10%.");
  ImGui::InputTextWithHint("error", "E or P%", &f.error);
  tip("The largest distance, in the unit of the file or as a share of the diagonal (measured).");
  ImGui::InputTextWithHint("options", " --keep-borders ...", &f.more);
  tip("Further options of arete mesh decimate.");
  ImGui::InputText("##decimated", &f.decimated);
  ImGui::SameLine();
  if (ImGui::Button("decimate")) say(desk.decimate());
}

}  // namespace

void drawDeskSection(SurfaceDesk& desk, const Camera& camera, const ViewSettings& settings,
                     const std::function<void(std::string)>& say) {
  if (!desk.surface() || !widget::section("Save, crop, decimate", !widget::isNarrow())) return;
  if (desk.isRunning()) {
    const auto progress = desk.progress();
    ImGui::ProgressBar(float(progress.fraction), {12 * em(), 0}, progress.stage.c_str());
    ImGui::SameLine();
    if (ImGui::Button("stop")) desk.cancel();
    return;
  }
  ImGui::InputText("##cut", &desk.fields.cut);
  tip("The ending says the format.");
  ImGui::SameLine();
  if (ImGui::Button("save this cut")) say(desk.saveCut(camera, settings));
  ImGui::Separator();
  drawBox(desk, say);
  ImGui::Separator();
  drawDecimation(desk, say);
  ImGui::Checkbox("show the result", &desk.fields.opens);
  tip("What is saved is opened in this window.");
  if (desk.lastCommand().empty()) return;
  if (ImGui::Button("copy the command")) ImGui::SetClipboardText(desk.lastCommand().c_str());
  tip(desk.lastCommand().c_str());
}

void drawBoxHandles(const SurfaceDesk& desk, const Subject& subject, const Camera& camera,
                    const ViewSettings& settings, double scale) {
  const std::optional<CropBox>& box = desk.box();
  if (!box) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (std::size_t face = 0; face < 6; ++face) {
    const auto pixel = pixelOf(subject, camera, box->handle(face), settings);
    if (!pixel) continue;
    const ImVec2 at(float(pixel->x / scale), float(pixel->y / scale));
    list.AddCircleFilled(at, 0.42f * em(), IM_COL32(255, 255, 255, 230));
    list.AddCircleFilled(at, 0.3f * em(),
                         box->held() == face ? IM_COL32(230, 60, 30, 255) : IM_COL32(255, 140, 0, 255));
  }
}

}  // namespace arete
