// The part of the widget that user functions can use. There is no Qt window; the visualisers of this simulator draw.
#pragma once

#include <argos3/plugins/simulator/visualizations/qt-opengl/qt_names.h>

namespace argos
{

class CQTOpenGLWidget
{
public:
  // Gets keys that user functions pass on. Does nothing, since the window has handled them before.
  void KeyPressed(QKeyEvent*) {}
  void KeyReleased(QKeyEvent*) {}
  // Does nothing, since a visualiser draws when it has time.
  void update() {}
  // Draws as DrawText of the user functions, in the last colour of SetColor or glColor.
  void renderText(double x, double y, double z, const QString& text, const QFont& font = QFont());
};

}  // namespace argos
