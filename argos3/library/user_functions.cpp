// Implements CQTOpenGLUserFunctions by the drawing of a tick.
#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_user_functions.h>

#include <algorithm>

#include "argos3/library/pen.h"
#include "common/math/elementary.h"

namespace argos
{
namespace
{

using swarmanoid::Ink;
using swarmanoid::Vector3;
using swarmanoid::argos3::Pen;
using swarmanoid::argos3::ThePen;

// Converts errors of drawing to exceptions that ARGoS3's users catch.
template <class Call>
void Drawn(Call call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& mistake)
  {
    throw CARGoSException(mistake.what());
  }
}

// Draws an area, or its outline, in the plane of x and y of a pose.
void DrawFlat(Pen& pen, const swarmanoid::Pose& pose, std::vector<Vector3> corners, const CColor& colour, bool fill)
{
  for (Vector3& corner : corners) corner = pose.Apply(corner);
  if (!fill) corners.push_back(corners.front());
  Drawn(
      [&]
      {
        if (fill)
          pen.GetDrawing().Polygon(corners, Pen::InkOf(colour));
        else
          pen.GetDrawing().Polyline(corners, Pen::InkOf(colour));
      });
}

}  // namespace

void CQTOpenGLUserFunctions::SelectEntity(CEntity& entity)
{
  if (selected_ == &entity) return;
  DeselectEntity();
  selected_ = &entity;
  EntitySelected(entity);
}

void CQTOpenGLUserFunctions::DeselectEntity()
{
  CEntity* before = selected_;
  selected_ = nullptr;
  if (before != nullptr) EntityDeselected(*before);
}

void CQTOpenGLUserFunctions::Call(CEntity& entity)
{
  const auto found = std::find_if(functions_.rbegin(), functions_.rend(),
                                  [&](const SFunction& function) { return *function.of == typeid(entity); });
  if (found != functions_.rend()) found->draw(entity);
}

void CQTOpenGLUserFunctions::SetColor(const CColor& colour) { ThePen("SetColor").SetColour(Pen::InkOf(colour)); }

void CQTOpenGLUserFunctions::DrawPoint(const CVector3& position, const CColor& colour, Real diameter)
{
  Pen& pen = ThePen("DrawPoint");
  Drawn([&] { pen.GetDrawing().Point(pen.At(position), Pen::InkOf(colour, diameter)); });
}

void CQTOpenGLUserFunctions::DrawTriangle(const CVector3& position, const CQuaternion& orientation, Real base,
                                          Real height, const CColor& colour, bool fill)
{
  Pen& pen = ThePen("DrawTriangle");
  DrawFlat(pen, pen.At(position, orientation), {{-base / 2, 0, 0}, {base / 2, 0, 0}, {0, height, 0}}, colour, fill);
}

void CQTOpenGLUserFunctions::DrawPolygon(const CVector3& position, const CQuaternion& orientation,
                                         const std::vector<CVector2>& points, const CColor& colour, bool fill)
{
  Pen& pen = ThePen("DrawPolygon");
  if (points.size() < 3) THROW_ARGOSEXCEPTION("DrawPolygon: it has " << points.size() << " points; it needs 3");
  std::vector<Vector3> corners;
  for (const CVector2& point : points) corners.emplace_back(point.GetX(), point.GetY(), 0);
  DrawFlat(pen, pen.At(position, orientation), std::move(corners), colour, fill);
}

void CQTOpenGLUserFunctions::DrawCircle(const CVector3& position, const CQuaternion& orientation, Real radius,
                                        const CColor& colour, bool fill, GLuint)
{
  Pen& pen = ThePen("DrawCircle");
  const swarmanoid::Pose pose = pen.At(position, orientation);
  Drawn(
      [&]
      {
        if (fill)
          pen.GetDrawing().Disc(pose, radius, Pen::InkOf(colour));
        else
          pen.GetDrawing().Circle(pose, radius, Pen::InkOf(colour));
      });
}

void CQTOpenGLUserFunctions::DrawCylinder(const CVector3& position, const CQuaternion& orientation, Real radius,
                                          Real height, const CColor& colour, GLuint)
{
  Pen& pen = ThePen("DrawCylinder");
  Drawn([&] { pen.GetDrawing().Cylinder(pen.At(position, orientation), radius, height, Pen::InkOf(colour)); });
}

