// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/network/network_use.h"

#include <atomic>

namespace arete {
namespace {

std::atomic<std::uint64_t> sentRequests = 0, fetchedBytes = 0, bytesOfCaches = 0;

}  // namespace

NetworkUse networkUse() {
  return {sentRequests, fetchedBytes, bytesOfCaches};
}

void noteRequest(std::uint64_t bytes) {
  ++sentRequests;
  fetchedBytes += bytes;
}

void noteCached(std::uint64_t bytes) {
  bytesOfCaches += bytes;
}

}  // namespace arete
