// The input of a user, in a window or on a page, for experiment functions: keys, and the selected entity.
#pragma once

#include <string>

namespace swarmanoid
{

class CSwarmanoidSpaceEntity;

struct UserInput
{
  enum class Kind
  {
    kKeyPressed,
    kKeyReleased,
    kSelected,   // an entity; the one selected before was deselected first
    kDeselected  // the entity that was selected
  };

  Kind kind = Kind::kKeyPressed;
  // The name of the key: "A" to "Z", "0" to "9", another sign on the key, "Space", "Return", "Escape", "Tab",
  // "Backspace", "Delete", "Insert", "Home", "End", "PageUp", "PageDown", "Up", "Down", "Left", "Right", "Shift",
  // "Control", "Alt", "F1" to "F12".
  std::string key;
  const CSwarmanoidSpaceEntity* entity = nullptr;  // for the last two kinds
};

// Returns whether UserInput::key may have this name.
bool IsKeyName(const std::string& name);

}  // namespace swarmanoid
