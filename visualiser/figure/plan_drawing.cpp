// A plan is a vertical projection: each shape loses its height. Lines and polygons are projected point by point. A
// turned cylinder or box is the convex hull of its projected rims or corners, which is exact for a box; a rim is a
// polygon of 36 corners. Widths in pixels become millimetres of the page, so that a figure does not change with its
// scale.
#include "visualiser/figure/plan_drawing.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/math/convex_outline.h"
#include "common/math/elementary.h"
#include "common/space/drawn_shapes.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

using Kind = DrawnShape::Kind;

constexpr double kMillimetresOfPixel = 0.25;
constexpr int kRimPoints = 36;
constexpr double kArrowHead_m = 0.1;  // the largest length; also at most a quarter of the arrow

class PlanDrawer
{
public:
  PlanDrawer(const DrawnShape& shape, std::span<const float> numbers, const Pose& frame, PlanPicture& picture)
      : numbers_(numbers),
        frame_(frame),
        picture_(picture),
        colour_{shape.colour >> 8U, static_cast<double>(shape.colour & 0xffU) / 255},
        width_mm_(kMillimetresOfPixel * shape.width_16 / 16)
  {
  }

  void Draw(Kind kind, const std::string& text)
  {
    switch (kind)
    {
      case Kind::kPoints:
        for (std::size_t k = 0; k < numbers_.size(); k += 3) Dot(At(k));
        break;
      case Kind::kSegments:
      case Kind::kArrows:
        for (std::size_t k = 0; k < numbers_.size(); k += 6)
        {
          Line({At(k), At(k + 3)});
          if (kind == Kind::kArrows) Head(At(k), At(k + 3));
        }
        break;
      case Kind::kPolyline:
        Line(All());
        break;
      case Kind::kPolygon:
        Area(All());
        break;
      case Kind::kCircle:
      case Kind::kDisc:
        kind == Kind::kDisc ? Area(Rim(0)) : Line(Closed(Rim(0)));
        break;
      case Kind::kCylinder:
      {
        std::vector<Vector2> outline = Rim(-Number(8) / 2);
        const std::vector<Vector2> upper = Rim(Number(8) / 2);
        outline.insert(outline.end(), upper.begin(), upper.end());
        Area(ConvexOutline(std::move(outline)));
        break;
      }
      case Kind::kBox:
      {
        std::vector<Vector2> corners;
        for (const double x : {-0.5, 0.5})
          for (const double y : {-0.5, 0.5})
            for (const double z : {-0.5, 0.5}) corners.push_back(Placed({x * Number(7), y * Number(8), z * Number(9)}));
        Area(ConvexOutline(std::move(corners)));
        break;
      }
      case Kind::kText:
      {
        PlanShape& shape = picture_.emplace_back();
        shape.form = PlanShape::Form::kText;
        shape.points = {At(0)};
        shape.fill = colour_;
        shape.text = text;
        break;
      }
    }
  }

private:
  double Number(std::size_t k) const { return static_cast<double>(numbers_[k]); }
  Vector2 At(std::size_t k) const { return frame_.Apply({Number(k), Number(k + 1), Number(k + 2)}).head<2>(); }
  // Returns a point of a shape with a frame in the space.
  Vector2 Placed(const Vector3& local) const
  {
    const Quaternion turn(Number(6), Number(3), Number(4), Number(5));
    return frame_.Apply(Vector3(Number(0), Number(1), Number(2)) + turn.normalized() * local).head<2>();
  }
  std::vector<Vector2> All() const
  {
    std::vector<Vector2> places;
    for (std::size_t k = 0; k < numbers_.size(); k += 3) places.push_back(At(k));
    return places;
  }
  std::vector<Vector2> Rim(double z) const
  {
    std::vector<Vector2> places;
    for (int k = 0; k < kRimPoints; ++k)
    {
      const SinCos angle = SinCosOf(k * (2 * kPi / kRimPoints));
      places.push_back(Placed({Number(7) * angle.cos, Number(7) * angle.sin, z}));
    }
    return places;
  }
  static std::vector<Vector2> Closed(std::vector<Vector2> places)
  {
    places.push_back(places.front());
    return places;
  }

  void Line(std::vector<Vector2> points)
  {
    PlanShape& line = picture_.emplace_back();
    line.form = PlanShape::Form::kLine;
    line.points = std::move(points);
    line.edge = colour_;
    line.edge_mm = width_mm_;
  }
  void Area(std::vector<Vector2> points)
  {
    PlanShape& area = picture_.emplace_back();
    area.points = std::move(points);
    area.fill = colour_;
  }
  void Dot(const Vector2& place)
  {
    PlanShape& dot = picture_.emplace_back();
    dot.form = PlanShape::Form::kDisc;
    dot.points = {place};
    dot.least_radius_mm = width_mm_ / 2;
    dot.fill = colour_;
  }
  void Head(const Vector2& from, const Vector2& to)
  {
    const double length = (to - from).norm();
    if (!(length > 0)) return;
    const double head = std::min(length / 4, kArrowHead_m);
    const Vector2 along = (to - from) / length;
    const Vector2 aside(-along.y(), along.x());
    Area({to, to - head * along + 0.4 * head * aside, to - head * along - 0.4 * head * aside});
  }

  std::span<const float> numbers_;
  const Pose& frame_;
  PlanPicture& picture_;
  PlanColour colour_;
  double width_mm_;
};

}  // namespace

void AddDrawing(const CSwarmanoidSpace& space, PlanPicture& picture)
{
  ForEachDrawnShape(
      space, [&](const DrawnShape& shape, std::span<const float> numbers, std::string_view words, const Pose& frame)
      { PlanDrawer(shape, numbers, frame, picture).Draw(shape.kind, std::string(words)); });
}

}  // namespace swarmanoid
