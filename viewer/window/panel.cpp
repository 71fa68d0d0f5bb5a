// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two columns of sections, one on either side of the picture: figures and settings of
// the drawing on the left, position and tools on the right.
#include "viewer/window/panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "viewer/looks/surface_switches.h"
#include "viewer/objects/objects_section.h"
#include "viewer/panel/widgets.h"
#include "viewer/tools/desk_section.h"

namespace arete {

using widget::beginColumn;
using widget::dim;
using widget::em;
using widget::endColumn;
using widget::grouped;
using widget::line;
using widget::megabytes;
using widget::row;
using widget::section;
using widget::showMessage;
using widget::slider;
using widget::tip;

void Panel::draw(ViewerSession& s, double scale) {
  drawMarks(s, scale);
  if (s.desk) drawBoxHandles(*s.desk, s.subject, s.rig.camera(), s.settings, scale);
  if (s.shows.help) drawHelp(s);
  CoveredEdges covered;
  if (s.shows.panel) {
    beginColumn("figures", false);
    frameSection(s);
    detailSection(s);
    if (s.objects) drawObjectsSection(*s.objects, [&](std::string sentence) { s.say(std::move(sentence)); });
    lookSection(s);
    layerSection(s);
    covered.left = endColumn();
    beginColumn("places", true);
    cameraSection(s);
    if (s.tools)
      pickSection(s, *s.tools);
    else if (s.objects)
      drawDistanceSection(s.distance, *s.objects, s.subject.heightUnit());
    if (s.desk)
      drawDeskSection(*s.desk, s.frozen.value_or(s.rig.camera()), s.cutSettings,
                      [&](std::string sentence) { s.say(std::move(sentence)); });
    flightSection(s);
    covered.right = endColumn();
  }
  // A picture of which hardly anything is free is filled as if all of it were.
  s.covered = covered.left + covered.right < 0.7 ? covered : CoveredEdges{};
  if (!s.message().empty()) showMessage(s.message());
  if (!s.cursor.text().empty()) widget::showStatus(s.cursor.text());
  if (s.question.isWaiting())
    if (const auto answer = widget::askQuestion(s.question.sentence(), "overwrite", "cancel"))
      s.answer(*answer);
}

void Panel::frameSection(ViewerSession& s) {
  if (!section("Frame", false)) return;
  const FrameHistory& h = s.history;
  // The scale reaches above the longest frame and the wanted time, and covers at least 4 ms.
  const double most = std::max({h.mostWork() * 1.1, s.wanted.frameMilliseconds * 1.5, 4.0});
  const std::string label = fmt::format("{:.1f} ms   {:.0f} frames/s", h.lastWork(), h.framesPerSecond());
  ImGui::PlotLines("##times", h.work().data(), int(FrameHistory::kFrames), int(h.first()), label.c_str(), 0,
                   float(most), {ImGui::GetContentRegionAvail().x, 3.2f * em()});
  tip("Cutting and drawing the last 180 frames. Frames per second count the wait for the screen as well.");
  if (s.wanted.frameMilliseconds > 0) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float y = high.y - (high.y - low.y) * float(s.wanted.frameMilliseconds / most);
    ImGui::GetWindowDrawList()->AddLine({low.x, y}, {high.x, y}, IM_COL32(120, 220, 140, 200));
  }
  const FrameFigures& f = s.figures;
  row("triangles", f.triangles == f.asked ? grouped(f.triangles)
                                          : fmt::format("{} of {}", grouped(f.triangles), grouped(f.asked)));
  row("tolerance", fmt::format("{:.2f} px asked, {:.2f} {}", s.wanted.pixels, f.pixels,
                               f.isComplete ? "kept" : "not kept"));
  if (s.settings.isGeomorphed) {
    row("moving", fmt::format("{} vertices", grouped(f.moving)));
    if (f.jumpPixels > 0) row("jump", fmt::format("{:.2f} px at most", f.jumpPixels));
  }
  row("cut, draw", fmt::format("{:.1f} ms, {:.1f} ms", f.cutMilliseconds, f.drawMilliseconds));
  row("memory",
      fmt::format("{}, {} on device", megabytes(s.device.residentBytes), megabytes(s.device.deviceBytes)));
  dim(s.device.renderer);
}

