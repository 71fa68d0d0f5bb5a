// SPDX-License-Identifier: GPL-3.0-or-later
//
// A round flight over the DEM at 1280x720 and one pixel of error, drawn without a screen, by either path of
// the cut. What draws is in the variant's name: a graphics card, or Mesa's software renderer, whose times are
// the processor's.
#include <fmt/format.h>

#include <algorithm>

#include "bench/sources.h"
#include "bench/stages/stages.h"
#include "terrain/locate/ground_height.h"
#include "viewer/camera/home_view.h"
#include "viewer/camera/round_flight.h"
#include "viewer/headless/headless.h"

namespace arete::bench {
namespace {

constexpr int kFrames = 120;

/// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 ..." as "llvmpipe".
std::string shortName(const std::string& renderer) {
  return renderer.substr(0, std::min(renderer.find(" ("), renderer.find(',')));
}

}  // namespace

Result<Figures> viewStage(const DemSource& source, const std::string& path, const Plan&) {
  ARETE_TRY(const TerrainModel model, loadModel(path));
  const GroundHeights heights(model);
  const CameraSpace space(model);
  ARETE_TRY(const auto plan, roundFlight(heights, space, metricBox(model)));
  ARETE_TRY(const auto flight, Flight::create(plan, space));
  Figures figures;
  for (const CutPath cutPath : {CutPath::device, CutPath::processor}) {
    HeadlessOptions options{.widthPixels = 1280, .heightPixels = 720, .samples = 1, .settings = {}};
    options.settings.path = cutPath;
    ARETE_TRY(HeadlessView view, HeadlessView::create(model, options));
    if (cutPath == CutPath::device && !view.scene().deviceRefusal().empty()) continue;
    std::vector<double> cut, draw, triangles, rate;
    for (int i = 0; i <= kFrames; ++i) {
      // The whole round in so many frames, each far from the last.
      ARETE_TRY(const auto frame, view.draw(flight.at(flight.duration() * i / kFrames)));
      if (i == 0) continue;  // compiles, starts at the root
      cut.push_back(frame.cutMilliseconds);
      draw.push_back(frame.drawMilliseconds);
      triangles.push_back(frame.triangles);
      rate.push_back(frame.triangles / (frame.drawMilliseconds * 1e-3));
    }
    const std::string variant =
        fmt::format("{}, {}", cutPath == CutPath::device ? "device's cut" : "processor's cut",
                    shortName(view.description()));
    const auto add = [&](const char* name, double value, const char* unit, Better better) {
      figures.push_back({source.name, "view", variant, name, value, unit, better});
    };
    add("triangles", quantile(triangles, 0.5), "", Better::neither);
    add("cut", quantile(cut, 0.5), "ms", Better::lower);
    add("cut, 99 %", quantile(cut, 0.99), "ms", Better::lower);
    add("draw", quantile(draw, 0.5), "ms", Better::lower);
    add("rate", quantile(rate, 0.5), "triangles/s", Better::higher);
  }
  return figures;
}

}  // namespace arete::bench
