// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>

namespace arete {

class SpanCache;

/// How this process reads files of servers.
struct WebSettings {
  /// What ends every request soon after it became true, beside the RunContext of a call. Outlives all
  /// reading.
  const std::atomic<bool>* cancel = nullptr;
  std::shared_ptr<SpanCache> cache;  ///< null: nothing is kept
};

/// Thread-safe. What is open keeps the settings that it was opened with.
WebSettings webSettings();
void setWebSettings(WebSettings settings);

}  // namespace arete
