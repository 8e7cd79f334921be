// CQTOpenGLUserFunctions: drawings and keys of users, with the interface of ARGoS3's Qt window. They run beside the
// loop functions, and the visualisers of this simulator show their drawings. Neither Qt nor OpenGL is used.
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
  // Gets <user_functions>, after Init of the loop functions. Destroy is called before theirs.
  void Init(TConfigurationNode&) override {}
  void Reset() override {}
  void Destroy() override {}

  // Handles a pressed key, from a window or page of this simulator, or from `swarmanoid control`. The functions for
  // keys and selections are called between two steps, and may do all that loop functions may do.
  virtual void KeyPressed(QKeyEvent* event) { GetQTOpenGLWidget().KeyPressed(event); }
  // Handles a released key.
  virtual void KeyReleased(QKeyEvent* event) { GetQTOpenGLWidget().KeyReleased(event); }
  // Called when a user has selected an entity.
  virtual void EntitySelected(CEntity&) {}
  // Called when a user has ended the selection of an entity.
  virtual void EntityDeselected(CEntity&) {}
  // Never called, since windows and pages handle the mouse themselves.
  virtual void MouseKeyPressed(QMouseEvent*) {}
  // Never called, as MouseKeyPressed.
  virtual void MouseKeyReleased(QMouseEvent*) {}
  // Never called, as MouseKeyPressed.
  virtual void MouseMoved(QMouseEvent*) {}
  // Never called, since moves of entities are requests to the run.
  virtual void EntityMoved(CEntity&, const CVector3& /*old_position*/, const CVector3& /*new_position*/) {}
  // Never called, as EntityMoved.
  virtual void EntityRotated(CEntity&, const CQuaternion& /*old_orientation*/, const CQuaternion& /*new_orientation*/)
  {
  }

  // Returns nullptr if no entity is selected.
  CEntity* GetSelectedEntity() { return selected_; }
  // Selects only here; windows and pages do not show it.
  virtual void SelectEntity(CEntity& entity);
  // Ends the selection here.
  virtual void DeselectEntity();

  // Draws in the world. Called when a picture is due and a visualiser shows the run; it cannot change the run.
  virtual void DrawInWorld() {}
  // Draws on the floor, at the same times.
  virtual void Draw(CFloorEntity&) {}
  // Never called, since drawings over pictures do not exist here.
  virtual void DrawOverlay(QPainter&) {}
  // Registers `function` to draw each entity of exactly this class, in the frame of the entity.
  template <typename USER_IMPL, typename ENTITY>
  void RegisterUserFunction(void (USER_IMPL::*function)(ENTITY&))
  {
    functions_.push_back({&typeid(ENTITY), [this, function](CEntity& entity)
                          { (static_cast<USER_IMPL&>(*this).*function)(static_cast<ENTITY&>(entity)); }});
  }
  // Calls the function that was registered last for the entity's class, if one exists.
  virtual void Call(CEntity& entity);

  CQTOpenGLMainWindow& GetMainWindow() { return window_; }
  CQTOpenGLWidget& GetQTOpenGLWidget() { return window_.GetOpenGLWidget(); }
  CQTOpenGLWidget& GetOpenGLWidget() { return window_.GetOpenGLWidget(); }

  // These functions work within the drawing functions above; elsewhere they throw CARGoSException. Lengths are in
  // metres, widths and diameters in pixels. Orientations turn shapes of the x, y plane.
  void SetColor(const CColor& colour);
  void DrawPoint(const CVector3& position, const CColor& colour = CColor::RED, Real diameter = 5.0);
  // The base lies along x with its middle at the position; the tip points along y.
  void DrawTriangle(const CVector3& position, const CQuaternion& orientation, Real base, Real height,
                    const CColor& colour = CColor::RED, bool fill = true);
  // A filled polygon must be convex.
  void DrawPolygon(const CVector3& position, const CQuaternion& orientation, const std::vector<CVector2>& points,
                   const CColor& colour = CColor::RED, bool fill = true);
  void DrawCircle(const CVector3& position, const CQuaternion& orientation, Real radius,
                  const CColor& colour = CColor::RED, bool fill = true, GLuint vertices = 20);
  // The position is the middle of the cylinder.
  void DrawCylinder(const CVector3& position, const CQuaternion& orientation, Real radius, Real height,
                    const CColor& colour = CColor::RED, GLuint vertices = 20);
  void DrawBox(const CVector3& position, const CQuaternion& orientation, const CVector3& size,
               const CColor& colour = CColor::RED);
  void DrawRay(const CRay3& ray, const CColor& colour = CColor::RED, Real width = 1.0);
  void DrawText(const CVector3& position, const std::string& text, const CColor& colour = CColor::BLACK,
                const QFont& font = QFont());

protected:
  // These are functions of OpenGL: shapes between glBegin and glEnd, moved by the matrices, in the current colour and
  // width. Other switches have no effect.
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
  // Rotates by degrees about an axis.
  void glRotated(GLdouble angle, GLdouble x, GLdouble y, GLdouble z);
  void glRotatef(GLfloat angle, GLfloat x, GLfloat y, GLfloat z) { glRotated(angle, x, y, z); }
  void glScaled(GLdouble x, GLdouble y, GLdouble z);
  void glScalef(GLfloat x, GLfloat y, GLfloat z) { glScaled(x, y, z); }
  // Saves all of the above.
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

// The macro below makes it.
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
