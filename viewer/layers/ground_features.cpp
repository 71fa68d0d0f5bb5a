// SPDX-License-Identifier: GPL-3.0-or-later
//
// Profiles (terrain/sight) cross the edges below a line. Long lines go in pieces of so many vertices, which
// bounds the memory that is needed at a time, and the pieces are joined where one ends as the next begins.
#include "viewer/layers/ground_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "terrain/model/plan_box.h"
#include "terrain/sight/earth.h"
#include "viewer/layers/drawn_text.h"
#include "viewer/layers/polygon_place.h"

namespace arete {
namespace {

constexpr std::size_t kPieceVertices = 1024;  // of the file, in one track
constexpr std::size_t kPiecesAtATime = 512;
/// A line in the air is straight on the map, and bent on a curved Earth: its edges are cut to this part of
/// the terrain's diagonal.
constexpr double kPartInAir = 1.0 / 256;

using Place = GroundFeatures::Place;

/// A part of a line of the file.
struct LinePiece {
  std::uint64_t line = 0, first = 0, count = 0;
};

class Grounding {
 public:
  Grounding(const FeatureLayer& layer, const Profiles& profiles, const GroundFeatureOptions& options)
      : layer_(layer),
        profiles_(profiles),
        model_(profiles.heights().model()),
        options_(options),
        margin_(GroundHeights::margin(model_)) {
    const Box2 box = planBox(model_);
    longest_ = std::hypot(box.xMax - box.xMin, box.yMax - box.yMin) * kPartInAir;
  }

  Result<GroundFeatures> run(const RunContext& context) {
    result_.name = layer_.name;
    result_.warnings = layer_.warnings;
    ARETE_CHECK(layPoints(context));
    ARETE_CHECK(layLines(context));
    layLabels();
    if (result_.points.empty() && result_.vertices.empty()) return tl::unexpected(nowhere());
    warn();
    return std::move(result_);
  }

 private:
  std::optional<double> groundAt(Vec2 xy) const {
    const auto ground = profiles_.heights().at(xy);
    return ground ? std::optional(ground->height) : std::nullopt;
  }
  bool stands(double z) const { return options_.floats && !std::isnan(z); }

  Status layPoints(const RunContext& context) {
    std::vector<Vec2> positions;
    positions.reserve(layer_.points.size());
    for (const auto& point : layer_.points) positions.push_back(point.xy);
    RunContext quiet = context;
    quiet.progress = nullptr;
    ARETE_TRY(const auto grounds, profiles_.heights().at(positions, 0, quiet));
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double z = layer_.points[i].z;
      if (stands(z))
        result_.points.push_back({positions[i], z});
      else if (grounds[i])
        result_.points.push_back({positions[i], grounds[i]->height});
      else
        ++pointsBeside_;
    }
    return {};
  }

  std::vector<LinePiece> pieces() const {
    std::vector<LinePiece> all;
    for (std::uint64_t i = 0; i < layer_.lines.size(); ++i) {
      const auto& line = layer_.lines[i];
      for (std::uint64_t first = 0; first + 1 < line.count; first += kPieceVertices - 1)
        all.push_back({i, line.first + first, std::min<std::uint64_t>(kPieceVertices, line.count - first)});
    }
    return all;
  }

  Status layLines(const RunContext& context) {
    const std::vector<LinePiece> all = pieces();
    linesOn_.assign(layer_.lines.size(), 0);
    linesCut_.assign(layer_.lines.size(), 0);
    longestOf_.assign(layer_.lines.size(), {0, 0});
    std::vector<std::vector<std::vector<Place>>> chains(kPiecesAtATime);
    std::vector<char> isCut(kPiecesAtATime);
    for (std::size_t begin = 0; begin < all.size(); begin += kPiecesAtATime) {
      if (context.cancelled())
        return failure(ErrorCode::interrupted, "laying lines on the ground was stopped");
      context.report("laying lines on the ground", double(begin) / double(all.size()));
      const std::size_t count = std::min(kPiecesAtATime, all.size() - begin);
      parallelFor(std::size_t(0), count, [&](std::size_t i) {
        bool cut = false;
        chains[i] = chainsOf(all[begin + i], cut);
        isCut[i] = cut ? 1 : 0;
      });
      for (std::size_t i = 0; i < count; ++i) {
        ARETE_CHECK(append(all[begin + i].line, chains[i]));
        if (isCut[i] != 0) linesCut_[all[begin + i].line] = 1;
      }
    }
    endLine();
    if (!all.empty()) context.report("laying lines on the ground", 1);
    return {};
  }

