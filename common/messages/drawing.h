// Drawing: what experiment functions draw into the pictures of a tick: lines, areas, bodies and texts in the space, or
// in the frame of an entity, with which they move. It is shown and is no part of the state: no hash, checkpoint or
// journal has it. Made by experiment functions, carried to visualisers by the state and by views.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/math/pose.h"
#include "idl/drawing_lists.h"

namespace swarmanoid
{

// How a shape looks.
struct Ink
{
  std::uint32_t colour = 0xff0000;  // 0xRRGGBB
  double opacity = 1;               // 0 to 1
  double width = 1;                 // pixels: of lines, and the diameter of points
};

class Drawing : public DrawingLists
{
public:
  // The limits of a tick. More shapes are left out, and IsFull returns true.
  static constexpr std::size_t kMostShapes = 20'000;
  static constexpr std::size_t kMostNumbers = 300'000;  // a segment has six
  static constexpr std::size_t kMostTexts = 5'000;
  static constexpr std::size_t kLongestText = 256;  // bytes; longer ones are cut
  static constexpr double kWidest = 4095;           // pixels

  // ---- The functions for drawing. Lengths are in metres. They throw std::invalid_argument for numbers that are not
  // finite, sizes below 0, opacities and widths out of range, and polygons of fewer than three corners.

  // InFrameOf puts the following shapes into the frame of that entity (its index), so that they move with it. InSpace
  // puts them into the space, which is the default.
  void InFrameOf(std::uint32_t entity) { frame_ = entity + 1; }
  void InSpace() { frame_ = 0; }

  void Points(std::span<const Vector3> places, const Ink& ink = {0xff0000, 1, 5});
  void Point(const Vector3& place, const Ink& ink = {0xff0000, 1, 5}) { Points({&place, 1}, ink); }
  void Segment(const Vector3& from, const Vector3& to, const Ink& ink = {});
  void Polyline(std::span<const Vector3> corners, const Ink& ink = {});
  void Arrow(const Vector3& from, const Vector3& to, const Ink& ink = {});
  // Filled, flat and convex.
  void Polygon(std::span<const Vector3> corners, const Ink& ink = {});
  // About the z axis of its pose: a line; Disc is filled.
  void Circle(const Pose& middle, double radius, const Ink& ink = {});
  void Disc(const Pose& middle, double radius, const Ink& ink = {});
  void Box(const Pose& middle, const Vector3& size, const Ink& ink = {});
  void Cylinder(const Pose& middle, double radius, double height, const Ink& ink = {});
  // Always upright in the picture, its left end at the place.
  void Text(const Vector3& place, std::string_view text, const Ink& ink = {0x000000});

  void Clear();
  bool IsEmpty() const { return shapes.empty(); }
  // Something was left out.
  bool IsFull() const { return is_full_; }

  // Returns the mistake of a drawing from another process, for a space of `entities` entities, or an empty text. Texts
  // are checked by the renderer that reads them.
  std::string Mistake(std::size_t entities) const;

  bool operator==(const Drawing& other) const
  {
    return shapes == other.shapes && numbers == other.numbers && texts == other.texts;
  }

private:
  // Whether there is room, and then the shape; its numbers follow.
  bool Add(DrawnShape::Kind kind, const Ink& ink, std::size_t count);
  void Put(const Vector3& place);
  void Put(const Pose& pose);

  std::uint32_t frame_ = 0;
  bool is_full_ = false;
};

}  // namespace swarmanoid
