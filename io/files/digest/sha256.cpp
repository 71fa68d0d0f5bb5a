// SPDX-License-Identifier: GPL-3.0-or-later
//
// FIPS 180-4, section 6.2. Newer x86 processors have instructions for two rounds at a time, and for the
// schedule of the words; the plain form is for all others.
#include "io/files/digest/sha256.h"

#include <algorithm>
#include <bit>
#include <cstring>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

namespace arete {
namespace {

alignas(16) constexpr std::array<std::uint32_t, 64> kRoundConstants = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

std::uint32_t wordAt(const std::byte* bytes) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | std::to_integer<std::uint32_t>(bytes[i]);
  return word;
}

void compressPlain(std::array<std::uint32_t, 8>& state, const std::byte* block) {
  std::array<std::uint32_t, 64> words;
  for (std::size_t t = 0; t < 16; ++t) words[t] = wordAt(block + 4 * t);
  for (std::size_t t = 16; t < 64; ++t) {
    const std::uint32_t w15 = words[t - 15], w2 = words[t - 2];
    words[t] = words[t - 16] + (std::rotr(w15, 7) ^ std::rotr(w15, 18) ^ (w15 >> 3)) + words[t - 7] +
               (std::rotr(w2, 17) ^ std::rotr(w2, 19) ^ (w2 >> 10));
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t first = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                ((e & f) ^ (~e & g)) + kRoundConstants[t] + words[t];
    const std::uint32_t second =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + first;
    d = c;
    c = b;
    b = a;
    a = first + second;
  }
  const std::array<std::uint32_t, 8> after = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) state[i] += after[i];
}

#if defined(__x86_64__)

/// The instructions hold the state as ABEF and CDGH, each word pair reversed.
__attribute__((target("sha,sse4.1"))) void compressWithInstructions(std::array<std::uint32_t, 8>& state,
                                                                    const std::byte* bytes,
                                                                    std::size_t blocks) {
  const auto load = [](const void* from) __attribute__((target("sha,sse4.1"))) {
    return _mm_loadu_si128(static_cast<const __m128i*>(from));
  };
  const __m128i swap = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
  const __m128i dcba = _mm_shuffle_epi32(load(state.data()), 0xB1);
  const __m128i hgfe = _mm_shuffle_epi32(load(state.data() + 4), 0x1B);
  __m128i abef = _mm_alignr_epi8(dcba, hgfe, 8);
  __m128i cdgh = _mm_blend_epi16(hgfe, dcba, 0xF0);
  for (; blocks > 0; --blocks, bytes += 64) {
    const __m128i abefBefore = abef, cdghBefore = cdgh;
    __m128i words[4];
    for (std::size_t i = 0; i < 4; ++i) words[i] = _mm_shuffle_epi8(load(bytes + 16 * i), swap);
    for (std::size_t group = 0; group < 16; ++group) {
      __m128i& w = words[group % 4];
      if (group >= 4) {
        // Words t to t + 3 of those 16 to 13, 15 to 12, 7 to 4 and 2 to 1 before.
        const __m128i before = words[(group + 3) % 4];
        w = _mm_add_epi32(_mm_sha256msg1_epu32(w, words[(group + 1) % 4]),
                          _mm_alignr_epi8(before, words[(group + 2) % 4], 4));
        w = _mm_sha256msg2_epu32(w, before);
      }
      __m128i rounds = _mm_add_epi32(w, load(kRoundConstants.data() + 4 * group));
      cdgh = _mm_sha256rnds2_epu32(cdgh, abef, rounds);
      rounds = _mm_shuffle_epi32(rounds, 0x0E);
      abef = _mm_sha256rnds2_epu32(abef, cdgh, rounds);
    }
    abef = _mm_add_epi32(abef, abefBefore);
    cdgh = _mm_add_epi32(cdgh, cdghBefore);
  }
  const __m128i feba = _mm_shuffle_epi32(abef, 0x1B), dchg = _mm_shuffle_epi32(cdgh, 0xB1);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(state.data()), _mm_blend_epi16(feba, dchg, 0xF0));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(state.data() + 4), _mm_alignr_epi8(dchg, feba, 8));
}

#endif

}  // namespace

bool Sha256::hasInstructions() {
#if defined(__x86_64__)
  unsigned a = 0, b = 0, c = 0, d = 0;
  constexpr unsigned kSha = 1u << 29;
  return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & kSha) != 0 && __builtin_cpu_supports("sse4.1");
#else
  return false;
#endif
}

void Sha256::takeBlocks(const std::byte* bytes, std::size_t blocks) {
#if defined(__x86_64__)
  if (usesInstructions_) return compressWithInstructions(state_, bytes, blocks);
#endif
  for (std::size_t i = 0; i < blocks; ++i) compressPlain(state_, bytes + kBlock * i);
}

void Sha256::add(std::span<const std::byte> bytes) {
  size_ += bytes.size();
  if (restSize_ > 0) {
    const std::size_t taken = std::min(bytes.size(), kBlock - restSize_);
    std::copy_n(bytes.data(), taken, rest_.data() + restSize_);
    restSize_ += taken;
    bytes = bytes.subspan(taken);
    if (restSize_ < kBlock) return;
    takeBlocks(rest_.data(), 1);
    restSize_ = 0;
  }
  const std::size_t blocks = bytes.size() / kBlock;
  takeBlocks(bytes.data(), blocks);
  const auto rest = bytes.subspan(blocks * kBlock);
  std::ranges::copy(rest, rest_.begin());
  restSize_ = rest.size();
}

std::string Sha256::hex() {
  const std::uint64_t bits = 8 * size_;
  // A bit of one, zeros up to the last eight bytes of a block, and there the number of bits.
  std::array<std::byte, 2 * kBlock> end = {};
  end[0] = std::byte{0x80};
  const std::size_t zeros = (2 * kBlock - 9 - restSize_) % kBlock;
  for (std::size_t i = 0; i < 8; ++i) end[1 + zeros + i] = std::byte(bits >> (56 - 8 * i) & 0xff);
  add(std::span(end).first(1 + zeros + 8));
  std::string text;
  for (const std::uint32_t word : state_)
    for (int shift = 28; shift >= 0; shift -= 4) text += "0123456789abcdef"[word >> shift & 15];
  return text;
}

}  // namespace arete
