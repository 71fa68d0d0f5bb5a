// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/json_tree.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace {
thread_local bool failsToAllocate = false;
}

// Of the whole program.
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* const bytes = failsToAllocate ? nullptr : std::malloc(size == 0 ? 1 : size);
  if (bytes == nullptr) throw std::bad_alloc();
  return bytes;
}
[[gnu::noinline]] void operator delete(void* bytes) noexcept {
  std::free(bytes);
}
[[gnu::noinline]] void operator delete(void* bytes, std::size_t) noexcept {
  std::free(bytes);
}

namespace arete {
namespace {

template <class Json>
void expectDestroyedWithoutMemory(const std::string& text) {
  std::optional<JsonTree<Json>> tree(std::in_place, Json::parse(text));
  EXPECT_EQ((**tree).dump(), text);
  failsToAllocate = true;
  tree.reset();
  failsToAllocate = false;
}

TEST(JsonTree, IsDestroyedWhereThereIsNoMemory) {
  for (const char* text : {"null", "7", "\"a text that is too long to be held without an allocation\"", "[]",
                           "{}", "[1,[2,3],[],{}]", R"({"a":[1,{"b":{"c":[[[[0]]]]}}],"d":{},"e":"f"})"}) {
    SCOPED_TRACE(text);
    expectDestroyedWithoutMemory<nlohmann::json>(text);
    expectDestroyedWithoutMemory<nlohmann::ordered_json>(text);
  }
}

TEST(JsonTree, IsDestroyedHoweverDeepItIs) {
  constexpr std::size_t kDepth = 400'000;
  const JsonTree tree(nlohmann::json::parse(std::string(kDepth, '[') + std::string(kDepth, ']')));
  EXPECT_TRUE((*tree).is_array());
}

}  // namespace
}  // namespace arete
