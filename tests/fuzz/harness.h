// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/exchange/mesh_formats.h"

/// What a fuzz program and the replay of its kept inputs call: reads the bytes, uses what was read, and ends
/// the program where a promise does not hold.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace arete::fuzz {

/// Ends the program, saying `promise`, where it is not kept: for the fuzzer that is a crash like any other.
void require(bool kept, const char* promise);

/// An error is one printable sentence of bearable length; no file can put control characters into it, for it
/// goes to terminals.
void requireClear(const Error& error);
void requireClear(const Warnings& warnings);

/// A mesh that a reader let through: indices in range, coordinates finite, and `measure` answers over it.
void useMesh(const Result<MeshFile>& mesh);

/// One thread: an input takes as long as it takes, and its neighbours keep their processors.
RunContext oneThread();

/// A file in memory with a path, for readers that open paths. One for all inputs; never on a disk.
class MemoryFile {
 public:
  MemoryFile();
  void set(std::span<const std::uint8_t> bytes) const;
  const std::string& path() const { return path_; }

 private:
  int descriptor_;
  std::string path_;
};

}  // namespace arete::fuzz
