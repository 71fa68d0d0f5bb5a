// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/convert.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/arguments/arguments.h"
#include "cli/mesh/tolerance.h"
#include "io/query/surface/write_model.h"
#include "io/store/amt/surface_file.h"

namespace arete {

Status convertSurfaceFile(const SurfaceConvertArguments& arguments, const AmtContainer& file,
                          Session& session) {
  if (arguments.positionBits != 0 && !arguments.isPacked)
    return failure(ErrorCode::usage, "requires --packed", "--position-bits");
  ARETE_TRY(const SurfaceModel model, loadSurfaceAmt(file, {}, session.context()));
  const SurfaceWriteOptions options{
      .isPacked = arguments.isPacked, .isPaged = arguments.isPaged, .positionBits = arguments.positionBits};
  ARETE_CHECK(writeSurfaceModel(arguments.output, model, session.context(), options));
  std::error_code error;
  const auto size = std::filesystem::file_size(arguments.output, error);
  const std::uint64_t bytes = error ? 0 : size;
  const double perVertex = static_cast<double>(bytes) / static_cast<double>(model.mt.vertexCount());
  session.say(fmt::format("{}: {}, {:.1f} bytes a vertex\n", arguments.output, byteCount(bytes), perVertex));
  session.answer({{"input", file.path()},
                  {"output", arguments.output},
                  {"format", "AMT"},
                  {"isPacked", arguments.isPacked},
                  {"isPaged", arguments.isPaged},
                  {"bytes", bytes},
                  {"bytesPerVertex", perVertex}});
  return {};
}

CLI::Option* addPositionBitsTo(CLI::App& command, int& positionBits) {
  return command
      .add_option(
          "--position-bits", positionBits,
          "In a packed file, round coordinates to a grid of at most 2^N steps along the longest side\n"
          "(8 to 24); every error grows by twice the largest move (default: vertices stay to the bit)")
      ->check(CLI::Range(8, 24))
      ->type_name("N");
}

}  // namespace arete
