// Pen: connects the drawing calls of Qt user functions to the drawing of a tick. It holds colour and widths as OpenGL
// does, matrices, and the shape that was begun. The plug-in makes one for each drawing; one thread.
#pragma once

#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_user_functions.h>

#include <Eigen/Geometry>

#include <vector>

#include "argos3/library/running.h"
#include "common/messages/drawing.h"

namespace swarmanoid::argos3
{

class Pen
{
public:
  Pen(Drawing& drawing, const Translation& translation) : drawing_(drawing), translation_(translation) { InWorld(); }

  // Starts drawing in ARGoS3's frame of the arena, with all settings at their defaults.
  void InWorld();
  // Starts drawing in the frame of our entity; ARGoS3's origin is `lower_m` below ours.
  void InFrameOf(std::uint32_t entity, double lower_m);

  Drawing& GetDrawing() { return drawing_; }
  Vector3 At(const argos::CVector3& place) const { return At(Vector3(place.GetX(), place.GetY(), place.GetZ())); }
  Vector3 At(const Vector3& place) const { return origin_ + now_.matrix * place; }
  Pose At(const argos::CVector3& place, const argos::CQuaternion& orientation) const;
  static Ink InkOf(const argos::CColor& colour, double width = 1);

  // These functions implement the functions of OpenGL with the same names.
  void SetColour(const Ink& colour) { now_.ink.colour = colour.colour, now_.ink.opacity = colour.opacity; }
  void SetLineWidth(double pixels) { now_.ink.width = pixels; }
  void SetPointSize(double pixels) { now_.point = pixels; }
  void SetPolygonMode(GLenum mode) { now_.polygon = mode; }
  void Begin(GLenum mode);
  void Vertex(const Vector3& place);
  void End();
  void Transform(const Eigen::Affine3d& by) { now_.matrix = now_.matrix * by; }
  void PushMatrix();
  void PopMatrix();
  void PushAttributes();
  void PopAttributes();
  const Ink& Colour() const { return now_.ink; }

private:
  struct Settings
  {
    Ink ink;
    double point = 1;  // pixels
    GLenum polygon = GL_FILL;
    Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
  };

  void Area(std::initializer_list<std::size_t> corners);

  Drawing& drawing_;
  const Translation& translation_;
  Vector3 origin_ = Vector3::Zero();
  Settings now_;
  std::vector<Settings> attributes_;
  std::vector<Eigen::Affine3d> matrices_;
  bool is_begun_ = false;
  GLenum mode_ = GL_POINTS;
  std::vector<Vector3> vertices_;
};

// Returns the current pen. Throws CARGoSException if nothing is being drawn. `function`: the caller, for the message.
Pen& ThePen(const char* function);

}  // namespace swarmanoid::argos3
