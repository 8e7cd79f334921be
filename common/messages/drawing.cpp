#include "common/messages/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

using Kind = DrawnShape::Kind;

constexpr double kFarthest = 1e9;  // m: numbers stay finite in whatever is computed of them

void RequireFinite(double value, const char* what)
{
  if (!(std::abs(value) <= kFarthest))
    throw std::invalid_argument(
        fmt::format("drawing: {} is {}; it must be a number up to {:g}", what, value, kFarthest));
}

void RequireSize(double value, const char* what)
{
  RequireFinite(value, what);
  if (value < 0) throw std::invalid_argument(fmt::format("drawing: {} is {}; it must not be negative", what, value));
}

std::uint32_t ColourOf(const Ink& ink)
{
  if (ink.colour > 0xffffff)
    throw std::invalid_argument(fmt::format("drawing: the colour is {:#x}; it goes up to 0xffffff", ink.colour));
  if (!(ink.opacity >= 0 && ink.opacity <= 1))
    throw std::invalid_argument(fmt::format("drawing: the opacity is {}; it goes from 0 to 1", ink.opacity));
  return ink.colour << 8U | static_cast<std::uint32_t>(std::lround(ink.opacity * 255));
}

std::uint32_t WidthOf(const Ink& ink)
{
  if (!(ink.width >= 0 && ink.width <= Drawing::kWidest))
    throw std::invalid_argument(
        fmt::format("drawing: the width is {}; it goes from 0 to {} pixels", ink.width, Drawing::kWidest));
  return static_cast<std::uint32_t>(std::lround(ink.width * 16));
}

// The numbers of a shape come in groups of `step`, at least `least` and at most `most` of them.
struct Counts
{
  std::uint32_t step, least, most;
};

constexpr std::uint32_t kAny = ~0U;

Counts CountsOf(Kind kind)
{
  switch (kind)
  {
    case Kind::kPoints:
      return {3, 3, kAny};
    case Kind::kSegments:
    case Kind::kArrows:
      return {6, 6, kAny};
    case Kind::kPolyline:
      return {3, 6, kAny};
    case Kind::kPolygon:
      return {3, 9, kAny};
    case Kind::kCircle:
    case Kind::kDisc:
      return {8, 8, 8};
    case Kind::kBox:
      return {10, 10, 10};
    case Kind::kCylinder:
      return {9, 9, 9};
    case Kind::kText:
      return {3, 3, 3};
  }
  return {1, 1, 0};
}

bool IsPlaced(Kind kind) { return kind >= Kind::kCircle && kind <= Kind::kCylinder; }

}  // namespace

void Drawing::Clear()
{
  shapes.clear();
  numbers.clear();
  texts.clear();
  frame_ = 0;
  is_full_ = false;
}

bool Drawing::Add(Kind kind, const Ink& ink, std::size_t count)
{
  DrawnShape shape{kind, frame_, ColourOf(ink), WidthOf(ink), static_cast<std::uint32_t>(count)};
  if (numbers.size() + count > kMostNumbers)
  {
    is_full_ = true;
    return false;
  }
  // Segments that look alike are one shape.
  const bool is_list = kind == Kind::kSegments || kind == Kind::kArrows || kind == Kind::kPoints;
  if (is_list && !shapes.empty())
  {
    DrawnShape& last = shapes.back();
    shape.count = last.count;
    if (shape == last)
    {
      last.count += static_cast<std::uint32_t>(count);
      return true;
    }
    shape.count = static_cast<std::uint32_t>(count);
  }
  if (shapes.size() >= kMostShapes)
  {
    is_full_ = true;
    return false;
  }
  shapes.push_back(shape);
  return true;
}

void Drawing::Put(const Vector3& place)
{
  for (const double value : place) numbers.push_back(static_cast<float>(value));
}

void Drawing::Put(const Pose& pose)
{
  Put(pose.position);
  const Quaternion& q = pose.orientation;
  for (const double value : {q.x(), q.y(), q.z(), q.w()}) numbers.push_back(static_cast<float>(value));
}

namespace
{

void RequirePlaces(std::span<const Vector3> places)
{
  for (const Vector3& place : places)
    for (const double value : place) RequireFinite(value, "a place");
}

void RequirePose(const Pose& pose)
{
  RequirePlaces({&pose.position, 1});
  if (!(std::abs(pose.orientation.norm() - 1) < 1e-3))
    throw std::invalid_argument("drawing: an orientation must be a unit quaternion");
}

}  // namespace

void Drawing::Points(std::span<const Vector3> places, const Ink& ink)
{
  RequirePlaces(places);
  if (places.empty() || !Add(Kind::kPoints, ink, 3 * places.size())) return;
  for (const Vector3& place : places) Put(place);
}

void Drawing::Segment(const Vector3& from, const Vector3& to, const Ink& ink)
{
  const Vector3 both[] = {from, to};
  RequirePlaces(both);
  if (!Add(Kind::kSegments, ink, 6)) return;
  Put(from);
  Put(to);
}

