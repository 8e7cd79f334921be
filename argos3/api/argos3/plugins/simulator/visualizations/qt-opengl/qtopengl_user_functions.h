// CQTOpenGLUserFunctions: drawings and keys of users, as the Qt window of ARGoS3 has them. Here they run beside the
// loop functions, and the visualisers of this simulator show what they draw. Nothing of Qt or OpenGL is used.
//
//   <visualization><qt-opengl><user_functions library="…" label="…"/></qt-opengl></visualization>
#pragma once

#include <argos3/core/simulator/entity/entity.h>
#include <argos3/core/simulator/entity/floor_entity.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/core/utility/math/ray3.h>
#include <argos3/plugins/simulator/visualizations/qt-opengl/gl_names.h>
#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_main_window.h>

#include <functional>
#include <typeinfo>
#include <vector>

class QPainter;

namespace argos
{

class CQTOpenGLUserFunctions : public CBaseConfigurableResource
{
public:
  // <user_functions>, behind Init of the loop functions. Destroy comes before theirs.
  void Init(TConfigurationNode&) override {}
  void Reset() override {}
  void Destroy() override {}

  // A key, and whom a user selects, in a window or on a page of this simulator, or by `swarmanoid control`. They come
  // between two steps, and may do what loop functions may.
  virtual void KeyPressed(QKeyEvent* event) { GetQTOpenGLWidget().KeyPressed(event); }
  virtual void KeyReleased(QKeyEvent* event) { GetQTOpenGLWidget().KeyReleased(event); }
  virtual void EntitySelected(CEntity&) {}
  virtual void EntityDeselected(CEntity&) {}
  // Nobody calls these here: windows and pages keep the mouse to themselves, and whoever moves an entity asks the run.
  virtual void MouseKeyPressed(QMouseEvent*) {}
  virtual void MouseKeyReleased(QMouseEvent*) {}
  virtual void MouseMoved(QMouseEvent*) {}
  virtual void EntityMoved(CEntity&, const CVector3& /*old_position*/, const CVector3& /*new_position*/) {}
  virtual void EntityRotated(CEntity&, const CQuaternion& /*old_orientation*/, const CQuaternion& /*new_orientation*/)
  {
  }

  // nullptr: none is.
  CEntity* GetSelectedEntity() { return selected_; }
  // Here alone: windows and pages do not show it.
  virtual void SelectEntity(CEntity& entity);
  virtual void DeselectEntity();

  // Called when a picture is due, if somebody looks; they can change nothing. In the world.
  virtual void DrawInWorld() {}
  virtual void Draw(CFloorEntity&) {}
  // Not called: there is nothing to draw over pictures.
  virtual void DrawOverlay(QPainter&) {}
  // `function` draws each entity of exactly this class, in the frame of the entity.
  template <typename USER_IMPL, typename ENTITY>
  void RegisterUserFunction(void (USER_IMPL::*function)(ENTITY&))
  {
    functions_.push_back({&typeid(ENTITY), [this, function](CEntity& entity)
                          { (static_cast<USER_IMPL&>(*this).*function)(static_cast<ENTITY&>(entity)); }});
  }
  // The function that was registered last for its class, if there is one.
  virtual void Call(CEntity& entity);

  CQTOpenGLMainWindow& GetMainWindow() { return window_; }
  CQTOpenGLWidget& GetQTOpenGLWidget() { return window_.GetOpenGLWidget(); }
  CQTOpenGLWidget& GetOpenGLWidget() { return window_.GetOpenGLWidget(); }

