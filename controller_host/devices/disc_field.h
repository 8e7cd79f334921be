// Upright cylinders around an eye, held by direction, so that each line of sight is tested against the few that may
// hide its end, several at a time. Used by SightLines. Steady running allocates nothing.
//
// They are split into the four quadrants around the eye and, where these hold many, into eight sectors of each; one
// that touches several stands in all of them. Cells are tested to one depth, only the fullest
// further, whatever hides a point: branches that depend on it would be guessed wrong half of the time and cost more
// than the tests.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "controller_host/devices/neighbour_grid.h"

namespace swarmanoid
{

// Points to look at: offsets from the eye in m. Room for kLanes more behind `count`.
struct SightPoints
{
  std::size_t count = 0;
  std::vector<float> x, y, z;
  std::vector<std::int32_t> owner;  // the entity that a point is part of: it does not hide its own points

  // Room for so many, and the kLanes.
  void Reserve(std::size_t points);
};

class DiscField
{
public:
  // Takes the cylinders around an eye at height `eye` (m, in the space) that reach into the heights from `lowest` to
  // `highest`, which hold 0, relative to the eye.
  void Sort(const NearBodies& discs, float eye, float lowest, float highest);
  // Sets seen[i] to 0 or 1 for each point; their heights are within those given to Sort.
  void Look(const SightPoints& points, char* seen) const;

private:
  static constexpr std::size_t kQuadrants = 4;
  static constexpr std::size_t kSectors = 8;  // of a quadrant

  // How the cylinders' heights go with those of the points.
  enum class Heights
  {
    kSpanning,  // all are as high and as low as every line
    kEqual,
    kMixed
  };

  // Cells of equal size, each a list of cylinders relative to the eye.
  struct Cells
  {
    std::size_t stride = 0;
    std::array<std::size_t, kQuadrants * kSectors> filled{};
    std::vector<float> x, y, radius, low, high;  // radius: its square in the cells that are tested
    std::vector<std::int32_t> entity;

    void Reserve(std::size_t cells, std::size_t places);
  };

  void Classify(const NearBodies& discs, float eye, float lowest, float highest);
  void SortByQuadrants(const NearBodies& discs, float eye, float lowest, float highest);
  void SplitQuadrant(std::size_t quadrant);
  void Close(std::size_t cells);
  template <bool kMixedHeights>
  void LookEach(const SightPoints& points, char* seen) const;

  Heights heights_ = Heights::kSpanning;
  float low_ = 0, high_ = 0;  // kEqual: of all, from the eye
  bool all_count_ = true;     // none of them is too low or too high to hide anything
  bool is_split_ = false;
  std::array<std::size_t, kQuadrants * kSectors> depth_{};  // places of each cell to test
  Cells quadrants_, cells_;
};

}  // namespace swarmanoid
