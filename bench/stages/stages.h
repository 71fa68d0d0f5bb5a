// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "bench/figure.h"
#include "bench/sources.h"
#include "bench/timing.h"
#include "engine/base/result.h"
#include "terrain/model/build_options.h"

namespace arete::bench {

/// What is to be measured and how.
struct Plan {
  std::vector<std::string> only;  ///< stages; empty = all
  std::string scratch;            ///< folder for generated DEMs and models
  std::string baselines;          ///< bench/baselines.json
  std::string hmm;                ///< the rival's program; empty = no stage "rival"
  Repetition repetition;

  bool wants(const std::string& stage) const;
};

/// The stages there are, in the order in which they are run: read, build, file, cut, follow, height, sight,
/// viewshed, view, export, measure, triangles, rival, surface, machine.
const std::vector<std::string>& stageNames();

/// Every stage that the plan wants, on one DEM. Each runs in processes of its own; models are built as needed
/// and left in the scratch folder until the last stage. Errors: those of the stages, naming the DEM.
Result<Figures> measureDem(const DemSource& source, const Plan& plan);

/// A real triangle mesh.
struct MeshSource {
  std::string name, path;
};
/// Those of a folder's "meshes" that can be read; empty where there is none.
std::vector<MeshSource> realMeshes(const std::string& folder);
/// Stage "surface" on one mesh, and the memory of generated ones: each in processes of its own. Errors: those
/// of reading and of the build.
Result<Figures> measureMesh(const MeshSource& source, const Plan& plan);
Result<Figures> measureSurfaceMemory(const Plan& plan);

/// What the machine can do at best, in a process of its own. Errors: unreadable (it ended, for want of
/// memory).
Result<Figures> measureMachine(const Plan& plan);

/// Ratios to the rivals, from the figures of stages "triangles" and "surface": geometric means.
Figures geometricMeans(const Figures& figures);

/// The stages, each in the process that calls it; paths and variants as measureDem() hands them in.
Result<Figures> readStage(const DemSource& source, const Plan& plan);
/// One build, written to `model`. Figures of three stages: "build"; "build parts", what the stage clock
/// credits each part with (the file's reading and writing beside them); "build cores", how many were busy in
/// it.
Result<Figures> buildOnce(const DemSource& source, HoleShape shape, int threads, const std::string& model);
Result<Figures> fileStage(const DemSource& source, HoleShape shape, const std::string& model,
                          const Plan& plan);
Result<Figures> cutStage(const DemSource& source, const std::string& model, const Plan& plan);
Result<Figures> followStage(const DemSource& source, const std::string& model, const Plan& plan);
Result<Figures> heightStage(const DemSource& source, const std::string& model, const Plan& plan);
Result<Figures> sightStage(const DemSource& source, const std::string& model, const Plan& plan);
Result<Figures> viewshedStage(const DemSource& source, const std::string& model, const Plan& plan);
/// Without OpenGL an error, unsupported.
Result<Figures> viewStage(const DemSource& source, const std::string& model, const Plan& plan);
Result<Figures> exportStage(const DemSource& source, const std::string& model, const Plan& plan);
Result<Figures> measureStage(const DemSource& source, const std::string& model, const Plan& plan);
Result<Figures> trianglesStage(const DemSource& source, const std::string& delaunay,
                               const std::string& fidelity, const std::vector<GreedyBaseline>& baselines);
Result<Figures> surfaceStage(const MeshSource& source, const Plan& plan);
/// Starts processes of its own.
Result<Figures> surfaceMemoryStage(const Plan& plan);
/// Memory: 1.5 GiB.
Figures machineStage(const Plan& plan);
/// Starts processes of its own: the calling one has no threads. Nothing for a DEM with voids.
Result<Figures> rivalStage(const DemSource& source, const Plan& plan);

}  // namespace arete::bench
