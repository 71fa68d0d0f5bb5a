// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/ranges/web_settings.h"

#include <mutex>
#include <utility>

namespace arete {
namespace {

struct SharedWebSettings {
  std::mutex mutex;
  WebSettings settings;
};

/// Not destroyed at the end of the process, where files may still be closed.
SharedWebSettings& sharedWebSettings() {
  static SharedWebSettings& shared = *new SharedWebSettings();
  return shared;
}

}  // namespace

WebSettings webSettings() {
  const std::lock_guard lock(sharedWebSettings().mutex);
  return sharedWebSettings().settings;
}

void setWebSettings(WebSettings settings) {
  const std::lock_guard lock(sharedWebSettings().mutex);
  sharedWebSettings().settings = std::move(settings);
}

}  // namespace arete
