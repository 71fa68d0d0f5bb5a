// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/arguments/drop_attributes.h"
#include "cli/surface/mending.h"
#include "engine/base/stopwatch.h"
#include "io/geo/crs/names.h"
#include "io/query/surface/write_model.h"
#include "io/store/amt/surface_file.h"
#include "surface/front/front.h"

namespace arete {
namespace {

struct Seconds {
  double read = 0, build = 0, displace = 0, write = 0;
};

void report(const SurfaceBuildArguments& arguments, std::uint64_t faces, std::uint64_t vertices,
            const SurfaceModel& model, const ExpectedAmtSize& expected, const Seconds& seconds,
            Session& session) {
  const MultiTriangulation& mt = model.mt;
  std::error_code error;
  const auto size = std::filesystem::file_size(arguments.output, error);
  const std::uint64_t bytes = error ? 0 : size;
  const double perVertex = double(bytes) / double(mt.vertexCount());
  std::string text = fmt::format(
      "{}\n"
      "  surface    {}, {}, diagonal {:.6g}\n"
      "  triangles  {} at the finest, {} in the multitriangulation\n"
      "  root       {}, {}, error at most {:.6g}; {}\n",
      arguments.output, grouped(faces, "face", "faces"), grouped(vertices, "vertex", "vertices"),
      model.diagonal, grouped(mt.finestTriangleCount()), grouped(mt.triangleCount()),
      grouped(mt.rootTriangleCount(), "triangle", "triangles"),
      grouped(mt.rootVertexCount(), "vertex", "vertices"), mt.largestError(),
      grouped(model.levels, "level", "levels"));
  if (const auto& angle = model.options.creaseAngleDegrees)
    text += fmt::format("  creases    {} of more than {} degrees\n",
                        grouped(model.creaseEdges, "edge", "edges"), *angle);
  text += mendedText(model.mending, "  mended     ");
  // Seams that keep most of the surface from being coarser.
  if (2 * mt.rootTriangleCount() > mt.finestTriangleCount())
    if (const std::string seams = seamsOf(finestSurfaceOf(model).mesh); seams.size() > 2)
      text += fmt::format("  seams      {}\n", seams.substr(2));
  if (model.mending.dropsFlatNormals)
    text += "  left out   normals of corners: they are those of flat faces\n";
  text += fmt::format(
      "  built in   {:.2f} s (read {:.2f} s, {}write {:.2f} s)\n"
      "  size       {}, {:.0f} bytes a vertex\n",
      seconds.build, seconds.read,
      model.displacement.isEmpty() ? "" : fmt::format("displacement {:.2f} s, ", seconds.displace),
      seconds.write, byteCount(bytes), perVertex);
  session.say(text);
  session.answer(
      {{"file", arguments.output},
       {"kind", "surface"},
       {"source", model.source},
       {"crs", crsName(model.crsWkt)},
       {"sourceFaces", faces},
       {"sourceVertices", vertices},
       {"vertices", mt.vertexCount()},
       {"diagonal", model.diagonal},
       {"triangles", mt.triangleCount()},
       {"finestTriangles", mt.finestTriangleCount()},
       {"rootTriangles", mt.rootTriangleCount()},
       {"rootVertices", mt.rootVertexCount()},
       {"rootError", mt.largestError()},
       {"levels", model.levels},
       {"creaseEdges", model.creaseEdges},
       {"mended", mendedJson(model.mending)},
       {"seconds",
        {{"read", seconds.read},
         {"build", seconds.build},
         {"displace", seconds.displace},
         {"write", seconds.write}}},
       {"expectedBytes", {{"plain", std::round(expected.plain)}, {"packed", std::round(expected.packed)}}},
       {"bytes", bytes},
       {"bytesPerVertex", perVertex}});
}

}  // namespace

void announceSize(const ExpectedAmtSize& size, const std::string& output, bool isPacked, Session& session) {
  const auto text = [](double bytes) { return byteCount(static_cast<std::uint64_t>(bytes)); };
  // Small files surprise by nothing.
  constexpr double kLeastBytes = 1e6;
  if (size.plain >= kLeastBytes && !session.wantsJson()) {
    session.note(isPacked
                     ? fmt::format("{} will be about {}; without --packed about {}, which opens three times "
                                   "as fast",
                                   output, text(size.packed), text(size.plain))
                     : fmt::format("{} will be about {}; with --packed about {}, which takes three times as "
                                   "long to open",
                                   output, text(size.plain), text(size.packed)));
  }
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(output, error).parent_path();
  const auto room = std::filesystem::space(folder, error);
  const double needed = isPacked ? size.packed : size.plain;
  if (!error && static_cast<double>(room.available) < needed)
    session.warn(fmt::format("{}: its disk has {} free, less than the file of about {} needs{}", output,
                             text(static_cast<double>(room.available)), text(needed),
                             isPacked ? "" : fmt::format("; with --packed about {}", text(size.packed))));
}

Status buildSurfaceFile(const SurfaceBuildArguments& arguments, MeshInput input, double secondsToRead,
                        Session& session) {
  Seconds seconds;
  seconds.read = secondsToRead;
  const ExpectedAmtSize expected = expectedAmtSize(input.file.mesh);
  announceSize(expected, arguments.output, arguments.isPacked, session);
  // What the report says of the file.
  const std::uint64_t faces = input.fileFaces, vertices = input.fileVertices;
  const Result<BuiltSurface> built =
      buildSurfaceModel(std::move(input), arguments.input, arguments.options, session.context());
  if (!built) {
    Error error = built.error();
    const auto& dropped = arguments.options.dropAttributes;
    if (error.code == ErrorCode::usage && std::ranges::find(dropped, error.culprit) != dropped.end())
      error.culprit = fmt::format("--drop-attributes {}", error.culprit);
    return tl::unexpected(std::move(error));
  }
  session.warn(built->warnings, arguments.input);
  seconds.build = built->secondsToBuild;
  seconds.displace = built->secondsToDisplace;

  Stopwatch writing;
  const SurfaceWriteOptions options{
      .isPacked = arguments.isPacked, .isPaged = arguments.isPaged, .positionBits = arguments.positionBits};
  ARETE_CHECK(writeSurfaceModel(arguments.output, built->model, session.context(), options));
  seconds.write = writing.seconds();
  report(arguments, faces, vertices, built->model, expected, seconds, session);
  return {};
}

}  // namespace arete
