// Cuts each shape into lines, triangles, dots and texts. Curved shapes have kSides edges. The light on faces is
// computed here, so that renderers draw triangles in plain colours. A polygon becomes a fan from its first corner, so
// it must be convex.
#include "visualiser/scene/drawn_marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "common/space/drawn_shapes.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

using Eigen::Isometry3f;
using Eigen::Quaternionf;
using Eigen::Translation3f;
using Eigen::Vector3f;
using Kind = DrawnShape::Kind;

constexpr int kSides = 36;            // edges of a circle
constexpr float kHeadPart = 0.25F;    // length of an arrow's head relative to the arrow …
constexpr float kLongestHead = 0.1F;  // … but no more metres
constexpr float kHeadSlope = 0.4F;

// The light comes from the left behind the default view, rather high, as in the pictures of bodies.
const Vector3f kTowardsSun = Vector3f(-0.58F, -0.20F, 0.79F).normalized();

Colour Lit(Colour colour, const Vector3f& normal)
{
  const float light = 0.62F + 0.38F * std::max(normal.dot(kTowardsSun), 0.0F);
  const auto channel = [&](int shift)
  { return static_cast<Colour>(std::lround(static_cast<float>((colour >> shift) & 0xff) * light)) << shift; };
  return channel(16) | channel(8) | channel(0);
}

class Cutter
{
public:
  Cutter(const DrawnShape& shape, std::span<const float> numbers, const Isometry3f& frame, DrawnMarks& marks)
      : numbers_(numbers),
        frame_(frame),
        marks_(marks),
        colour_(shape.colour >> 8U),
        opacity_(static_cast<float>(shape.colour & 0xffU) / 255),
        width_(static_cast<float>(shape.width_16) / 16)
  {
  }

  void Cut(Kind kind, std::string_view text)
  {
    switch (kind)
    {
      case Kind::kPoints:
        for (std::size_t k = 0; k + 3 <= numbers_.size(); k += 3)
          marks_.dots.push_back({frame_ * At(k), colour_, opacity_, width_});
        break;
      case Kind::kSegments:
        for (std::size_t k = 0; k + 6 <= numbers_.size(); k += 6) Line(frame_ * At(k), frame_ * At(k + 3));
        break;
      case Kind::kPolyline:
        for (std::size_t k = 0; k + 6 <= numbers_.size(); k += 3) Line(frame_ * At(k), frame_ * At(k + 3));
        break;
      case Kind::kArrows:
        for (std::size_t k = 0; k + 6 <= numbers_.size(); k += 6) Arrow(frame_ * At(k), frame_ * At(k + 3));
        break;
      case Kind::kPolygon:
        for (std::size_t k = 3; k + 6 <= numbers_.size(); k += 3)
          Triangle(frame_ * At(0), frame_ * At(k), frame_ * At(k + 3), colour_);
        break;
      case Kind::kCircle:
      case Kind::kDisc:
        Round(kind == Kind::kDisc);
        break;
      case Kind::kBox:
        Box();
        break;
      case Kind::kCylinder:
        Cylinder();
        break;
      case Kind::kText:
        marks_.texts.push_back({frame_ * At(0), std::string(text), colour_, opacity_});
        break;
    }
  }

private:
  Vector3f At(std::size_t k) const { return {numbers_[k], numbers_[k + 1], numbers_[k + 2]}; }
  // Returns the frame of shapes that have one.
  Isometry3f Place() const
  {
    return frame_ * Translation3f(At(0)) * Quaternionf(numbers_[6], numbers_[3], numbers_[4], numbers_[5]).normalized();
  }

  void Line(const Vector3f& from, const Vector3f& to) { marks_.lines.push_back({from, to, colour_, opacity_, width_}); }
  void Triangle(const Vector3f& a, const Vector3f& b, const Vector3f& c, Colour colour)
  {
    marks_.triangles.push_back({{a, b, c}, colour, opacity_});
  }
  void Quadrangle(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Vector3f& d)
  {
    const Vector3f across = (b - a).cross(d - a);
    const Colour lit = Lit(colour_, across.norm() > 0 ? across.normalized() : Vector3f::UnitZ());
    Triangle(a, b, c, lit);
    Triangle(a, c, d, lit);
  }

