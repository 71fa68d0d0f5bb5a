// SPDX-License-Identifier: GPL-3.0-or-later
// Every action has a key, and no key has two.
#include "viewer/window/key_bindings.h"

#include <gtest/gtest.h>
#include <set>
#include <string>
#include <utility>

namespace arete {
namespace {

TEST(KeyBindings, NoKeyIsGivenTwiceAndEveryActionHasOne) {
  std::set<std::pair<int, bool>> keys;
  std::set<Action> actions;
  for (const KeyBinding& b : keyBindings()) {
    EXPECT_TRUE(keys.insert({b.key, b.isWithControl}).second) << b.name;
    EXPECT_EQ(actionOfKey(b.key, b.isWithControl), b.action);
    EXPECT_FALSE(b.help.empty()) << b.name;
    actions.insert(b.action);
  }
  EXPECT_EQ(actions.size(), std::size_t(Action::help) + 1);
  for (const int key : {'W', 'A', 'S', 'D', 'Q', 'E'})
    EXPECT_FALSE(actionOfKey(key, false)) << "moves the camera";
}

TEST(KeyBindings, GiveNothingForKeysAndButtonsWithoutAnAction) {
  EXPECT_FALSE(actionOfKey(-1, false));
  EXPECT_FALSE(actionOfKey(100000, true));
  EXPECT_FALSE(actionOfButton(-1));
  EXPECT_FALSE(actionOfButton(1000));
}

TEST(KeyBindings, ExplainEveryControlInBothModes) {
  ASSERT_FALSE(heldControls().empty());
  for (const HeldControl& control : heldControls()) {
    EXPECT_FALSE(control.what.empty());
    EXPECT_FALSE(control.orbit.empty() && control.free.empty()) << control.what;
  }
}

}  // namespace
}  // namespace arete
