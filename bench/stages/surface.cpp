// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces beside CGAL's edge collapse: how good cuts of as many triangles are, both ways and in % of the
// diagonal, as they are and displaced, and how long the build of all levels takes beside one collapse to a
// tenth. The methods of `mesh decimate` that the rival has are beside it one by one. What the rival
// misses by 5 % of the count, or flings away by more than 10 % of the diagonal, is no figure but is named.
// Memory is what a generated rock of two million vertices takes more than one of half a million.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/edge_collapse.h"
#include "bench/forked.h"
#include "bench/stages/stages.h"
#include "datasets/asteroid.h"
#include "engine/criteria/refine_order.h"
#include "engine/cut/cut.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/store/amt/surface_file.h"
#include "measure/mesh_distance.h"
#include "surface/builder/build.h"
#include "surface/decimate/decimate.h"
#include "surface/displacement/displaced_places.h"
#include "surface/displacement/find_displacement.h"
#include "surface/front/front.h"

namespace arete::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::array kShares = {10.0, 2.0, 0.5};  // % of the faces

SurfaceMesh shapeOf(const SurfaceMesh& mesh) {
  return SurfaceMesh(static_cast<const TriangleMesh&>(mesh));
}

/// Mean, root mean square and largest distance, in % of the diagonal; of a rival also its time.
struct Quality {
  double mean = 0, rms = 0, largest = 0, seconds = 0;
};

Result<Quality> qualityOf(const TriangleMesh& mesh, const TriangleMesh& source) {
  MeshDistanceOptions options;
  options.accuracy = 0.01;
  ARETE_TRY(const auto report, measureDistance(mesh, source, options));
  const double percent = 100 / report.second.diagonal;
  return Quality{percent * report.mean(), percent * report.rms(), percent * report.hausdorff(), 0};
}

class SurfaceRun {
 public:
  SurfaceRun(std::string name, Figures& figures) : name_(std::move(name)), figures_(figures) {}

  void add(const std::string& variant, const std::string& figure, double value, const char* unit,
           Better better) {
    figures_.push_back({name_, "surface", variant, figure, value, unit, better});
  }

  /// Errors: those of the build.
  Status build(const SurfaceMesh& mesh, const Repetition& repetition) {
    ARETE_TRY(SurfaceModel model, buildSurface(shapeOf(mesh)));
    const double seconds = medianSeconds(repetition, [&] { return buildSurface(shapeOf(mesh)); });
    source_ = finestSurfaceOf(model).mesh.shape();
    model_ = std::move(model);
    const double displacing = medianSeconds(repetition, [&] { return findDisplacement(model_); });
    ARETE_TRY(SurfaceDisplacement displacement, findDisplacement(model_));
    model_.displacement = std::move(displacement);
    add("build", "ratio of time of the displacement to the build", displacing / seconds, "", Better::lower);
    add("build", "faces", double(source_.triangles.size()), "", Better::neither);
    add("build", "time, all threads", seconds, "s", Better::lower);
    const auto rival = collapseEdges(source_, source_.triangles.size() / 10, EdgeCollapse::lindstromTurk);
    if (!rival) return {};
    add("build", "Lindstrom-Turk to 10 %, 1 thread", rival->seconds, "s", Better::neither);
    add("build", "ratio of time to Lindstrom-Turk", seconds / rival->seconds, "", Better::lower);
    return {};
  }

