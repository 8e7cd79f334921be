// Keys by our names (UserInput) as events of Qt.
#pragma once

#include <argos3/plugins/simulator/visualizations/qt-opengl/qt_names.h>

#include <string>

namespace swarmanoid::argos3
{

// The number of a key there; Key_unknown for none that is known.
int QtKeyOf(const std::string& name);

// Remembers which of Shift, Control and Alt are held.
class Keyboard
{
public:
  QKeyEvent EventOf(const std::string& name, bool pressed);

private:
  int modifiers_ = Qt::NoModifier;
};

}  // namespace swarmanoid::argos3