void CQTOpenGLUserFunctions::DrawBox(const CVector3& position, const CQuaternion& orientation, const CVector3& size,
                                     const CColor& colour)
{
  Pen& pen = ThePen("DrawBox");
  const Vector3 edges(size.GetX(), size.GetY(), size.GetZ());
  Drawn([&] { pen.GetDrawing().Box(pen.At(position, orientation), edges, Pen::InkOf(colour)); });
}

void CQTOpenGLUserFunctions::DrawRay(const CRay3& ray, const CColor& colour, Real width)
{
  Pen& pen = ThePen("DrawRay");
  Drawn([&] { pen.GetDrawing().Segment(pen.At(ray.GetStart()), pen.At(ray.GetEnd()), Pen::InkOf(colour, width)); });
}

void CQTOpenGLUserFunctions::DrawText(const CVector3& position, const std::string& text, const CColor& colour,
                                      const QFont&)
{
  Pen& pen = ThePen("DrawText");
  Drawn([&] { pen.GetDrawing().Text(pen.At(position), text, Pen::InkOf(colour)); });
}

void CQTOpenGLWidget::renderText(double x, double y, double z, const QString& text, const QFont&)
{
  Pen& pen = ThePen("renderText");
  Drawn([&] { pen.GetDrawing().Text(pen.At(Vector3(x, y, z)), text.toStdString(), pen.Colour()); });
}

void CQTOpenGLUserFunctions::glBegin(GLenum mode) { ThePen("glBegin").Begin(mode); }

void CQTOpenGLUserFunctions::glEnd()
{
  Pen& pen = ThePen("glEnd");
  Drawn([&] { pen.End(); });
}

void CQTOpenGLUserFunctions::glVertex3d(GLdouble x, GLdouble y, GLdouble z)
{
  ThePen("glVertex").Vertex(Vector3(x, y, z));
}

void CQTOpenGLUserFunctions::glColor4d(GLdouble red, GLdouble green, GLdouble blue, GLdouble opacity)
{
  const auto channel = [](double value) { return static_cast<UInt8>(255 * std::min(std::max(value, 0.0), 1.0) + 0.5); };
  ThePen("glColor").SetColour(Pen::InkOf(CColor(channel(red), channel(green), channel(blue), channel(opacity))));
}

void CQTOpenGLUserFunctions::glMaterialfv(GLenum, GLenum name, const GLfloat* values)
{
  if (name == GL_DIFFUSE || name == GL_AMBIENT_AND_DIFFUSE)
    glColor4d(static_cast<double>(values[0]), static_cast<double>(values[1]), static_cast<double>(values[2]),
              static_cast<double>(values[3]));
}

void CQTOpenGLUserFunctions::glLineWidth(GLfloat pixels)
{
  ThePen("glLineWidth").SetLineWidth(static_cast<double>(pixels));
}

void CQTOpenGLUserFunctions::glPointSize(GLfloat pixels)
{
  ThePen("glPointSize").SetPointSize(static_cast<double>(pixels));
}

void CQTOpenGLUserFunctions::glPolygonMode(GLenum, GLenum mode) { ThePen("glPolygonMode").SetPolygonMode(mode); }

void CQTOpenGLUserFunctions::glPushMatrix() { ThePen("glPushMatrix").PushMatrix(); }
void CQTOpenGLUserFunctions::glPopMatrix() { ThePen("glPopMatrix").PopMatrix(); }

void CQTOpenGLUserFunctions::glTranslated(GLdouble x, GLdouble y, GLdouble z)
{
  ThePen("glTranslate").Transform(Eigen::Affine3d(Eigen::Translation3d(x, y, z)));
}

void CQTOpenGLUserFunctions::glRotated(GLdouble angle, GLdouble x, GLdouble y, GLdouble z)
{
  const Vector3 axis(x, y, z);
  if (!(axis.norm() > 0)) THROW_ARGOSEXCEPTION("glRotate: the axis is no direction");
  ThePen("glRotate")
      .Transform(Eigen::Affine3d(Eigen::AngleAxisd(swarmanoid::DegreesToRadians(angle), axis.normalized())));
}

void CQTOpenGLUserFunctions::glScaled(GLdouble x, GLdouble y, GLdouble z)
{
  ThePen("glScale").Transform(Eigen::Affine3d(Eigen::Scaling(x, y, z)));
}

void CQTOpenGLUserFunctions::glPushAttrib(GLbitfield) { ThePen("glPushAttrib").PushAttributes(); }
void CQTOpenGLUserFunctions::glPopAttrib() { ThePen("glPopAttrib").PopAttributes(); }

}  // namespace argos