  Status compare() {
    for (const double share : kShares) {
      const std::string variant = fmt::format("{} %", share);
      const auto wanted =
          static_cast<std::uint32_t>(std::lround(share / 100 * double(source_.triangles.size())));
      CutOptions options;
      options.maxTriangles = wanted;
      options.order = std::make_shared<LargestSquaresFirst>();
      const Result<Cut> cut = takeCut(model_.mt, UniformError(0), options);
      if (!cut) continue;  // the coarsest surface has more
      ARETE_TRY(const auto own, qualityOf(surfaceOf(model_, *cut).mesh, source_));
      add(variant, "mean", own.mean, "%", Better::lower);
      add(variant, "RMS", own.rms, "%", Better::lower);
      add(variant, "largest", own.largest, "%", Better::lower);
      add(variant, "bound", 100 * cut->achievedError / model_.diagonal, "%", Better::lower);
      const auto ends = rivalOf(EdgeCollapse::lindstromTurkEnds, wanted);
      if (ends) {
        add(variant, "ratio of mean to Lindstrom-Turk at ends", own.mean / ends->mean, "", Better::lower);
        add(variant, "ratio of RMS to Lindstrom-Turk at ends", own.rms / ends->rms, "", Better::lower);
      } else {
        add(variant, "Lindstrom-Turk at ends left out", 1, "", Better::neither);
      }
      const auto quadrics = rivalOf(EdgeCollapse::planeQuadrics, wanted);
      if (quadrics)
        add(variant, "ratio of largest to plane quadrics", own.largest / quadrics->largest, "",
            Better::lower);
      else
        add(variant, "plane quadrics left out", 1, "", Better::neither);
      ARETE_CHECK(compareDisplaced(variant, *cut, wanted, quadrics));
    }
    return {};
  }

  /// The methods of `mesh decimate` that CGAL has, each beside it.
  Status compareMethods() {
    for (const double share : kShares) {
      const auto wanted =
          static_cast<std::uint32_t>(std::lround(share / 100 * double(source_.triangles.size())));
      for (const auto& [own, rival, name] :
           {std::tuple{DecimateOperator::edge, EdgeCollapse::planeQuadrics, "qem"},
            std::tuple{DecimateOperator::lindstromTurk, EdgeCollapse::lindstromTurkNormals,
                       "lindstrom-turk"}}) {
        const std::string variant = fmt::format("{}, {} %", name, share);
        const Stopwatch watch;
        const auto result = decimate(SurfaceMesh(source_), {.method = own, .maxTriangles = wanted});
        const double seconds = watch.seconds();
        if (!result) return tl::unexpected(result.error());
        const auto theirs = rivalOf(rival, wanted);
        if (!theirs || double(result->mesh.triangles.size()) > 1.05 * wanted) {
          add(variant, "left out", 1, "", Better::neither);
          continue;
        }
        ARETE_TRY(const auto quality, qualityOf(result->mesh, source_));
        add(variant, "ratio of mean to CGAL's", quality.mean / theirs->mean, "", Better::lower);
        add(variant, "ratio of RMS to CGAL's", quality.rms / theirs->rms, "", Better::lower);
        add(variant, "ratio of largest to CGAL's", quality.largest / theirs->largest, "", Better::lower);
        add(variant, "ratio of time to CGAL's", seconds / theirs->seconds, "", Better::lower);
      }
    }
    return {};
  }

 private:
  /// Beside Lindstrom-Turk with vertices placed freely, with or without its check of normals.
  Status compareDisplaced(const std::string& variant, const Cut& cut, std::uint32_t wanted,
                          const std::optional<Quality>& quadrics) {
    TriangleMesh drawn = surfaceOf(model_, cut).mesh.shape();
    drawn.positions =
        displacedPlaces(model_.mt, model_.displacement, cut, promisedErrors(model_.mt, cut, nullptr));
    ARETE_TRY(const auto own, qualityOf(drawn, source_));
    add(variant, "displaced, mean", own.mean, "%", Better::lower);
    add(variant, "displaced, RMS", own.rms, "%", Better::lower);
    add(variant, "displaced, largest", own.largest, "%", Better::lower);
    const auto free = rivalOf(EdgeCollapse::lindstromTurk, wanted),
               checked = rivalOf(EdgeCollapse::lindstromTurkNormals, wanted);
    if (free || checked) {
      const auto least = [&](double Quality::*of) {
        return std::min(free ? (*free).*of : (*checked).*of, checked ? (*checked).*of : (*free).*of);
      };
      add(variant, "displaced, ratio of mean to Lindstrom-Turk", own.mean / least(&Quality::mean), "",
          Better::lower);
      add(variant, "displaced, ratio of RMS to Lindstrom-Turk", own.rms / least(&Quality::rms), "",
          Better::lower);
    } else {
      add(variant, "Lindstrom-Turk left out", 1, "", Better::neither);
    }
    if (quadrics)
      add(variant, "displaced, ratio of largest to plane quadrics", own.largest / quadrics->largest, "",
          Better::lower);
    return {};
  }

