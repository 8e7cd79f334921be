// Boxes and cylinders that the Init of loop functions makes and the experiment file does not declare. Our space has all
// entities from the start on, so a rehearsal of Init tells how many there will be and how large, and the converted file
// keeps as many ready. Written by the plug-in (argos3_loop_functions), read by the launcher.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "common/math/pose.h"

namespace swarmanoid::argos3
{

// In the folder of the run.
inline constexpr const char* kMadeBodiesFile = "made_bodies.txt";

// Ours for a box with LEDs, or that loop functions make (argos3/kinds/box.cpp).
inline constexpr const char* kLitBox = "argos3_box";
// Reserves of bodies have ids that begin so, and of these the ones that do not move there this mass.
inline constexpr const char* kMadeBody = "made_body_";
inline constexpr double kUnmovableKg = 10'000;
// We have no heavier bodies; nothing moves these either.
inline constexpr double kHeaviestKg = 1e9;

struct BodyShape
{
  std::string tag;  // ours
  bool movable = false;
  double mass_kg = 1;  // at most kHeaviestKg
  Vector3 size;        // m; of cylinders radius, radius, height

  friend bool operator<(const BodyShape& a, const BodyShape& b)
  {
    const auto all = [](const BodyShape& s)
    { return std::tuple(std::string_view(s.tag), s.movable, s.mass_kg, s.size.x(), s.size.y(), s.size.z()); };
    return all(a) < all(b);
  }
};
// How many of each shape.
using MadeBodies = std::map<BodyShape, int>;

void WriteMadeBodies(const MadeBodies& bodies, const std::string& folder);
// None if there is no file: Init failed, and says why when it is run.
MadeBodies ReadMadeBodies(const std::string& folder);

}  // namespace swarmanoid::argos3
