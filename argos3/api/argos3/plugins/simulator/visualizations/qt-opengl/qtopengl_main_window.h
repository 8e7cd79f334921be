// What user functions know of the main window.
#pragma once

#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_widget.h>

namespace argos
{

class CQTOpenGLMainWindow
{
public:
  CQTOpenGLWidget& GetOpenGLWidget() { return widget_; }

private:
  CQTOpenGLWidget widget_;
};

}  // namespace argos