void Drawing::Arrow(const Vector3& from, const Vector3& to, const Ink& ink)
{
  const Vector3 both[] = {from, to};
  RequirePlaces(both);
  if (!Add(Kind::kArrows, ink, 6)) return;
  Put(from);
  Put(to);
}

void Drawing::Polyline(std::span<const Vector3> corners, const Ink& ink)
{
  RequirePlaces(corners);
  if (corners.size() < 2 || !Add(Kind::kPolyline, ink, 3 * corners.size())) return;
  for (const Vector3& corner : corners) Put(corner);
}

void Drawing::Polygon(std::span<const Vector3> corners, const Ink& ink)
{
  RequirePlaces(corners);
  if (corners.size() < 3)
    throw std::invalid_argument(fmt::format("drawing: a polygon has {} corners; it needs 3", corners.size()));
  if (!Add(Kind::kPolygon, ink, 3 * corners.size())) return;
  for (const Vector3& corner : corners) Put(corner);
}

void Drawing::Circle(const Pose& middle, double radius, const Ink& ink)
{
  RequirePose(middle);
  RequireSize(radius, "the radius of a circle");
  if (!Add(Kind::kCircle, ink, 8)) return;
  Put(middle);
  numbers.push_back(static_cast<float>(radius));
}

void Drawing::Disc(const Pose& middle, double radius, const Ink& ink)
{
  RequirePose(middle);
  RequireSize(radius, "the radius of a disc");
  if (!Add(Kind::kDisc, ink, 8)) return;
  Put(middle);
  numbers.push_back(static_cast<float>(radius));
}

void Drawing::Box(const Pose& middle, const Vector3& size, const Ink& ink)
{
  RequirePose(middle);
  for (const double value : size) RequireSize(value, "the size of a box");
  if (!Add(Kind::kBox, ink, 10)) return;
  Put(middle);
  Put(size);
}

void Drawing::Cylinder(const Pose& middle, double radius, double height, const Ink& ink)
{
  RequirePose(middle);
  RequireSize(radius, "the radius of a cylinder");
  RequireSize(height, "the height of a cylinder");
  if (!Add(Kind::kCylinder, ink, 9)) return;
  Put(middle);
  numbers.push_back(static_cast<float>(radius));
  numbers.push_back(static_cast<float>(height));
}

void Drawing::Text(const Vector3& place, std::string_view text, const Ink& ink)
{
  RequirePlaces({&place, 1});
  if (texts.size() >= kMostTexts)
  {
    is_full_ = true;
    return;
  }
  if (!Add(Kind::kText, ink, 3)) return;
  Put(place);
  std::size_t end = std::min(text.size(), kLongestText);
  // The cut must not be within a character of UTF-8.
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80) --end;
  texts.emplace_back(text.substr(0, end));
}

std::string Drawing::Mistake(std::size_t entities) const
{
  if (shapes.size() > kMostShapes) return fmt::format("{} shapes are more than {}", shapes.size(), kMostShapes);
  if (numbers.size() > kMostNumbers) return fmt::format("{} numbers are more than {}", numbers.size(), kMostNumbers);
  if (texts.size() > kMostTexts) return fmt::format("{} texts are more than {}", texts.size(), kMostTexts);
  std::size_t at = 0;
  std::size_t texts_used = 0;
  for (const DrawnShape& shape : shapes)
  {
    if (shape.kind < Kind::kPoints || shape.kind > Kind::kText)
      return fmt::format("there is no kind {}", static_cast<std::uint32_t>(shape.kind));
    if (shape.frame > entities)
      return fmt::format("there is no entity {} of {} to be in the frame of", shape.frame - 1, entities);
    if (shape.width_16 > static_cast<std::uint32_t>(kWidest * 16))
      return fmt::format("a width of {} sixteenths of a pixel is too large", shape.width_16);
    const auto [step, least, most] = CountsOf(shape.kind);
    if (shape.count % step != 0 || shape.count < least || shape.count > most)
      return fmt::format("a shape of kind {} has {} numbers", static_cast<std::uint32_t>(shape.kind), shape.count);
    if (shape.count > numbers.size() - at) return "there are fewer numbers than the shapes say";
    for (std::size_t k = at; k < at + shape.count; ++k)
      if (!(std::abs(numbers[k]) <= static_cast<float>(kFarthest) * 1.001F))
        return "a number is not finite, or too large";
    if (IsPlaced(shape.kind))
    {
      const float* q = &numbers[at + 3];
      const float square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
      if (!(std::abs(square - 1) < 0.01F)) return "an orientation is no unit quaternion";
      for (std::size_t k = at + 7; k < at + shape.count; ++k)
        if (numbers[k] < 0) return "a size is negative";
    }
    if (shape.kind == Kind::kText) ++texts_used;
    at += shape.count;
  }
  if (at != numbers.size()) return "there are more numbers than the shapes say";
  if (texts_used != texts.size()) return "there are not as many texts as the shapes say";
  for (const std::string& text : texts)
    if (text.size() > kLongestText) return "a text is too long";
  return {};
}

}  // namespace swarmanoid