void Panel::detailSection(ViewerSession& s) {
  if (!section("Detail", false)) return;
  slider("tolerance", s.wanted.pixels, 0.25, 32, "%.2f px", true);
  tip("How far anything drawn may be from the model at full resolution, on the screen.");
  // 0 stands for any number.
  double triangles = s.wanted.maxTriangles;
  const double finest = std::min(double(s.subject.facts().triangles), 4e9);
  if (slider("most triangles", triangles, 0, std::max({finest, triangles, 1000.0}),
             triangles <= 0 ? "any number" : "%.0f", true))
    s.wanted.maxTriangles = s.settings.maxTriangles = std::uint32_t(std::max(std::lround(triangles), 0L));
  slider("frame time", s.wanted.frameMilliseconds, 0, 100,
         s.wanted.frameMilliseconds <= 0 ? "any" : "%.0f ms");
  tip("The tolerance is made coarser, up to 64 pixels, until frames take no longer; longer and longer while "
      "the "
      "camera is at rest.");
  ImGui::Checkbox("freeze cut", &s.isFrozen);
  tip("The cut stays as it is while the camera flies on.");
  ImGui::SameLine(9.5f * em());
  ImGui::Checkbox("geomorphing", &s.settings.isGeomorphed);
  if (s.isFrozen) ImGui::Checkbox("show what the frozen camera sees", &s.shows.frustum);
  if (!s.tools) return;
  // A device that cannot compute cuts leaves the processor as the only choice: the reason replaces the menu.
  int path = s.settings.path == CutPath::device ? 0 : 1;
  if (!s.device.refusal.empty()) {
    path = 1;
    dim("cut on the processor: " + s.device.refusal);
  } else if (ImGui::Combo("cut by", &path, "graphics device\0processor\0")) {
    s.settings.path = path == 0 ? CutPath::device : CutPath::processor;
  }
  if (path == 1) {
    slider("deadline", s.settings.cutMilliseconds, 0, 50,
           s.settings.cutMilliseconds <= 0 ? "none" : "%.0f ms");
    tip("A cut takes no longer; the next frame goes on with it.");
  }
}

void Panel::lookSection(ViewerSession& s) {
  if (!section("Look", false)) return;
  ViewLook& look = s.settings.look;
  const std::string colored =
      look.coloring == Coloring::ink ? look.ink : std::string(toString(look.coloring));
  if (ImGui::BeginCombo("colour by", colored.c_str())) {
    for (const Coloring coloring : s.subject.colorings())
      if (ImGui::Selectable(std::string(toString(coloring)).c_str(), coloring == look.coloring))
        look.coloring = coloring;
    for (const std::string& ink : s.subject.inks())
      if (ImGui::Selectable(ink.c_str(), look.coloring == Coloring::ink && look.ink == ink))
        s.say(s.colorByInk(ink));
    ImGui::EndCombo();
  }
  if (look.coloring == Coloring::error && s.tools) {
    slider("hottest", look.heatError, 0, s.tools->model().mt.largestError(),
           look.heatError <= 0 ? "chosen" : "%.2f", true);
    tip("The error of the hottest colour, in the unit of heights.");
  }
  ImGui::Checkbox("shading", &look.isShaded);
  ImGui::SameLine(9.5f * em());
  ImGui::Checkbox("wireframe", &look.hasWireframe);
  if (look.isShaded) {
    Sun sun = look.sun.value_or(Sun{});
    const bool isTurned = slider("sun azimuth", sun.azimuthDegrees, 0, 360, "%.0f°");
    if (slider("sun height", sun.elevationDegrees, 0, 90, "%.0f°") || isTurned) look.sun = sun;
  }
  ImGui::Checkbox("axes", &s.shows.marks.axes);
  tip("X red, Y green, Z blue, of the file; their lengths are in the legend.");
  ImGui::SameLine(9.5f * em());
  ImGui::Checkbox("ground grid", &s.shows.marks.grid);
  ImGui::Checkbox("orbit's centre", &s.shows.marks.orbit);
  if (!s.tools || (s.objects && s.objects->count() > 1)) drawSurfaceSwitches(look);
  if (!s.tools) return;
  // The curved Earth is drawn in perspective only.
  if (!s.tools->model().georeference.crsWkt.empty() && !(s.rig.camera().parallelHeight > 0))
    ImGui::Checkbox("curved Earth", &s.settings.isCurved);
  slider("heights times", s.settings.stretch, 0.5, 10, "%.2f", true);
  slider("haze", look.hazeKilometres, 0, 200, look.hazeKilometres <= 0 ? "none" : "%.0f km", true);
}

