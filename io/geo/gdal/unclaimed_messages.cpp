// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/gdal/unclaimed_messages.h"

#include <cpl_error.h>

#include <atomic>
#include <string>

#include "io/geo/gdal/message_text.h"

namespace arete {
namespace {

std::atomic<void (*)(const char*)> receiver = nullptr, receiverOfFatal = nullptr;

void CPL_STDCALL pass(CPLErr severity, CPLErrorNum, const char* message) {
  if (severity == CE_Fatal) reportFatalGdalError(message);
  void (*const tell)(const char*) = receiver;
  if (severity < CE_Warning || tell == nullptr) return;
  tell(gdalMessageText(message).c_str());
}

}  // namespace

void sendUnclaimedGdalMessages(void (*tell)(const char* line)) {
  receiver = tell;
  CPLSetErrorHandler(pass);
}

void receiveFatalGdalErrors(void (*end)(const char* message)) {
  receiverOfFatal = end;
}

void reportFatalGdalError(const char* message) {
  void (*const end)(const char*) = receiverOfFatal;
  if (end != nullptr) end(message ? message : "");
}

}  // namespace arete
