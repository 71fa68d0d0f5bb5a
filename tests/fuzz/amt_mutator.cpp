// SPDX-License-Identifier: GPL-3.0-or-later
//
// Most changes of an .amt file break a checksum and get no further than that. So files are taken apart, one
// part is changed, and they are put together again as a writer would: chunks in their places, sizes and
// checksums right, those of packed nodes too. One change in sixteen is left as it is.
#include <algorithm>
#include <random>
#include <vector>

#include "fuzz/amt_parts.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace {

using namespace arete;
using namespace arete::fuzz;
using Bytes = std::vector<std::uint8_t>;

/// Changes some bytes in place, as the fuzzer likes.
void mutateInPlace(std::uint8_t* begin, std::size_t size) {
  Bytes window(begin, begin + size);
  const std::size_t got = LLVMFuzzerMutate(window.data(), size, size);
  std::copy_n(window.begin(), std::min(got, size), begin);
}

/// One element, or what one of its neighbours has: an index that is in range, but not here.
void mutateElement(AmtPart& part, std::minstd_rand& random) {
  const std::size_t size = part.entry.elementBytes;
  const std::size_t count = size == 0 ? 0 : part.bytes.size() / size;
  if (count == 0) return;
  std::uint8_t* const element = part.bytes.data() + random() % count * size;
  if (random() % 3 == 0)
    std::copy_n(part.bytes.data() + random() % count * size, size, element);
  else
    mutateInPlace(element, size);
}

void mutateParts(AmtParts& amt, std::minstd_rand& random) {
  AmtPart& part = amt.parts[random() % amt.parts.size()];
  switch (random() % 16) {
    case 0:  // the header beside what putting together sets
      mutateInPlace(reinterpret_cast<std::uint8_t*>(&amt.header), sizeof amt.header);
      break;
    case 1:
      mutateInPlace(reinterpret_cast<std::uint8_t*>(&part.entry), sizeof part.entry);
      break;
    case 2:  // longer or shorter
    case 3: {
      const std::size_t size = part.bytes.size();
      part.bytes.resize(size + 64);
      part.bytes.resize(LLVMFuzzerMutate(part.bytes.data(), size, part.bytes.size()));
      break;
    }
    case 4:
    case 5:
    case 6: {  // the metadata, a text
      Bytes& text = amt.parts.front().bytes;
      const std::size_t size = text.size();
      text.resize(size + 64);
      text.resize(LLVMFuzzerMutate(text.data(), size, text.size()));
      break;
    }
    default:
      for (std::size_t changes = 1 + random() % 3; changes-- > 0;)
        mutateElement(amt.parts[random() % amt.parts.size()], random);
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
  std::minstd_rand random(seed);
  auto amt = takeApart({data, size});
  if (!amt || random() % 16 == 0) return LLVMFuzzerMutate(data, size, maxSize);
  mutateParts(*amt, random);
  const Bytes file = putTogether(*amt);
  if (file.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
  std::copy(file.begin(), file.end(), data);
  return file.size();
}
