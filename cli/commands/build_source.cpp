// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/build_source.h"

#include <utility>
#include <variant>

#include "cli/surface/build.h"

namespace arete {

Result<Source> readSource(const DemArguments& dem, const std::string& kind, Session& session) {
  Result<Source> source =
      readSource(inputPath(dem.path), {.reading = dem.reading, .kind = kind}, session.context());
  if (!source) return tl::unexpected(dem.named(std::move(source.error())));
  if (auto* const mesh = std::get_if<MeshInput>(&*source)) {
    session.warn(mesh->file.warnings, dem.path);
    return source;
  }
  auto& read = std::get<DemRead>(*source);
  if (dem.path == "-") std::visit([&](auto& field) { field.source = dem.path; }, read.heightfield);
  session.warn(read.warnings, dem.path);
  return source;
}

ExpectedAmtSize announceSize(const DemRead& dem, const std::string& output, bool isPacked, Session& session) {
  const ExpectedAmtSize size =
      std::visit([](const auto& field) { return expectedAmtSize(field); }, dem.heightfield);
  announceSize(size, output, isPacked, session);
  return size;
}

}  // namespace arete
