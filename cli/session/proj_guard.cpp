// SPDX-License-Identifier: GPL-3.0-or-later
//
// PROJ lets a program replace its file functions per context, but GDAL makes contexts of its own, which it
// does not give away and which do not inherit them. PROJ opens files by fopen(), whose symbol is looked up in
// the program first. The program has one, which checks the files that the library of PROJ opens and passes
// everything else on.
#include "cli/session/proj_guard.h"

#include <dlfcn.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "io/geo/crs/proj_files.h"

namespace {

using Open = std::FILE* (*)(const char*, const char*);

std::atomic<bool> isGuarding = false;

bool isInProj(const void* code) {
  Dl_info info;
  return ::dladdr(code, &info) != 0 && info.dli_fname && std::strstr(info.dli_fname, "libproj.") != nullptr;
}

std::FILE* openUnlessForbidden(const char* symbol, const void* caller, const char* name, const char* mode) {
  if (isGuarding && isInProj(caller) && !arete::projMayOpen(name)) {
    errno = EACCES;
    return nullptr;
  }
  void* const next = ::dlsym(RTLD_NEXT, symbol);
  Open open = nullptr;
  std::memcpy(&open, &next, sizeof open);
  return open(name, mode);
}

}  // namespace

extern "C" {
std::FILE* fopen(const char* name, const char* mode) {
  return openUnlessForbidden("fopen", __builtin_return_address(0), name, mode);
}
std::FILE* fopen64(const char* name, const char* mode) {
  return openUnlessForbidden("fopen64", __builtin_return_address(0), name, mode);
}
}

namespace arete {

void guardProjFiles() {
  isGuarding = true;
}

}  // namespace arete
