#include "space_server/user_input.h"

#include <algorithm>
#include <string_view>

namespace swarmanoid
{

bool IsKeyName(const std::string& name)
{
  static constexpr std::string_view kNames[] = {
      "Space",    "Return", "Escape", "Tab",  "Backspace", "Delete", "Insert",  "Home", "End", "PageUp",
      "PageDown", "Up",     "Down",   "Left", "Right",     "Shift",  "Control", "Alt",  "F1",  "F2",
      "F3",       "F4",     "F5",     "F6",   "F7",        "F8",     "F9",      "F10",  "F11", "F12"};
  if (name.size() == 1) return name[0] > ' ' && name[0] <= '~' && !(name[0] >= 'a' && name[0] <= 'z');
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

}  // namespace swarmanoid
