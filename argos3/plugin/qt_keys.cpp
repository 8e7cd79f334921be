#include "argos3/plugin/qt_keys.h"

#include <map>

namespace swarmanoid::argos3
{

int QtKeyOf(const std::string& name)
{
  // Letters and signs have their ASCII codes as numbers.
  if (name.size() == 1) return static_cast<unsigned char>(name[0]);
  static const std::map<std::string, Qt::Key> keys{
      {"Space", Qt::Key_Space},   {"Return", Qt::Key_Return},       {"Escape", Qt::Key_Escape},
      {"Tab", Qt::Key_Tab},       {"Backspace", Qt::Key_Backspace}, {"Delete", Qt::Key_Delete},
      {"Insert", Qt::Key_Insert}, {"Home", Qt::Key_Home},           {"End", Qt::Key_End},
      {"PageUp", Qt::Key_PageUp}, {"PageDown", Qt::Key_PageDown},   {"Up", Qt::Key_Up},
      {"Down", Qt::Key_Down},     {"Left", Qt::Key_Left},           {"Right", Qt::Key_Right},
      {"Shift", Qt::Key_Shift},   {"Control", Qt::Key_Control},     {"Alt", Qt::Key_Alt}};
  if (const auto found = keys.find(name); found != keys.end()) return found->second;
  if (name.size() <= 3 && name[0] == 'F' && name.find_first_not_of("0123456789", 1) == std::string::npos)
    return Qt::Key_F1 + std::stoi(name.substr(1)) - 1;
  return Qt::Key_unknown;
}

QKeyEvent Keyboard::EventOf(const std::string& name, bool pressed)
{
  const int modifier = name == "Shift"     ? Qt::ShiftModifier
                       : name == "Control" ? Qt::ControlModifier
                       : name == "Alt"     ? Qt::AltModifier
                                           : Qt::NoModifier;
  modifiers_ = pressed ? modifiers_ | modifier : modifiers_ & ~modifier;
  std::string text = name.size() == 1 ? name : name == "Space" ? " " : "";
  if (text.size() == 1 && text[0] >= 'A' && text[0] <= 'Z' && (modifiers_ & Qt::ShiftModifier) == 0)
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return {QtKeyOf(name), modifiers_, text};
}

}  // namespace swarmanoid::argos3
