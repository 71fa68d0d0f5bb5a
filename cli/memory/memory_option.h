// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "engine/base/result.h"

namespace arete {

/// Declares --memory of a command. It takes effect while the command line is parsed, before threads are
/// started.
void addMemoryTo(CLI::App& command);

/// What GDAL keeps of rasters becomes a part of the budget, where there is one.
void boundLibraries();

/// Where an allocation has failed within a budget, its sentence names the budget.
void nameBudget(Error& error);

}  // namespace arete
