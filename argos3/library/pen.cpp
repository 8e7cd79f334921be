// Loop functions of ARGoS3 draw with OpenGL calls of the old style, between glBegin and glEnd, and with DrawCircle and
// its like. There is no window in the experiment's process, so the calls are recorded: vertices go through the current
// matrix at once, and glEnd turns them into lines, polygons and points of a Drawing, which any visualiser shows. The
// state has the meaning that OpenGL gives it, with two limits: stacks have at most 64 entries, and an error throws
// where OpenGL sets a flag.
#include "argos3/library/pen.h"

#include <stdexcept>

#include "argos3/library/editing.h"

namespace swarmanoid::argos3
{
namespace
{

constexpr std::size_t kDeepest = 64;  // limit of pushes without a pop

}  // namespace

Pen& ThePen(const char* function)
{
  Pen* pen = TheRunning().pen;
  if (pen == nullptr)
    THROW_ARGOSEXCEPTION(function << " is called outside of what draws: DrawInWorld, Draw of the floor, and the "
                                     "functions that RegisterUserFunction names");
  return *pen;
}

void Pen::InWorld()
{
  drawing_.InSpace();
  origin_ = translation_.origin;
  now_ = {};
  attributes_.clear();
  matrices_.clear();
  is_begun_ = false;
}

void Pen::InFrameOf(std::uint32_t entity, double lower_m)
{
  InWorld();
  drawing_.InFrameOf(entity);
  origin_ = Vector3(0, 0, -lower_m);
}

Pose Pen::At(const argos::CVector3& place, const argos::CQuaternion& orientation) const
{
  return {At(place), (Quaternion(now_.matrix.rotation()) * OurOrientation(orientation)).normalized()};
}

Ink Pen::InkOf(const argos::CColor& colour, double width) { return {Rgb(colour), colour.GetAlpha() / 255.0, width}; }

void Pen::Begin(GLenum mode)
{
  if (is_begun_) THROW_ARGOSEXCEPTION("glBegin follows a glBegin without a glEnd between them");
  if (mode > GL_POLYGON) THROW_ARGOSEXCEPTION("glBegin: there is no shape " << mode);
  is_begun_ = true;
  mode_ = mode;
  vertices_.clear();
}

void Pen::Vertex(const Vector3& place)
{
  if (!is_begun_) THROW_ARGOSEXCEPTION("glVertex without a glBegin before it");
  vertices_.push_back(At(place));
}

void Pen::Area(std::initializer_list<std::size_t> corners)
{
  std::vector<Vector3> places;
  for (const std::size_t corner : corners) places.push_back(vertices_[corner]);
  if (now_.polygon == GL_FILL) return drawing_.Polygon(places, now_.ink);
  places.push_back(places.front());
  drawing_.Polyline(places, now_.ink);
}

void Pen::End()
{
  if (!is_begun_) THROW_ARGOSEXCEPTION("glEnd without a glBegin before it");
  is_begun_ = false;
  const std::size_t count = vertices_.size();
  switch (mode_)
  {
    case GL_POINTS:
      return drawing_.Points(vertices_, {now_.ink.colour, now_.ink.opacity, now_.point});
    case GL_LINES:
      for (std::size_t k = 0; k + 1 < count; k += 2) drawing_.Segment(vertices_[k], vertices_[k + 1], now_.ink);
      return;
    case GL_LINE_LOOP:
      if (count > 0) vertices_.push_back(vertices_.front());
      return drawing_.Polyline(vertices_, now_.ink);
    case GL_LINE_STRIP:
      return drawing_.Polyline(vertices_, now_.ink);
    case GL_TRIANGLES:
      for (std::size_t k = 0; k + 2 < count; k += 3) Area({k, k + 1, k + 2});
      return;
    case GL_TRIANGLE_STRIP:
      for (std::size_t k = 0; k + 2 < count; ++k) Area({k, k + 1, k + 2});
      return;
    case GL_TRIANGLE_FAN:
      for (std::size_t k = 1; k + 1 < count; ++k) Area({0, k, k + 1});
      return;
    case GL_QUADS:
      for (std::size_t k = 0; k + 3 < count; k += 4) Area({k, k + 1, k + 2, k + 3});
      return;
    case GL_QUAD_STRIP:
      for (std::size_t k = 0; k + 3 < count; k += 2) Area({k, k + 1, k + 3, k + 2});
      return;
    default:
      if (count < 3) return;
      if (now_.polygon == GL_FILL) return drawing_.Polygon(vertices_, now_.ink);
      vertices_.push_back(vertices_.front());
      return drawing_.Polyline(vertices_, now_.ink);
  }
}

void Pen::PushMatrix()
{
  if (matrices_.size() >= kDeepest) THROW_ARGOSEXCEPTION("glPushMatrix: too many without a glPopMatrix");
  matrices_.push_back(now_.matrix);
}

void Pen::PopMatrix()
{
  if (matrices_.empty()) THROW_ARGOSEXCEPTION("glPopMatrix without a glPushMatrix before it");
  now_.matrix = matrices_.back();
  matrices_.pop_back();
}

void Pen::PushAttributes()
{
  if (attributes_.size() >= kDeepest) THROW_ARGOSEXCEPTION("glPushAttrib: too many without a glPopAttrib");
  attributes_.push_back(now_);
}

void Pen::PopAttributes()
{
  if (attributes_.empty()) THROW_ARGOSEXCEPTION("glPopAttrib without a glPushAttrib before it");
  const Eigen::Affine3d matrix = now_.matrix;
  now_ = attributes_.back();
  now_.matrix = matrix;
  attributes_.pop_back();
}

}  // namespace swarmanoid::argos3
