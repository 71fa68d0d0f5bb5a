// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gdal/unclaimed_messages.h"

#include <cpl_error.h>

#include <algorithm>
#include <atomic>
#include <string>

namespace arete {
namespace {

std::atomic<void (*)(const char*)> receiver = nullptr;

void CPL_STDCALL pass(CPLErr severity, CPLErrorNum, const char* message) {
  void (*const tell)(const char*) = receiver;
  if (severity < CE_Warning || tell == nullptr) return;
  std::string line = message ? message : "";
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < 32 || c == 127; }, ' ');
  tell(line.c_str());
}

}  // namespace

void sendUnclaimedGdalMessages(void (*tell)(const char* line)) {
  receiver = tell;
  CPLSetErrorHandler(pass);
}

}  // namespace arete