  /// A piece as runs over terrain, or in the air.
  std::vector<std::vector<Place>> chainsOf(const LinePiece& piece, bool& isCut) const {
    const auto vertices = std::span(layer_.vertices).subspan(piece.first, piece.count);
    if (options_.floats && !layer_.z.empty()) {
      const auto z = std::span(layer_.z).subspan(piece.first, piece.count);
      if (std::ranges::none_of(z, [](double value) { return std::isnan(value); }))
        return {inAir(vertices, z)};
    }
    SightTrack track;
    for (const Vec2& xy : vertices) {
      const Vec2 plan = sightEnd(model_, model_.toPlan(xy), margin_);
      const double along = track.points.empty() ? 0
                                                : track.points.back().distance +
                                                      std::hypot(plan.x - track.points.back().plan.x,
                                                                 plan.y - track.points.back().plan.y);
      // Two vertices in one place are one.
      if (!track.points.empty() && !(along > track.points.back().distance)) continue;
      track.points.push_back({plan, along});
    }
    std::vector<std::vector<Place>> chains;
    if (track.points.size() < 2) return chains;
    const Profile profile = profiles_.along(track);
    isCut = profile.gapMetres > 1e-9 * profile.length || profile.vertices.empty();
    for (const ProfileVertex& vertex : profile.vertices) {
      if (!vertex.isJoined) chains.emplace_back();
      chains.back().push_back({model_.toSource(vertex.plan), vertex.height});
    }
    std::erase_if(chains, [](const std::vector<Place>& chain) { return chain.size() < 2; });
    return chains;
  }

