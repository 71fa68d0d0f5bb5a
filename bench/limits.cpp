// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a part must do is counted in the code, not measured: bytes of the arrays that it has to pass over,
// each once for each pass that its algorithm makes, in the data structures as they are; lines of memory at
// places that nothing before has brought near (far); comparisons, additions and multiplications. How often
// things happen comes from an instrumented build of generated-4M with default options, by sample (counted
// before docs/decisions/0016 to 0018: there are fewer evaluations and looks now, and removals within pieces
// have no candidates and are sewn as they go, so that little is left for the part that is called so):
//
//   1     removal         5.7 link vertices, 3.7 new triangles, 5.6 edges measured, 18 crossings, 31 samples
//                         compared in 5 rows
//   4.65  evaluations     2.75 triangles each, 3.7 rows and 23 samples in them, ten tries of a third corner
//   1.6   candidates      entered into the choice of a level
//   96    looks           at the list of the living, over 231 levels
//
// Data structures: a triangle of the live mesh 32 bytes, a vertex's note 16, its half-edge 4, a height 8. The
// counts are of terrain like this; flat or rough ones differ by some ten per cent. Whoever changes an
// algorithm or a structure counts anew.
#include "bench/limits.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace arete::bench {
namespace {

/// Of one part, by sample.
struct Need {
  const char* part;
  double bytes, farLines, operations;
};

constexpr Need kBuild[] = {
    // Heights out; what the file holds is in its own compression.
    {"read", 12, 0, 0},
    // Triangles out, then for either sweep: triangles twice, parents four times, heights; what the sweeps
    // leave.
    // Far: the way to a root.
    {"features", 216, 2, 220},
    // Heights three times, the cells' first triangles, triangles of 32 bytes cleared, written and read, two a
    // sample, half-edges of vertices.
    {"triangulate", 236, 0, 80},
    // An id and a threshold at every look, an id written; four in ten have gone and not been forgotten yet.
    {"simplify: collect", 1.4 * 96 * (4 + 4 + 4), 0, 1.4 * 96 * 2},
    // The rule of the finest triangulation once. Of whoever is due: id, place, note, half-edge, height and
    // its
    // share of the star, two triangles; a corner's place is a division, a third corner 16 operations a try, a
    // row 12, a sample 5.
    {"simplify: evaluate", 36 + 4.1 * (8 + 32) + 3.6 * (4 + 2 * 32 + 8), 0, 20 + 3.6 * 420},
    // Note, half-edge, share of the star, notes of the link.
    {"simplify: choose", 1.6 * (4 + 16 + 4 + 64 + 96), 0, 1.6 * 48},
    // The star read and written, the record written, notes and half-edges of the link; seams.
    {"simplify: remove", 648, 0, 970},
    // Two heights for each of two crossings of three diagonals and of 2.6 edges of the rim, codes of the
    // triangles of the star, codes out; a crossing is 6 operations, a code 8.
    {"simplify: bounds", 5.6 * 2 * 8 + 36 + 24, 0, 5.6 * 2 * 6 + 17 * 8 + 27},
    // The box of seven places, the farthest from its middle. Far: saturated error and sphere of three
    // children, removed in levels of their own.
    {"simplify: saturate", 4 * 18, 6, 7 * 14 + 3 * 16 + 14},
    // Seams, the new triangles and those across the rim, read and written.
    {"simplify: sew", 650, 0, 60},
    {"finish: order", 26, 2, 20},
    // The record in, the node out, a table of births, where the record lies three times. Far: the five arrays
    // of a record, errors and births of three children, vertices of the link.
    {"finish: stars", 246, 16, 60},
    {"finish: floors", 45, 5, 20},
    {"finish", 14, 1, 10},
    // Read for the checksums and for writing, and written.
    {"write", 3 * 124, 0, 40},
};
constexpr Need kLoad = {"load with checks", 2 * 124, 8, 200};
// Where each star begins, 5.7 removers; two triangles and a vertex out.
constexpr Need kCut = {"cut, finest", 4 + 23 + 12, 0, 17};

std::optional<double> valueOf(const Figures& figures, const std::string& dem, const std::string& stage,
                              const std::string& variant, const std::string& name) {
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const Figure& f) {
    return f.dem == dem && f.stage == stage && f.variant == variant && f.name == name;
  });
  if (found == figures.end()) return std::nullopt;
  return found->value;
}

struct Machine {
  double copy, gather, arithmetic;  ///< GB/s, ns, operations/ns
};

std::optional<Machine> machineOf(const Figures& figures) {
  const auto value = [&](const char* name) {
    return valueOf(figures, "this machine", "machine", "1 thread", name);
  };
  const auto copy = value("copy"), gather = value("gather"), arithmetic = value("arithmetic");
  if (!copy || !gather || !arithmetic) return std::nullopt;
  return Machine{*copy, *gather, *arithmetic};
}

class Limits {
 public:
  Limits(const Machine& machine, const std::string& dem) : machine_(machine), dem_(dem) {}

  void add(const Need& need, double taken) {
    const double moving = need.bytes / machine_.copy, finding = need.farLines * machine_.gather,
                 computing = need.operations / machine_.arithmetic;
    figure(need.part, "bytes", need.bytes, "", Better::lower);
    figure(need.part, "far lines", need.farLines, "", Better::lower);
    figure(need.part, "operations", need.operations, "", Better::lower);
    figure(need.part, "bandwidth", moving, "ns", Better::neither);
    figure(need.part, "far", finding, "ns", Better::neither);
    figure(need.part, "arithmetic", computing, "ns", Better::neither);
    figure(need.part, "taken", taken, "ns", Better::lower);
    figure(need.part, "times the limit", taken / std::max({moving, finding, computing}), "", Better::lower);
  }
  Figures take() { return std::move(figures_); }

 private:
  void figure(const char* part, const char* name, double value, const char* unit, Better better) {
    figures_.push_back({dem_, "limits", part, name, value, unit, better});
  }

  const Machine machine_;
  const std::string dem_;
  Figures figures_;
};

}  // namespace

Figures limitsOf(const Figures& figures) {
  const std::optional<Machine> machine = machineOf(figures);
  const std::string build = "delaunay, 1 thread";
  std::string dem;
  double samples = 0;
  for (const Figure& f : figures)
    if (f.stage == "build" && f.variant == build && f.name == "samples" && f.value > samples) {
      dem = f.dem;
      samples = f.value;
    }
  if (!machine || dem.empty()) return {};
  Limits limits(*machine, dem);
  for (const Need& need : kBuild)
    if (const auto taken = valueOf(figures, dem, "build parts", build, need.part)) limits.add(need, *taken);
  if (const auto seconds = valueOf(figures, dem, "file", "delaunay", "load with checks, 1 thread"))
    limits.add(kLoad, 1e9 * *seconds / samples);
  if (const auto milliseconds = valueOf(figures, dem, "cut", "saturated, finest, 1 thread", "time"))
    limits.add(kCut, 1e6 * *milliseconds / samples);
  return limits.take();
}

}  // namespace arete::bench