  // Within the functions above that draw; elsewhere they throw CARGoSException. Metres; widths and diameters in pixels.
  // Orientations turn what lies in the plane of x and y.
  void SetColor(const CColor& colour);
  void DrawPoint(const CVector3& position, const CColor& colour = CColor::RED, Real diameter = 5.0);
  // Its base lies along x, its middle at the position; the tip points along y.
  void DrawTriangle(const CVector3& position, const CQuaternion& orientation, Real base, Real height,
                    const CColor& colour = CColor::RED, bool fill = true);
  // Convex if it is filled.
  void DrawPolygon(const CVector3& position, const CQuaternion& orientation, const std::vector<CVector2>& points,
                   const CColor& colour = CColor::RED, bool fill = true);
  void DrawCircle(const CVector3& position, const CQuaternion& orientation, Real radius,
                  const CColor& colour = CColor::RED, bool fill = true, GLuint vertices = 20);
  // The position is that of the middle.
  void DrawCylinder(const CVector3& position, const CQuaternion& orientation, Real radius, Real height,
                    const CColor& colour = CColor::RED, GLuint vertices = 20);
  void DrawBox(const CVector3& position, const CQuaternion& orientation, const CVector3& size,
               const CColor& colour = CColor::RED);
  void DrawRay(const CRay3& ray, const CColor& colour = CColor::RED, Real width = 1.0);
  void DrawText(const CVector3& position, const std::string& text, const CColor& colour = CColor::BLACK,
                const QFont& font = QFont());

protected:
  // Of OpenGL: shapes between glBegin and glEnd, moved by the matrices since, in the colour and width that were set.
  // Whatever else is switched on or off changes nothing.
  void glBegin(GLenum mode);
  void glEnd();
  void glVertex3d(GLdouble x, GLdouble y, GLdouble z);
  void glVertex3f(GLfloat x, GLfloat y, GLfloat z) { glVertex3d(x, y, z); }
  void glVertex2d(GLdouble x, GLdouble y) { glVertex3d(x, y, 0); }
  void glVertex2f(GLfloat x, GLfloat y) { glVertex3d(x, y, 0); }
  void glNormal3f(GLfloat, GLfloat, GLfloat) {}
  void glNormal3d(GLdouble, GLdouble, GLdouble) {}
  void glColor4d(GLdouble red, GLdouble green, GLdouble blue, GLdouble opacity);
  void glColor4f(GLfloat red, GLfloat green, GLfloat blue, GLfloat opacity) { glColor4d(red, green, blue, opacity); }
  void glColor3d(GLdouble red, GLdouble green, GLdouble blue) { glColor4d(red, green, blue, 1); }
  void glColor3f(GLfloat red, GLfloat green, GLfloat blue) { glColor4d(red, green, blue, 1); }
  void glColor4ub(GLubyte red, GLubyte green, GLubyte blue, GLubyte opacity)
  {
    SetColor(CColor(red, green, blue, opacity));
  }
  void glColor3ub(GLubyte red, GLubyte green, GLubyte blue) { SetColor(CColor(red, green, blue)); }
  void glMaterialfv(GLenum face, GLenum name, const GLfloat* values);
  void glLineWidth(GLfloat pixels);
  void glPointSize(GLfloat pixels);
  void glPolygonMode(GLenum face, GLenum mode);
  void glPushMatrix();
  void glPopMatrix();
  void glTranslated(GLdouble x, GLdouble y, GLdouble z);
  void glTranslatef(GLfloat x, GLfloat y, GLfloat z) { glTranslated(x, y, z); }
  // Degrees about an axis.
  void glRotated(GLdouble angle, GLdouble x, GLdouble y, GLdouble z);
  void glRotatef(GLfloat angle, GLfloat x, GLfloat y, GLfloat z) { glRotated(angle, x, y, z); }
  void glScaled(GLdouble x, GLdouble y, GLdouble z);
  void glScalef(GLfloat x, GLfloat y, GLfloat z) { glScaled(x, y, z); }
  // All that is set above.
  void glPushAttrib(GLbitfield);
  void glPopAttrib();
  void glEnable(GLenum) {}
  void glDisable(GLenum) {}

private:
  struct SFunction
  {
    const std::type_info* of;
    std::function<void(CEntity&)> draw;
  };

  std::vector<SFunction> functions_;
  CEntity* selected_ = nullptr;
  CQTOpenGLMainWindow window_;
};

// Made by the macro below.
struct SUserFunctionsRegistration
{
  SUserFunctionsRegistration(const char* label, CQTOpenGLUserFunctions* (*create)());
};

}  // namespace argos

#define REGISTER_QTOPENGL_USER_FUNCTIONS(CLASS, LABEL)                                                          \
  namespace                                                                                                     \
  {                                                                                                             \
  const argos::SUserFunctionsRegistration argos3_registration_of_##CLASS(LABEL,                                 \
                                                                         []() -> argos::CQTOpenGLUserFunctions* \
                                                                         { return new CLASS; });                \
  }
