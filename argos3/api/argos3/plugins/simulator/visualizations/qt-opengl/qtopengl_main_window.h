// The part of the main window that user functions can use.
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
