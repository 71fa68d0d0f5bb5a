// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loaded before a program (LD_PRELOAD): of the allocations from the begin of main() on, the one of the number
// ARETE_FAIL_ALLOCATION fails.
#include <dlfcn.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
}

namespace {

using Main = int (*)(int, char**, char**);

std::atomic<long> left = -1;  // allocations before the one that fails; < 0: none fails
Main realMain = nullptr;

bool fails() {
  if (left.load(std::memory_order_relaxed) < 0 || left.fetch_sub(1) != 0) return false;
  errno = ENOMEM;
  return true;
}

int armedMain(int count, char** words, char** environment) {
  const char* const number = std::getenv("ARETE_FAIL_ALLOCATION");
  if (number != nullptr) left = std::strtol(number, nullptr, 10);
  return realMain(count, words, environment);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  return fails() ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  return fails() ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  return fails() ? nullptr : __libc_realloc(old, size);
}

int __libc_start_main(Main main, int count, char** words, void (*init)(), void (*fini)(), void (*ending)(),
                      void* stack) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  void* const next = ::dlsym(RTLD_NEXT, "__libc_start_main");
  Start start = nullptr;
  std::memcpy(&start, &next, sizeof start);
  realMain = main;
  return start(armedMain, count, words, init, fini, ending, stack);
}
}