  // Adds an arrow with a flat head, upright or on the floor like the arrow.
  void Arrow(const Vector3f& from, const Vector3f& to)
  {
    Line(from, to);
    const Vector3f way = to - from;
    const float length = way.norm();
    if (!(length > 0)) return;
    const Vector3f along = way / length;
    const float head = std::min(kHeadPart * length, kLongestHead);
    const Vector3f up = std::abs(along.z()) < 0.9F ? Vector3f::UnitZ() : Vector3f::UnitX();
    const Vector3f aside = along.cross(up).normalized() * head * kHeadSlope;
    const Vector3f base = to - head * along;
    Triangle(to, base + aside, base - aside, colour_);
  }

  static Vector3f Rim(int side, float radius, float z = 0)
  {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(side % kSides) / kSides;
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }

  void Round(bool filled)
  {
    const Isometry3f place = Place();
    const float radius = numbers_[7];
    for (int side = 0; side < kSides; ++side)
    {
      const Vector3f a = place * Rim(side, radius);
      const Vector3f b = place * Rim(side + 1, radius);
      if (filled)
        Triangle(place.translation(), a, b, colour_);
      else
        Line(a, b);
    }
  }

  void Box()
  {
    const Isometry3f place = Place();
    const Vector3f half = At(7) / 2;
    const auto at = [&](float x, float y, float z) { return Vector3f(place * Vector3f(x, y, z).cwiseProduct(half)); };
    Quadrangle(at(-1, -1, 1), at(1, -1, 1), at(1, 1, 1), at(-1, 1, 1));
    Quadrangle(at(-1, 1, -1), at(1, 1, -1), at(1, -1, -1), at(-1, -1, -1));
    Quadrangle(at(1, -1, -1), at(1, 1, -1), at(1, 1, 1), at(1, -1, 1));
    Quadrangle(at(-1, 1, -1), at(-1, -1, -1), at(-1, -1, 1), at(-1, 1, 1));
    Quadrangle(at(1, 1, -1), at(-1, 1, -1), at(-1, 1, 1), at(1, 1, 1));
    Quadrangle(at(-1, -1, -1), at(1, -1, -1), at(1, -1, 1), at(-1, -1, 1));
  }

  void Cylinder()
  {
    const Isometry3f place = Place();
    const float radius = numbers_[7];
    const float half = numbers_[8] / 2;
    const Vector3f axis = place.linear() * Vector3f::UnitZ();
    const Colour top = Lit(colour_, axis);
    const Colour bottom = Lit(colour_, -axis);
    for (int side = 0; side < kSides; ++side)
    {
      const Vector3f low_a = place * Rim(side, radius, -half);
      const Vector3f low_b = place * Rim(side + 1, radius, -half);
      const Vector3f high_a = place * Rim(side, radius, half);
      const Vector3f high_b = place * Rim(side + 1, radius, half);
      Quadrangle(low_a, low_b, high_b, high_a);
      Triangle(place * Vector3f(0, 0, half), high_a, high_b, top);
      Triangle(place * Vector3f(0, 0, -half), low_b, low_a, bottom);
    }
  }

  std::span<const float> numbers_;
  const Isometry3f& frame_;
  DrawnMarks& marks_;
  Colour colour_;
  float opacity_;
  float width_;
};

}  // namespace

void CutDrawing(const DrawnState& state, DrawnMarks& marks)
{
  marks.lines.clear();
  marks.triangles.clear();
  marks.dots.clear();
  marks.texts.clear();
  ForEachDrawnShape(
      state,
      [&](const DrawnShape& shape, std::span<const float> numbers, std::string_view words, const Pose& pose)
      {
        const Isometry3f frame(Translation3f(pose.position.cast<float>()) * pose.orientation.cast<float>());
        Cutter(shape, numbers, frame, marks).Cut(shape.kind, words);
      });
}

}  // namespace swarmanoid