void Panel::layerSection(ViewerSession& s) {
  if (!section("Layers", !widget::isNarrow())) return;
  bool hasContours = s.layers.find("contours") != nullptr;
  if (s.tools && ImGui::Checkbox("draw contours", &hasContours)) s.apply(Action::contours);
  // The highest is the first of the list.
  std::vector<Layer>& list = s.layers.list();
  for (std::size_t i = list.size(); i-- > 0;) {
    Layer& layer = list[i];
    ImGui::PushID(layer.name.c_str());
    ImGui::Checkbox(layer.name.c_str(), &layer.isVisible);
    ImGui::SameLine(9.5f * em());
    ImGui::PushItemWidth(4 * em());
    slider("##opacity", layer.opacity, 0, 1, "%.2f");
    tip("Opacity.");
    ImGui::PopItemWidth();
    if (auto* contours = std::get_if<Contours>(&layer.content)) {
      // The box is in metres; contours are in the DEM's unit of height.
      const double range =
                       (s.subject.box().high.z - s.subject.box().low.z) / s.subject.space().metresPerHeight(),
                   least = usualContourInterval(range) / 20;
      slider("##interval", contours->interval, least, std::max(range, 2 * least), "every %.3g", true);
    }
    ImGui::SameLine();
    const bool isRaised = ImGui::ArrowButton("up", ImGuiDir_Up);
    ImGui::PopID();
    if (!isRaised) continue;
    s.layers.move(i, true);
    break;
  }
}

