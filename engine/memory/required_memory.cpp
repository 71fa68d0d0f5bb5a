// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is in use is what the system counts as resident, so that mapped files and freed memory are right
// without accounts of our own. A limit of the system on writable memory (RLIMIT_DATA) is the net below: what
// allocates without a question gets std::bad_alloc instead of the memory. Stacks of threads count there, and
// are hardly touched, so the limit leaves room for them.
#include "engine/memory/required_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <new>
#include <string>

#include "engine/base/memory_refusal.h"

namespace arete {
namespace {

std::atomic<std::uint64_t> budget = 0, atStart = 0;

struct Taken {
  std::uint64_t resident = 0, writable = 0;  // bytes
};

/// Numbers of pages: size, resident, shared, text, 0, data and stack, 0.
Taken taken() noexcept {
  Taken now;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen("/proc/self/statm", "re"),
                                                             &std::fclose);
  unsigned long long size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
  if (!file || std::fscanf(file.get(), "%llu %llu %llu %llu %llu %llu", &size, &resident, &shared, &text,
                           &library, &data) != 6)
    return now;
  const auto pageBytes = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return {resident * pageBytes, data * pageBytes};
}

/// "1.7 GB", "12.3 MB".
std::string decimal(std::uint64_t bytes) {
  const double n = static_cast<double>(bytes);
  return n >= 1e9 ? fmt::format("{:.1f} GB", n / 1e9) : fmt::format("{:.1f} MB", n / 1e6);
}

/// What the program takes before it has read anything: itself, and the libraries and tables that it loads on
/// its way.
constexpr std::uint64_t kProgram = std::uint64_t{52} << 20;

/// More than libraries allocate beside our own bulk.
constexpr std::uint64_t kRoom = std::uint64_t{4} << 20;

/// The stacks of the threads that a program may start.
std::uint64_t stackBytes() noexcept {
  rlimit stack{};
  constexpr std::uint64_t kUsual = std::uint64_t{8} << 20;
  const bool isKnown = getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
  const long threads = sysconf(_SC_NPROCESSORS_ONLN);
  return (isKnown ? std::uint64_t{stack.rlim_cur} : kUsual) *
         static_cast<std::uint64_t>(std::max(threads, 1L));
}

bool isLimited = false;

void limitData(std::uint64_t bytes) noexcept {
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const std::uint64_t most =
      limit.rlim_max == RLIM_INFINITY ? ~std::uint64_t{0} : std::uint64_t{limit.rlim_max};
  limit.rlim_cur = static_cast<rlim_t>(std::min(bytes, most));
  isLimited = setrlimit(RLIMIT_DATA, &limit) == 0;
}

}  // namespace

void setMemoryBudget(std::uint64_t bytes) noexcept {
  const Taken now = taken();
  budget = bytes;
  atStart = std::max(now.resident, kProgram);
  if (bytes == 0 && isLimited)
    limitData(~std::uint64_t{0});
  else if (bytes > 0 && now.writable > 0)
    limitData(now.writable + bytes + kRoom + stackBytes());
}

std::uint64_t memoryBudget() noexcept {
  return budget;
}

std::uint64_t memoryInUse() noexcept {
  const std::uint64_t now = taken().resident;
  return now > atStart ? now - atStart : 0;
}

Status checkBudget(std::uint64_t bytes, std::string_view wayOut) {
  const std::uint64_t all = budget;
  if (all == 0) return {};
  const std::uint64_t used = memoryInUse(), left = all > used ? all - used : 0;
  if (bytes <= left) return {};
  return failure(
      ErrorCode::outOfMemory,
      fmt::format("needs about {} of memory, and {} of the {} of `memory` are left{}{}", decimal(bytes),
                  decimal(left), decimal(all), wayOut.empty() ? "" : ": ", wayOut));
}

void requireMemory(std::uint64_t bytes, std::string_view wayOut) {
  const long pages = sysconf(_SC_PHYS_PAGES), pageBytes = sysconf(_SC_PAGESIZE);
  if (pages > 0 && pageBytes > 0 && bytes / static_cast<std::uint64_t>(pageBytes) > std::uint64_t(pages))
    throw std::bad_alloc();
  if (const Status status = checkBudget(bytes, wayOut); !status) throw MemoryRefusal(status.error().message);
}

void allowReserved(std::uint64_t bytes) noexcept {
  rlimit limit{};
  if (!isLimited || getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  const std::uint64_t now = limit.rlim_cur;
  limitData(now > ~std::uint64_t{0} - bytes ? ~std::uint64_t{0} : now + bytes);
}

}  // namespace arete
