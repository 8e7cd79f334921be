// The table of a window's keys. The commands, the help in the window and the list in the documentation follow from it.
// Every renderer with a window uses it, with any library for the keys.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace swarmanoid
{

// Keys with a character have its code, with letters in upper case.
namespace keys
{
inline constexpr int kEscape = 256;
inline constexpr int kTab = 257;
inline constexpr int kHome = 258;
inline constexpr int kEnd = 259;
inline constexpr int kLeft = 260;
inline constexpr int kRight = 261;
inline constexpr int kUp = 262;
inline constexpr int kDown = 263;
inline constexpr int kPageUp = 264;
inline constexpr int kPageDown = 265;
inline constexpr int kFunction = 300;  // kFunction + n: the key Fn
}  // namespace keys

struct KeyPress
{
  int key = 0;
  bool ctrl = false;
  bool shift = false;

  bool operator==(const KeyPress&) const = default;
};

enum class Action
{
  kHelp,
  kRunPanel,
  kEntityPanel,
  kPlotPanel,
  kTimelinePanel,
  kAllPanels,
  kPause,
  kStep,
  kStepTen,
  kFaster,
  kSlower,
  kTextures,
  kShadows,
  kCollisionModels,
  kIds,
  kTrails,
  kRays,
  kBeams,
  kTickBack,
  kTickForward,
  kEventBack,
  kEventForward,
  kPlayPast,
  kPresent,
  kBranch,
  kInspectPast,
  kFollow,
  kDeselect,
  kKeysToFunctions,
  kWholeArena,
  kFromAbove,
  kRecall,
  kStore,
  kOrbitLeft,
  kOrbitRight,
  kOrbitUp,
  kOrbitDown,
  kZoomIn,
  kZoomOut,
  kPicture,
  kClose,
  kMouse  // no key: a line of the help about the mouse
};

struct KeyBinding
{
  Action action;
  KeyPress press;  // for kRecall and kStore: the key of viewpoint 0
  std::string_view section;
  std::string_view keys;  // the name in the help; empty if another binding's line covers it
  std::string_view meaning;
};

// Returns the table of keys in the order of the help.
std::span<const KeyBinding> KeyBindings();

struct KeyCommand
{
  Action action;
  int number = 0;  // the number of a viewpoint
};
// Returns the command of a key; nullopt for a key without one.
std::optional<KeyCommand> CommandOf(const KeyPress& press);
// Returns the name of a key for experiment functions (UserInput); empty for keys that they do not get.
std::string NameOfKey(int key);
// Returns whether a held key repeats its action: keys that turn, zoom and step.
bool MayRepeat(int key);

}  // namespace swarmanoid
