// The volumes of engines: parts of the space. An entity that leaves the volume of its engine is handed over to another
// engine that lists it. The experiment holds the volumes and, for each such entity, the engines that can move it. All
// functions are pure.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

struct Experiment;

// A part of the space: polygons in x and y, between two heights. A point within an odd number of the polygons is in the
// volume, so a polygon within another one is a hole. Without polygons the volume has all x and y.
struct EngineVolume
{
  static constexpr std::size_t kMostCorners = 10'000;

  std::vector<std::vector<Vector2>> outlines{};
  double low = -std::numeric_limits<double>::infinity();  // m, the lowest height in the volume
  double high = std::numeric_limits<double>::infinity();  // m, not in the volume
  std::string text{};                                     // of the outlines, as in the file

  bool IsWhole() const { return outlines.empty() && low == -high && std::isinf(high); }
  // Returns whether the volume has a point. Of two volumes with a common edge or height, exactly one has its points.
  bool Holds(const Vector3& point) const;
  // Returns "within 0, 0, 4, 4 from 0 to 1 m high", for messages.
  std::string Text() const;

  // Reads the outlines: x, y of the corners of each, separated by commas or blanks, and a semicolon between outlines.
  // Two corners are opposite corners of a rectangle. Returns the mistake, empty for none.
  std::string ReadOutlines(std::string_view from);
};

// The movable entities of engines with volumes, and the engines that can move each: they list the entity and serve its
// devices. Most entities share few different sets of engines.
struct EngineChoices
{
  std::vector<std::uint32_t> entities;           // ascending
  std::vector<std::uint32_t> set_of;             // of each of them, its number in `sets`
  std::vector<std::vector<std::uint32_t>> sets;  // engines, ascending

  static constexpr std::uint32_t kNoEngine = ~0U;

  // Returns the place of an entity in `entities`, or entities.size() if it never changes its engine.
  std::size_t PlaceOf(std::uint32_t entity) const;
  // Returns the engines of an entity, ascending; none if it never changes its engine.
  std::span<const std::uint32_t> Of(std::uint32_t entity) const;
};

// Finds the choices after entities, controllers and lists of engines are read. There are none without volumes.
EngineChoices FindEngineChoices(const Experiment& experiment);

// Returns the first of the engines whose volume has the point, kNoEngine for none.
std::uint32_t EngineAt(const Experiment& experiment, std::span<const std::uint32_t> engines, const Vector3& point);

// Returns "'ground' everywhere, 'patch' within 0, 0, 4, 4".
std::string VolumesText(const Experiment& experiment, std::span<const std::uint32_t> engines);

// Returns for each entity the engine that moves it at the start, and -1 for those that no engine moves: the first one
// that lists it, and whose volume has its position.
std::vector<int> StartEngines(const Experiment& experiment);

}  // namespace swarmanoid
