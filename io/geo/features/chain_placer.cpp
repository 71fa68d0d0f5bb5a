// SPDX-License-Identifier: GPL-3.0-or-later
//
// A line is led edge by edge: an edge that the DEM's CRS cannot tell ends one piece, and the next good one
// begins another. x stays continuous along a piece, so that no edge crosses the whole map at the
// antimeridian.
#include "io/geo/features/chain_placer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arete {
namespace {

bool isFinite(Vec2 p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

}  // namespace

std::optional<Vec2> ChainPlacer::place(Vec2 xy) {
  if (swaps_) std::swap(xy.x, xy.y);
  if (!isFinite(xy)) {
    ++notFinite_;
    return std::nullopt;
  }
  if (transform_.isIdentity()) return turns_(xy);
  const auto there = transform_({xy}, false);
  if (!there) {
    ++outOfReach_;
    return std::nullopt;
  }
  return turns_(there->front());
}

std::vector<ChainPlacer::Piece> ChainPlacer::transformed(const Piece& piece) {
  std::vector<Piece> pieces;
  Piece now;
  const auto end = [&] {
    if (now.xy.size() > 1) pieces.push_back(std::move(now));
    now = {};
  };
  const double turn = transform_.turn();
  for (std::size_t i = 1; i < piece.xy.size(); ++i) {
    const auto edge = transform_({piece.xy[i - 1], piece.xy[i]}, false);
    if (!edge) {
      ++outOfReach_;
      end();
      continue;
    }
    double shift = 0;
    if (now.xy.empty()) {
      now.xy.push_back(edge->front());
      now.z.push_back(piece.z[i - 1]);
    } else if (turn > 0) {
      shift = turn * std::round((now.xy.back().x - edge->front().x) / turn);
    }
    const std::size_t steps = edge->size() - 1;
    // New vertices get heights between the two of the edge, by the way in the plan.
    double whole = 0;
    for (std::size_t k = 1; k <= steps; ++k)
      whole += std::hypot((*edge)[k].x - (*edge)[k - 1].x, (*edge)[k].y - (*edge)[k - 1].y);
    double done = 0;
    for (std::size_t k = 1; k <= steps; ++k) {
      done += std::hypot((*edge)[k].x - (*edge)[k - 1].x, (*edge)[k].y - (*edge)[k - 1].y);
      const double part = k == steps || !(whole > 0) ? 1 : done / whole;
      now.xy.push_back({(*edge)[k].x + shift, (*edge)[k].y});
      now.z.push_back(part == 1 ? piece.z[i] : piece.z[i - 1] + part * (piece.z[i] - piece.z[i - 1]));
    }
  }
  end();
  return pieces;
}

void ChainPlacer::addPiece(const Piece& piece, FeatureLayer& layer, std::optional<std::uint64_t>& longest) {
  double west = std::numeric_limits<double>::infinity(), east = -west;
  for (const Vec2& p : piece.xy) {
    west = std::min(west, p.x);
    east = std::max(east, p.x);
  }
  std::vector<double> shifts = turns_.shiftsOnto(west, east);
  if (shifts.empty()) shifts = {0};  // not on the DEM, wherever it is; who draws it counts it
  for (const double shift : shifts) {
    const FeatureLayer::Line line{.first = layer.vertices.size(), .count = piece.xy.size()};
    for (const Vec2& p : piece.xy) layer.vertices.push_back({p.x + shift, p.y});
    layer.z.insert(layer.z.end(), piece.z.begin(), piece.z.end());
    if (!longest || layer.lines[*longest].count < line.count) longest = layer.lines.size();
    layer.lines.push_back(line);
  }
}

std::optional<std::uint64_t> ChainPlacer::addLine(std::span<const Vec2> line, std::span<const double> z,
                                                  FeatureLayer& layer) {
  std::optional<std::uint64_t> longest;
  Piece now;
  const auto end = [&] {
    if (now.xy.size() > 1) {
      takeShortWays(now.xy, turn_);
      if (transform_.isIdentity()) {
        addPiece(now, layer, longest);
      } else {
        for (const Piece& piece : transformed(now)) addPiece(piece, layer, longest);
      }
    }
    now = {};
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 p = swaps_ ? Vec2{line[i].y, line[i].x} : line[i];
    if (!isFinite(p)) {
      ++notFinite_;
      end();
    } else if (now.xy.empty() || !(now.xy.back() == p)) {
      now.xy.push_back(p);
      now.z.push_back(z[i]);
    }
  }
  end();
  return longest;
}

}  // namespace arete
