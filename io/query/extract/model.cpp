// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/model.h"

#include <utility>

#include "engine/base/caught_failure.h"
#include "io/query/extract/model_file.h"
#include "io/store/amt/file.h"
#include "io/store/amt/surface_file.h"

namespace arete {

Result<Model> readModel(AmtContainer file, const RunContext& context) try {
  if (file.isOfSurface()) {
    ARETE_TRY(SurfaceModel model, loadSurfaceAmt(file, {}, context));
    return Model(std::move(model));
  }
  ARETE_TRY(const AmtFile terrain, openAmt(std::move(file)));
  ARETE_TRY(TerrainModel model, terrain.read({}, context));
  return Model(std::move(model));
} catch (...) {
  return caughtFailure();
}

Result<Model> openModel(const std::string& path, const AmtOpenOptions& options, const RunContext& context) {
  AmtOpenOptions cancellable = options;
  if (cancellable.cancel == nullptr) cancellable.cancel = context.cancel;
  ARETE_TRY(AmtContainer file, openModelFile(path, cancellable));
  return readModel(std::move(file), context);
}

}  // namespace arete