void Panel::cameraSection(ViewerSession& s) {
  if (!section("Camera", false)) return;
  const Camera& camera = s.rig.camera();
  if (s.tools) {
    const PlaceText& places = s.tools->places;
    row("place", places.xy(camera.xy));
    if (places.hasLonLat() && !places.isLonLat()) {
      const std::string lonLat = places.lonLat(camera.xy);
      row("", lonLat.empty() ? "no longitude and latitude" : lonLat);
    }
    row("height", places.height(camera.height));
  } else {
    const Vec3 eye = s.subject.inFile(s.subject.space().position(camera));
    row("eye", fmt::format("{:.5g}, {:.5g}, {:.5g}", eye.x, eye.y, eye.z));
  }
  if (const auto above = s.rig.metresAboveGround()) row("", fmt::format("{:.1f} m above ground", *above));
  row("heading", fmt::format("{:.1f}°, pitch {:+.1f}°", camera.azimuthDegrees, camera.pitchDegrees));
  const double flown = s.rig.lastMetresPerSecond();
  row("speed", s.tools ? fmt::format("{:.1f} m/s", flown) : fmt::format("{:.3g} /s", flown));

  int mode = s.rig.mode() == CameraMode::orbit ? 0 : 1;
  if (ImGui::RadioButton("orbit", &mode, 0)) s.rig.setMode(CameraMode::orbit);
  ImGui::SameLine();
  if (ImGui::RadioButton("free flight", &mode, 1)) s.rig.setMode(CameraMode::free);
  bool follows = s.rig.follows();
  if (s.tools) {
    ImGui::SameLine();
    if (ImGui::Checkbox("follow", &follows)) s.rig.follow(follows);
  }
  if (s.rig.mode() == CameraMode::free) {
    // Speed and floor are of the free flight. The speed's range follows the size of the terrain.
    double speed = s.rig.metresPerSecond();
    const double diagonal = s.subject.box().diagonal();
    if (slider("fly at", speed, 1e-5 * diagonal, diagonal, s.tools ? "%.1f m/s" : "%.3g /s", true))
      s.rig.setMetresPerSecond(speed);
  }
  if (s.rig.mode() == CameraMode::free && s.tools) {
    double floor = s.rig.floorMetres();
    if (slider("floor", floor, 0, 200, floor <= 0 ? "none" : "%.1f m", true)) s.rig.setFloorMetres(floor);
    tip("The camera stays so far above the terrain. 0: it may go anywhere, below it too.");
  }
  double field = camera.verticalFieldOfViewDegrees;
  bool isParallel = camera.parallelHeight > 0;
  if (!s.settings.isCurved && ImGui::Checkbox("parallel", &isParallel)) s.rig.setParallel(isParallel);
  double high = camera.parallelHeight;
  const double largest = 10 * s.subject.box().diagonal();
  if (isParallel) {
    if (slider("picture high", high, 1e-6 * largest, largest, s.tools ? "%.4g m" : "%.4g", true))
      s.rig.setParallelHeight(high);
  } else if (slider("field of view", field, 5, 120, "%.0f°")) {
    s.rig.setFieldOfView(field);
  }
  for (const HomeView view : kHomeViews) {
    if (view != HomeView::overview) ImGui::SameLine(0, 3);
    const std::string name = view == HomeView::overview ? "home" : std::string(toString(view));
    if (ImGui::SmallButton(name.c_str())) {
      s.home(view);
    }
  }
  if (!s.tools) return;
  bool goes = ImGui::InputTextWithHint("##goal", isGoalLonLat_ ? "lon,lat or lon,lat,H" : "X,Y or X,Y,H",
                                       &goal_, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  goes = ImGui::Button("go") || goes;
  if (s.tools->places.hasLonLat()) {
    ImGui::SameLine();
    ImGui::Checkbox("lon,lat", &isGoalLonLat_);
  }
  if (goes && !goal_.empty()) s.goTo(goal_, isGoalLonLat_);
}

void Panel::pickSection(ViewerSession& s, TerrainTools& tools) {
  if (!section("Points and sight", !widget::isNarrow() || !tools.picks.empty())) return;
  if (tools.picks.empty())
    return dim("Click on the terrain: one point shows its height, two a line of sight.");
  for (std::size_t i = 0; i < tools.picks.size(); ++i) {
    const Pick& pick = tools.picks[i];
    row(i == 0 ? "A" : "B", tools.places.xy(pick.xy));
    const std::string lonLat = tools.places.isLonLat() ? std::string() : tools.places.lonLat(pick.xy);
    if (!lonLat.empty()) row("", lonLat);
    row("", tools.places.height(pick.height));
    if (pick.drawnError) {
      row("", "of the drawn triangle:");
      row("", storedErrorText(*pick.drawnError, s.subject.heightUnit()));
    }
  }
  bool isMoved = slider("A above ground", tools.observerAbove, 0, 200, "%.1f", true);
  isMoved = slider("B above ground", tools.targetAbove, 0, 200, "%.1f", true) || isMoved;
  if (isMoved) s.say(tools.updateSight());
  // Only the first line, the verdict, has a colour: green for visible, red for blocked, grey for what is
  // open.
  if (tools.sight) {
    const SightVerdict verdict = tools.sight->answer.sight.verdict;
    const ImVec4 color = verdict == SightVerdict::visible   ? ImVec4(0.45f, 0.90f, 0.45f, 1)
                         : verdict == SightVerdict::blocked ? ImVec4(1.00f, 0.45f, 0.40f, 1)
                                                            : ImVec4(0.75f, 0.75f, 0.75f, 1);
    ImGui::PushTextWrapPos(0);
    for (std::size_t i = 0; i < tools.sight->text.size(); ++i)
      i == 0 ? ImGui::TextColored(color, "%s", tools.sight->text[i].c_str()) : line(tools.sight->text[i]);
    ImGui::PopTextWrapPos();
  }
  if (tools.viewshed.isRunning()) {
    ImGui::ProgressBar(float(tools.viewshed.progress()), {9.2f * em(), 0});
    ImGui::SameLine();
    if (ImGui::Button("cancel")) tools.viewshed.cancel();
  } else if (tools.model().isRaster) {
    if (ImGui::Button(tools.picks.size() == 1 ? "viewshed of A" : "viewshed of B"))
      s.say(tools.startViewshed());
    tip("What is seen from there, at the height of A above ground, of targets at the height of B.");
    ImGui::SameLine();
  }
  if (ImGui::Button("clear")) tools.clear();
  if (tools.overlay)
    dim(fmt::format("viewshed: {} of {} samples seen", grouped(tools.overlay->seen),
                    grouped(tools.overlay->cells)));
}

void Panel::flightSection(ViewerSession& s) {
  if (!section("Flight", !s.deck.plan().keys.empty())) return;
  FlightDeck& deck = s.deck;
  const std::size_t count = deck.plan().keys.size();
  if (ImGui::Button("set key")) s.apply(Action::setKeyFrame);
  ImGui::SameLine();
  if (ImGui::Button(deck.isPlaying() ? "stop" : "play")) s.apply(Action::playFlight);
  ImGui::SameLine();
  if (ImGui::Button("forget") && count > 0) deck.clear();
  ImGui::SameLine();
  if (ImGui::Button("around")) s.flyAround();
  tip("A flight around the inside of a terrain, or around a surface.");
  if (deck.isPlaying()) {
    const std::string text = fmt::format("{:.1f} of {:.1f} s", deck.seconds(), deck.duration());
    const double part =
        deck.duration() > 0 ? std::fmod(deck.seconds(), deck.duration()) / deck.duration() : 0;
    ImGui::ProgressBar(float(part), {-1, 0}, text.c_str());
  }
  if (count > 0) {
    ImGui::BeginChild("keys", {0, std::min(float(count), 5.0f) * ImGui::GetTextLineHeightWithSpacing() + 4});
    for (std::size_t i = 0; i < deck.plan().keys.size(); ++i) {
      const Camera& key = deck.plan().keys[i];
      ImGui::PushID(int(i));
      // A removal shifts the keys behind it, so the rest of the list waits for the next frame.
      if (ImGui::SmallButton("x")) {
        deck.removeKey(i);
        ImGui::PopID();
        break;
      }
      ImGui::SameLine();
      const std::string text =
          s.tools ? fmt::format("{}  {}  {}", i + 1, s.tools->places.xy(key.xy),
                                s.tools->places.height(key.height))
                  : fmt::format("{}  {:.4g}, {:.4g}, {:.4g}", i + 1, key.xy.x, key.xy.y, key.height);
      if (ImGui::Selectable(text.c_str())) {
        deck.stop();
        s.rig.place(key);
      }
      ImGui::PopID();
    }
    ImGui::EndChild();
    FlightPlan plan = deck.plan();
    double speed = plan.speed.value_or(0);
    const double diagonal = s.subject.box().diagonal();
    // A plan has a duration or a speed. With a duration the slider shows it, and moving the slider replaces
    // it.
    const std::string format = plan.duration ? fmt::format("for {:.1f} s", *plan.duration) : "%.1f m/s";
    if (slider("speed", speed, 1e-5 * diagonal, diagonal / 5, format.c_str(), true)) {
      plan.speed = speed;
      plan.duration.reset();
      deck.setPlan(plan);
    }
    bool isClosed = plan.isClosed;
    if (ImGui::Checkbox("round and round", &isClosed)) {
      plan.isClosed = isClosed;
      deck.setPlan(plan);
    }
  }
  // The fields start with the session's paths; from then on what is typed sets these.
  if (!hasSetFlightPath_) {
    flightPath_ = s.files.flight.string();
    framesFolder_ = s.files.framesFolder.string();
    hasSetFlightPath_ = true;
  }
  if (ImGui::InputText("##path", &flightPath_)) s.files.flight = flightPath_;
  ImGui::SameLine();
  if (ImGui::Button("save")) s.apply(Action::saveFlight);
  ImGui::SameLine();
  if (ImGui::Button("load")) s.apply(Action::loadFlight);
  if (ImGui::InputText("##frames", &framesFolder_)) s.files.framesFolder = framesFolder_;
  tip("The folder for the frames of the flight as PNG files.");
  ImGui::SameLine();
  if (ImGui::Button(s.files.wantsFrames ? "stop frames" : "render frames")) s.toggleFrames();
}

}  // namespace arete
