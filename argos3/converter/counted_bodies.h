// Boxes and cylinders that Init of loop functions makes and the experiment file does not declare. Our space has all
// entities from the start, so a rehearsal of Init counts them and their sizes. The converted file keeps as many ready.
// The plug-in (argos3_loop_functions) writes the file, and the launcher reads it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "common/math/pose.h"

namespace swarmanoid::argos3
{

// The name of the file in the folder of the run.
inline constexpr const char* kMadeBodiesFile = "made_bodies.txt";

// Our kind for a box with LEDs, or one that loop functions make (argos3/kinds/argos3_box.cpp).
inline constexpr const char* kLitBox = "argos3_box";
// Reserves of bodies have ids with this prefix. Static bodies among them get this mass.
inline constexpr const char* kMadeBody = "made_body_";
inline constexpr double kUnmovableKg = 10'000;
// The largest mass here; no robot can move such a body.
inline constexpr double kHeaviestKg = 1e9;

struct BodyShape
{
  std::string tag;  // our tag
  bool movable = false;
  double mass_kg = 1;  // at most kHeaviestKg
  Vector3 size;        // m; for cylinders: radius, radius, height

  friend bool operator<(const BodyShape& a, const BodyShape& b)
  {
    const auto all = [](const BodyShape& s)
    { return std::tuple(std::string_view(s.tag), s.movable, s.mass_kg, s.size.x(), s.size.y(), s.size.z()); };
    return all(a) < all(b);
  }
};
// The number of bodies of each shape.
using MadeBodies = std::map<BodyShape, int>;

void WriteMadeBodies(const MadeBodies& bodies, const std::string& folder);
// Returns an empty map if there is no file. Then Init has failed, and the run reports why.
MadeBodies ReadMadeBodies(const std::string& folder);

}  // namespace swarmanoid::argos3