  std::vector<Place> inAir(std::span<const Vec2> vertices, std::span<const double> z) const {
    std::vector<Place> chain = {{vertices[0], z[0]}};
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      const Vec2 a = model_.toPlan(vertices[i - 1]), b = model_.toPlan(vertices[i]);
      const double steps = std::clamp(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / longest_), 1.0, 4096.0);
      for (double k = 1; k <= steps; ++k)
        chain.push_back({vertices[i - 1] + (k / steps) * (vertices[i] - vertices[i - 1]),
                         z[i - 1] + k / steps * (z[i] - z[i - 1])});
      chain.back() = {vertices[i], z[i]};
    }
    return chain;
  }

  Status append(std::uint64_t line, std::vector<std::vector<Place>>& chains) {
    if (line != open_) endLine();
    open_ = line;
    for (std::vector<Place>& chain : chains) {
      linesOn_[line] = 1;
      auto& vertices = result_.vertices;
      const bool continues = vertices.size() > result_.begin.back() && isSame(vertices.back(), chain.front());
      if (!continues) endChain();
      vertices.insert(vertices.end(), chain.begin() + (continues ? 1 : 0), chain.end());
      if (vertices.size() > options_.mostVertices)
        return failure(
            ErrorCode::unsupported,
            fmt::format("the lines of the layer '{}' need more than {} vertices to follow the ground, "
                        "which is the most that is drawn; a part of them can be",
                        layer_.name, options_.mostVertices));
      chain = {};
    }
    return {};
  }

  bool isSame(const Place& a, const Place& b) const {
    const Vec2 p = model_.toPlan(a.xy), q = model_.toPlan(b.xy);
    return std::hypot(p.x - q.x, p.y - q.y) <= 1e-6 + margin_;
  }

  /// Ends the run of vertices that is being written, and remembers the longest one of its line.
  void endChain() {
    const std::uint64_t first = result_.begin.back(), end = result_.vertices.size();
    if (end == first) return;
    if (open_ != FeatureLayer::kNoLine) {
      auto& longest = longestOf_[open_];
      const double length = lengthOf(first, end);
      if (length > longest.second) longest = {result_.begin.size(), length};
    }
    result_.begin.push_back(end);
  }
  void endLine() {
    endChain();
    open_ = FeatureLayer::kNoLine;
  }

  double lengthOf(std::uint64_t first, std::uint64_t end) const {
    double length = 0;
    for (std::uint64_t i = first + 1; i < end; ++i)
      length += std::hypot(result_.vertices[i].xy.x - result_.vertices[i - 1].xy.x,
                           result_.vertices[i].xy.y - result_.vertices[i - 1].xy.y);
    return length;
  }

  /// Inside the largest polygon of a label's feature that has a place on the terrain.
  std::optional<Vec2> placeOf(const FeatureLayer::Label& label) const {
    const auto placeIn = [&](std::uint64_t polygon) {
      const auto rings = std::ranges::equal_range(ringLines_, polygon, {}, &FeatureLayer::Line::polygon);
      return placeInside(layer_, {rings.begin(), rings.end()}, profiles_.heights());
    };
    std::optional<Vec2> place = placeIn(label.polygon);
    for (std::uint64_t i = label.firstPolygon; !place && i < label.endPolygon; ++i)
      if (i != label.polygon) place = placeIn(i);
    return place;
  }

  void layLabels() {
    std::ranges::copy_if(layer_.lines, std::back_inserter(ringLines_), [](const FeatureLayer::Line& line) {
      return line.polygon != FeatureLayer::kNoPolygon;
    });
    std::vector<std::optional<Vec2>> inside(layer_.labels.size());
    parallelFor(std::size_t(0), inside.size(), [&](std::size_t i) {
      if (layer_.labels[i].polygon != FeatureLayer::kNoPolygon) inside[i] = placeOf(layer_.labels[i]);
    });
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const FeatureLayer::Label& label = layer_.labels[i];
      if (label.polygon != FeatureLayer::kNoPolygon) {
        if (const auto ground = inside[i] ? groundAt(*inside[i]) : std::nullopt)
          result_.labels.push_back({label.text, {*inside[i], *ground}});
        continue;
      }
      if (label.line == FeatureLayer::kNoLine) {
        if (stands(label.at.z))
          result_.labels.push_back({label.text, {label.at.xy, label.at.z}});
        else if (const auto ground = groundAt(label.at.xy))
          result_.labels.push_back({label.text, {label.at.xy, *ground}});
        continue;
      }
      const auto& [run, length] = longestOf_[label.line];
      if (run > 0) result_.labels.push_back({label.text, middleOf(run - 1, length)});
    }
  }

  /// Half way along a run of vertices.
  Place middleOf(std::uint64_t run, double length) const {
    const auto& vertices = result_.vertices;
    double left = length / 2;
    for (std::uint64_t i = result_.begin[run] + 1; i < result_.begin[run + 1]; ++i) {
      const Place &a = vertices[i - 1], &b = vertices[i];
      const double step = std::hypot(b.xy.x - a.xy.x, b.xy.y - a.xy.y);
      if (step >= left && step > 0)
        return {a.xy + (left / step) * (b.xy - a.xy), a.height + left / step * (b.height - a.height)};
      left -= step;
    }
    return vertices[result_.begin[run]];
  }

  void warn() {
    if (pointsBeside_ > 0)
      result_.warnings.push_back(
          {WarningCode::omitted, fmt::format("{} of {} {} not on the terrain and not drawn", pointsBeside_,
                                             counted(layer_.points.size(), "point", "points"),
                                             agreeing(pointsBeside_, "is", "are"))});
    const auto countedIf = [&](bool isOn, bool cut) {
      std::size_t n = 0;
      for (std::size_t i = 0; i < layer_.lines.size(); ++i)
        n += (linesOn_[i] != 0) == isOn && (!isOn || (linesCut_[i] != 0) == cut) ? 1 : 0;
      return n;
    };
    const std::size_t beside = countedIf(false, false), cut = countedIf(true, true);
    const std::string all = counted(layer_.lines.size(), "line", "lines");
    if (beside > 0)
      result_.warnings.push_back(
          {WarningCode::omitted, fmt::format("{} of {} {} not on the terrain and not drawn", beside, all,
                                             agreeing(beside, "is", "are"))});
    if (cut > 0)
      result_.warnings.push_back(
          {WarningCode::omitted,
           fmt::format("{} of {} {} not on the terrain everywhere and drawn where {}", cut, all,
                       agreeing(cut, "is", "are"), agreeing(cut, "it is", "they are"))});
    const std::size_t unplaced = layer_.labels.size() - result_.labels.size();
    if (unplaced > 0)
      result_.warnings.push_back(
          {WarningCode::omitted,
           fmt::format("{} of {} {} no place on the terrain and {} not drawn", unplaced,
                       counted(layer_.labels.size(), "label", "labels"), agreeing(unplaced, "has", "have"),
                       agreeing(unplaced, "is", "are"))});
    const auto foreign = std::size_t(std::ranges::count_if(
        result_.labels, [](const auto& label) { return !isDrawnAsWritten(label.text); }));
    if (foreign > 0)
      result_.warnings.push_back(
          {WarningCode::display, counted(foreign, "label has letters that the font of pictures lacks",
                                         "labels have letters that the font of pictures lacks")});
    if (options_.floats) {
      const auto without = std::size_t(
          std::ranges::count_if(layer_.points, [](const auto& point) { return std::isnan(point.z); }));
      if (without > 0)
        result_.warnings.push_back(
            {WarningCode::completed, counted(without, "point states no height and lies on the ground",
                                             "points state no height and lie on the ground")});
      if (layer_.z.empty() && !layer_.lines.empty())
        result_.warnings.push_back(
            {WarningCode::completed, "its lines state no heights and lie on the ground"});
    }
  }

  Error nowhere() const {
    Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
        high = -1 * low;
    const auto widen = [](Vec2& l, Vec2& h, Vec2 p) {
      l = {std::min(l.x, p.x), std::min(l.y, p.y)};
      h = {std::max(h.x, p.x), std::max(h.y, p.y)};
    };
    for (const auto& point : layer_.points) widen(low, high, point.xy);
    for (const Vec2& p : layer_.vertices) widen(low, high, p);
    const Box2 box = planBox(model_);
    Vec2 modelLow{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
        modelHigh = -1 * modelLow;
    for (const Vec2& corner : {Vec2{box.xMin, box.yMin}, Vec2{box.xMax, box.yMin}, Vec2{box.xMin, box.yMax},
                               Vec2{box.xMax, box.yMax}})
      widen(modelLow, modelHigh, model_.toSource(corner));
    const bool looksLonLat = !model_.georeference.crsWkt.empty() && !model_.georeference.isGeographic &&
                             low.x >= -180 && high.x <= 360 && low.y >= -90 && high.y <= 90;
    const bool meets =
        low.x <= modelHigh.x && high.x >= modelLow.x && low.y <= modelHigh.y && high.y >= modelLow.y;
    const int digits = model_.georeference.isGeographic || looksLonLat ? 6 : 0;
    const auto place = [&](Vec2 p) { return fmt::format("{:.{}f} {:.{}f}", p.x, digits, p.y, digits); };
    return {ErrorCode::invalidData,
            fmt::format(
                "nothing of the layer '{}' is on the terrain: in the DEM's CRS it reaches from {} to {}, and "
                "the terrain from {} to {}{}",
                layer_.name, place(low), place(high), place(modelLow), place(modelHigh),
                looksLonLat ? "; its coordinates look like longitudes and latitudes, whose CRS can be stated"
                : meets     ? "; the terrain has voids there"
                            : ""),
            {}};
  }

  const FeatureLayer& layer_;
  const Profiles& profiles_;
  const TerrainModel& model_;
  GroundFeatureOptions options_;
  double margin_, longest_ = 1;
  GroundFeatures result_;
  std::uint64_t open_ = FeatureLayer::kNoLine;  // the line whose vertices are being written
  std::uint64_t pointsBeside_ = 0;
  std::vector<char> linesOn_, linesCut_;
  std::vector<FeatureLayer::Line> ringLines_;  // in the order of their polygons
  std::vector<std::pair<std::uint64_t, double>>
      longestOf_;  // of a line, the number of its longest run, from 1
};

}  // namespace

Result<GroundFeatures> layOnGround(const FeatureLayer& layer, const Profiles& profiles,
                                   const GroundFeatureOptions& options, const RunContext& context) try {
  return withThreads(context, [&] { return Grounding(layer, profiles, options).run(context); });
} catch (...) {
  return caughtFailure(layer.name);
}

}  // namespace arete
