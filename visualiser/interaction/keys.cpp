#include "visualiser/interaction/keys.h"

#include <array>
#include <utility>

namespace swarmanoid
{
namespace
{

using namespace keys;

constexpr std::array kBindings{
    KeyBinding{Action::kPause, {' '}, "Run", "Space", "pause, go on"},
    KeyBinding{Action::kStep, {'N'}, "Run", "N", "one tick, then pause"},
    KeyBinding{Action::kStepTen, {'N', false, true}, "Run", "Shift-N", "ten ticks, then pause"},
    KeyBinding{Action::kFaster, {'='}, "Run", "+", "faster"},
    KeyBinding{Action::kFaster, {'=', false, true}, "Run", "", ""},
    KeyBinding{Action::kFaster, {'+'}, "Run", "", ""},
    KeyBinding{Action::kSlower, {'-'}, "Run", "-", "slower"},
    KeyBinding{Action::kClose, {'Q', true}, "Run", "Ctrl-Q", "close the window"},

    KeyBinding{Action::kTickBack, {','}, "Look back", ", .", "one tick earlier, later"},
    KeyBinding{Action::kTickForward, {'.'}, "Look back", "", ""},
    KeyBinding{Action::kEventBack, {',', false, true}, "Look back", "< >", "the event before, after"},
    KeyBinding{Action::kEventBack, {'<'}, "Look back", "", ""},
    KeyBinding{Action::kEventBack, {'<', false, true}, "Look back", "", ""},
    KeyBinding{Action::kEventForward, {'.', false, true}, "Look back", "", ""},
    KeyBinding{Action::kEventForward, {'>'}, "Look back", "", ""},
    KeyBinding{Action::kEventForward, {'>', false, true}, "Look back", "", ""},
    KeyBinding{Action::kPlayPast, {'Z'}, "Look back", "Z", "play from there in real time; stop"},
    KeyBinding{Action::kPresent, {'Q'}, "Look back", "Q", "back to the present"},
    KeyBinding{
        Action::kBranch, {'B', false, true}, "Look back", "Shift-B", "copy the command that starts a new run there"},

    KeyBinding{
        Action::kInspectPast, {'I', false, true}, "Look back", "Shift-I", "copy the command that tells what it sensed"},

    KeyBinding{Action::kIds, {'I'}, "Show", "I", "ids"},
    KeyBinding{Action::kTrails, {'L'}, "Show", "L", "trails"},
    KeyBinding{Action::kRays,
               {'R'},
               "Show",
               "R",
               "rays of proximity sensors and range scanners, cones of lit directional LEDs"},
    KeyBinding{Action::kBeams, {'B'}, "Show", "B", "laser beams"},
    KeyBinding{Action::kCollisionModels, {'C'}, "Show", "C", "collision models"},
    KeyBinding{Action::kTextures, {'T'}, "Show", "T", "textures"},
    KeyBinding{Action::kShadows, {'S'}, "Show", "S", "shadows"},
    KeyBinding{Action::kPicture, {'P'}, "Show", "P", "write a picture (PNG)"},

    KeyBinding{Action::kHelp, {kFunction + 1}, "Panels", "F1", "this list"},
    KeyBinding{Action::kRunPanel, {kFunction + 2}, "Panels", "F2", "run"},
    KeyBinding{Action::kEntityPanel, {kFunction + 3}, "Panels", "F3", "entities"},
    KeyBinding{Action::kPlotPanel, {kFunction + 4}, "Panels", "F4", "plots"},
    KeyBinding{Action::kTimelinePanel, {kFunction + 5}, "Panels", "F5", "timeline"},
    KeyBinding{Action::kAllPanels, {kTab}, "Panels", "Tab", "all panels away, and back"},

    KeyBinding{Action::kMouse, {}, "Camera", "Drag", "turn about the middle of the picture"},
    KeyBinding{Action::kMouse, {}, "Camera", "Right drag", "shift"},
    KeyBinding{Action::kMouse, {}, "Camera", "Wheel", "nearer, farther"},
    KeyBinding{Action::kOrbitLeft, {kLeft}, "Camera", "Arrows", "turn"},
    KeyBinding{Action::kOrbitRight, {kRight}, "Camera", "", ""},
    KeyBinding{Action::kOrbitUp, {kUp}, "Camera", "", ""},
    KeyBinding{Action::kOrbitDown, {kDown}, "Camera", "", ""},
    KeyBinding{Action::kZoomIn, {kPageUp}, "Camera", "Page up, Page down", "nearer, farther"},
    KeyBinding{Action::kZoomOut, {kPageDown}, "Camera", "", ""},
    KeyBinding{Action::kWholeArena, {kHome}, "Camera", "Home", "the whole arena"},
    KeyBinding{Action::kFromAbove, {kEnd}, "Camera", "End", "the arena from above"},
    KeyBinding{Action::kRecall, {'0', true}, "Camera", "Ctrl-0 ... 9", "go to a viewpoint"},
    KeyBinding{Action::kStore, {'0', true, true}, "Camera", "Ctrl-Shift-0 ... 9", "store it and print its XML"},

    KeyBinding{Action::kMouse, {}, "Entities", "Click", "select and inspect"},
    KeyBinding{Action::kMouse, {}, "Entities", "Ctrl-click", "inspect in a further window"},
    KeyBinding{Action::kMouse, {}, "Entities", "Shift-drag", "move (wheel: turn)"},
    KeyBinding{Action::kFollow, {'F'}, "Entities", "F", "follow the selected one"},
    KeyBinding{Action::kDeselect, {kEscape}, "Entities", "Escape", "select nothing"},
    KeyBinding{
        Action::kKeysToFunctions, {kFunction + 8}, "Entities", "F8", "keys and selections go to experiment functions"},
};

}  // namespace

std::span<const KeyBinding> KeyBindings() { return kBindings; }

std::optional<KeyCommand> CommandOf(const KeyPress& press)
{
  const bool digit = press.key >= '0' && press.key <= '9';
  for (const KeyBinding& binding : kBindings)
  {
    if (binding.action == Action::kMouse) continue;
    KeyPress wanted = binding.press;
    const bool numbered = binding.action == Action::kRecall || binding.action == Action::kStore;
    if (numbered && digit) wanted.key = press.key;
    if (wanted == press) return KeyCommand{binding.action, numbered ? press.key - '0' : 0};
  }
  return std::nullopt;
}

std::string NameOfKey(int key)
{
  constexpr std::pair<int, const char*> kNames[]{
      {' ', "Space"},  {kEscape, "Escape"}, {kTab, "Tab"},          {kHome, "Home"},
      {kEnd, "End"},   {kLeft, "Left"},     {kRight, "Right"},      {kUp, "Up"},
      {kDown, "Down"}, {kPageUp, "PageUp"}, {kPageDown, "PageDown"}};
  for (const auto& [code, name] : kNames)
    if (code == key) return name;
  if (key > kFunction && key <= kFunction + 12) return "F" + std::to_string(key - kFunction);
  return key > ' ' && key <= '~' ? std::string(1, static_cast<char>(key)) : std::string();
}

bool MayRepeat(int key)
{
  return (key >= keys::kLeft && key <= keys::kPageDown) || key == '=' || key == '-' || key == 'N' || key == ',' ||
         key == '.';
}

}  // namespace swarmanoid
