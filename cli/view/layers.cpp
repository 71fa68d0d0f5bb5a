// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/view/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "io/geo/drape/class_names.h"
#include "terrain/sight/grid.h"
#include "terrain/sight/profile.h"
#include "viewer/layers/polygon_fill.h"
#include "viewer/layers/vector_layer.h"

namespace arete {
namespace {

/// A name that no layer has yet.
std::string unlike(const std::string& name, const std::vector<std::string>& others) {
  std::string made = name;
  for (int i = 2; std::ranges::find(others, made) != others.end(); ++i) made = fmt::format("{} {}", name, i);
  return made;
}

Error inLayer(Error error, const std::string& option) {
  error.culprit = fmt::format("{} {}", option, error.culprit);
  return error;
}

/// Of a picture of classes; empty of others.
Result<Legend> drapeLegend(const std::string& file, const std::vector<int>& bands, double opacity) {
  ARETE_TRY(const auto classes, readDrapeClasses(file, bands));
  Legend legend;
  legend.title = std::filesystem::path(file).filename().string();
  if (opacity < 1) legend.title += fmt::format(", {:.0f} % opaque", 100 * opacity);
  for (const DrapeClass& c : classes)
    legend.entries.push_back({Rgba{c.color[0], c.color[1], c.color[2], c.color[3]}, c.name});
  return legend;
}

}  // namespace

Result<StatedLayers> StatedLayers::read(const AppearanceArguments& arguments,
                                        const std::shared_ptr<const TerrainModel>& model, Session& session) {
  StatedLayers all;
  // Those that the window lays itself.
  std::vector<std::string> names = {"contours", "heights of contours", "viewshed", "line of sight",
                                    "flight",   "frozen camera"};
  const auto named = [&](const std::string& name) { return names.emplace_back(unlike(name, names)); };
  ARETE_TRY(all.drapeOptions_, arguments.drapeOptions());
  for (const std::string& text : arguments.drapes) {
    auto stated = readFileWithKeys(text, {"opacity"});
    if (!stated) return tl::unexpected(inLayer(stated.error(), "--drape"));
    Drape drape{.name = named("drape"), .file = stated->file};
    if (const auto opacity = stated->values.find("opacity"); opacity != stated->values.end()) {
      auto value = readOpacity(opacity->second);
      if (!value) return tl::unexpected(inLayer(value.error(), "--drape"));
      drape.opacity = *value;
    }
    all.drapes_.push_back(std::move(drape));
  }
  std::shared_ptr<const SightGrid> grid;
  for (const std::string& text : arguments.layers) {
    auto stated = LayerArgument::of(text, all.vectors_.size());
    if (!stated) return tl::unexpected(inLayer(stated.error(), "--layer"));
    ARETE_TRY(const FeatureLayer layer, readFeatures(stated->file, *model, stated->read, session.context()));
    if (!grid && model->isRaster && !layer.lines.empty()) grid = std::make_shared<const SightGrid>(*model);
    auto ground = layOnGround(layer, Profiles(*model, grid), stated->ground, session.context());
    if (!ground) {
      session.warn(layer.warnings, stated->file);
      Error error = ground.error();
      error.culprit = stated->file;
      return tl::unexpected(error);
    }
    session.warn(ground->warnings, stated->file);
    const std::string stem = std::filesystem::path(stated->file).stem().string();
    std::string name = !stated->title.empty()       ? stated->title
                       : stated->read.layer.empty() ? stem
                                                    : fmt::format("{} {}", stem, stated->read.layer);
    std::shared_ptr<const PlanPicture> fill;
    if (stated->fill > 0) {
      if (layer.polygons == 0)
        return failure(ErrorCode::usage, "the layer has no polygon to fill", fmt::format("--layer {}", text));
      if (auto made = fillOf(layer, *model, stated->style.color))
        fill = std::make_shared<const PlanPicture>(std::move(*made));
    }
    all.vectors_.push_back({named(name), std::move(*stated),
                            std::make_shared<const GroundFeatures>(std::move(*ground)), std::move(fill)});
  }
  return all;
}

Status StatedLayers::addTo(Scene& scene, const TerrainModel& model, Session& session) const {
  for (const Drape& stated : drapes_) {
    ARETE_TRY(DrapeOnGpu drape, DrapeOnGpu::load(stated.file, model, drapeOptions_, session.context()));
    session.warn(drape.warnings(), stated.file);
    Layer& layer = scene.layers.put(stated.name, std::make_shared<const DrapeOnGpu>(std::move(drape)));
    layer.opacity = stated.opacity;
    ARETE_TRY(layer.legend, drapeLegend(stated.file, drapeOptions_.read.bands, stated.opacity));
  }
  if (vectors_.empty()) return {};
  ARETE_TRY(const auto tools, VectorLayerTools::create());
  for (const Vector& stated : vectors_) {
    if (stated.fill) {
      Layer& areas = scene.layers.put(stated.name + " (areas)", stated.fill);
      areas.opacity = stated.stated.fill;
      const Rgb& color = stated.stated.style.color;
      areas.legend = {.title = stated.name, .entries = {{{color.r, color.g, color.b, 255}, "areas"}}};
    }
    const auto content = std::make_shared<VectorLayer>(stated.features, stated.stated.style, tools);
    Layer& layer = scene.layers.put(stated.name, Layer::Drawn(content));
    layer.opacity = stated.stated.style.opacity;
    layer.legend = content->legend(stated.name);
  }
  return {};
}

void StatedLayers::warnOfLabels(const Scene& scene, Session& session) const {
  for (const Vector& stated : vectors_) {
    const Layer* const layer = scene.layers.find(stated.name);
    const auto* const drawn = layer ? std::get_if<Layer::Drawn>(&layer->content) : nullptr;
    const auto* const content = drawn ? dynamic_cast<const VectorLayer*>(drawn->get()) : nullptr;
    const std::size_t all = stated.features->labels.size();
    if (!content || all == 0) continue;
    if (const std::uint64_t without = content->labelsWithoutRoom(); without > 0)
      session.warn(fmt::format("{}: {} of {} {} no room in the picture", stated.stated.file, grouped(without),
                               grouped(all, "label", "labels"), without == 1 ? "has" : "have"));
    if (stated.features->points.size() > FeatureBuffers::kMostKeptFree)
      session.warn(fmt::format("{}: with more than {} points, labels may cover some of them",
                               stated.stated.file, grouped(FeatureBuffers::kMostKeptFree)));
  }
}

void StatedLayers::describe(const Scene& scene, Json& json) const {
  Json layers = Json::array();
  for (const Drape& stated : drapes_) {
    const DrapeOnGpu& drape = *std::get<Layer::Drape>(scene.layers.find(stated.name)->content);
    const Json described = {{"file", stated.file},
                            {"columns", drape.columns()},
                            {"rows", drape.rows()},
                            {"bytes", drape.bytes()}};
    if (!json.contains("drape")) json["drape"] = described;
    layers.push_back(described);
    layers.back()["name"] = stated.name;
    layers.back()["opacity"] = stated.opacity;
  }
  for (const Vector& stated : vectors_)
    layers.push_back({{"file", stated.stated.file},
                      {"name", stated.name},
                      {"opacity", stated.stated.style.opacity},
                      {"points", stated.features->points.size()},
                      {"lines", stated.features->lines()},
                      {"vertices", stated.features->vertices.size()},
                      {"labels", stated.features->labels.size()}});
  if (!layers.empty()) json["layers"] = std::move(layers);
}

std::vector<std::string> layerFiles(const AppearanceArguments& arguments) {
  std::vector<std::string> files;
  for (const std::string& text : arguments.drapes)
    if (const auto stated = readFileWithKeys(text, {"opacity"})) files.push_back(stated->file);
  for (std::size_t i = 0; i < arguments.layers.size(); ++i)
    if (const auto stated = LayerArgument::of(arguments.layers[i], i)) files.push_back(stated->file);
  return files;
}

}  // namespace arete