  /// Nothing where the rival misses the count or flings a vertex away.
  std::optional<Quality> rivalOf(EdgeCollapse method, std::uint32_t wanted) const {
    const auto collapsed = collapseEdges(source_, wanted, method);
    if (!collapsed || double(collapsed->mesh.triangles.size()) > 1.05 * wanted) return std::nullopt;
    auto quality = qualityOf(collapsed->mesh, source_);
    if (!quality || quality->largest > 10) return std::nullopt;
    quality->seconds = collapsed->seconds;
    return *quality;
  }

  std::string name_;
  Figures& figures_;
  SurfaceModel model_;
  TriangleMesh source_;  // as the build mended it
};

struct Growth {
  double vertices = 0, peak = 0, file = 0, seconds = 0;
};

Result<Growth> growthOf(std::uint32_t vertices, const std::string& scratch) {
  ARETE_TRY(const Json json, runForked([&]() -> Result<Json> {
              SurfaceMesh mesh(generateAsteroid({.vertices = vertices}));
              const double count = double(mesh.positions.size());
              const Stopwatch watch;
              ARETE_TRY(const SurfaceModel model, buildSurface(std::move(mesh)));
              const double seconds = watch.seconds();
              const double peak = peakBytes();
              const fs::path path = fs::path(scratch) / "rock.amt";
              ARETE_CHECK(writeSurfaceAmt(path.string(), model));
              const double bytes = double(fs::file_size(path));
              fs::remove(path);
              return Json{{"vertices", count}, {"peak", peak}, {"file", bytes}, {"seconds", seconds}};
            }));
  return Growth{json["vertices"], json["peak"], json["file"], json["seconds"]};
}

}  // namespace

std::vector<MeshSource> realMeshes(const std::string& folder) {
  std::vector<MeshSource> sources;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "meshes", ignored))
    if (entry.is_regular_file() && isMeshFile(entry.path()))
      sources.push_back({entry.path().stem().string(), entry.path().string()});
  std::ranges::sort(sources, {}, &MeshSource::name);
  return sources;
}

Result<Figures> surfaceStage(const MeshSource& source, const Plan& plan) {
  ARETE_TRY(const MeshFile file, readMesh(source.path));
  Figures figures;
  SurfaceRun run(source.name, figures);
  ARETE_CHECK(run.build(file.mesh, plan.repetition));
  ARETE_CHECK(run.compare());
  ARETE_CHECK(run.compareMethods());
  return figures;
}

Result<Figures> surfaceMemoryStage(const Plan& plan) {
  ARETE_TRY(const auto small, growthOf(500'000, plan.scratch));
  ARETE_TRY(const auto large, growthOf(2'000'000, plan.scratch));
  Figures figures;
  const double more = large.vertices - small.vertices;
  const auto add = [&](const char* name, double value, const char* unit) {
    figures.push_back(
        {"generated rock", "surface", "0.5 to 2 million vertices", name, value, unit, Better::lower});
  };
  add("memory, growth a vertex", (large.peak - small.peak) / more, "byte");
  add("file, growth a vertex", (large.file - small.file) / more, "byte");
  add("time of the larger one", large.seconds, "s");
  return figures;
}

}  // namespace arete::bench
