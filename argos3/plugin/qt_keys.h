// Converts keys with our names (UserInput) to events of Qt.
#pragma once

#include <argos3/plugins/simulator/visualizations/qt-opengl/qt_names.h>

#include <string>

namespace swarmanoid::argos3
{

// Returns Qt's number of a key; Key_unknown for an unknown one.
int QtKeyOf(const std::string& name);

// Records which of Shift, Control and Alt are held.
class Keyboard
{
public:
  QKeyEvent EventOf(const std::string& name, bool pressed);

private:
  int modifiers_ = Qt::NoModifier;
};

}  // namespace swarmanoid::argos3
