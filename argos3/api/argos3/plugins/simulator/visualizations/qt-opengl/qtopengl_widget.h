// What user functions know of the window: there is none here, but the visualisers of this simulator.
#pragma once

#include <argos3/plugins/simulator/visualizations/qt-opengl/qt_names.h>

namespace argos
{

class CQTOpenGLWidget
{
public:
  // Keys that user functions leave to the window. It has had them before.
  void KeyPressed(QKeyEvent*) {}
  void KeyReleased(QKeyEvent*) {}
  // Pictures are drawn when a visualiser has time.
  void update() {}
  // As DrawText of the user functions, in the colour that SetColor or glColor was given last.
  void renderText(double x, double y, double z, const QString& text, const QFont& font = QFont());
};

}  // namespace argos
