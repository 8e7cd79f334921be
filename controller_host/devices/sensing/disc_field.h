// DiscField: upright cylinders around an eye, and the lines of sight that they hide, several at a time. Used by
// SightLines. In steady running it allocates nothing.
//
// Direction and distance in bytes select the pairs of a line and a cylinder that may meet; these get an exact test. In
// a crowd that looks at itself, cylinders and lines that the nearest cylinders surely hide are dropped first.
//
// Many cylinders of different heights, or with other points, are stored by direction: in the four quadrants around the
// eye and eight sectors of each. A cylinder that touches several sectors is in all of them. Cells are tested to one
// depth, and only the fullest one further, even if a point is already hidden. A branch on the result would be
// mispredicted half of the time and cost more than the tests.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "controller_host/devices/sensing/disc_cover.h"

namespace swarmanoid
{

// Points to look at, wherever they are stored: offsets from the eye in m. kLanes more can be read behind `count`.
struct PointView
{
  std::size_t count = 0;
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const std::int32_t* owner = nullptr;  // the entity that a point is part of: it does not hide its own points
};

// Memory for such points.
struct SightPoints
{
  std::size_t count = 0;
  std::vector<float> x, y, z;
  std::vector<std::int32_t> owner;

  // Makes the arrays long enough for `points` and kLanes more.
  void Reserve(std::size_t points);
  operator PointView() const { return {count, x.data(), y.data(), z.data(), owner.data()}; }
};

// The set of visible points.
class SeenPoints
{
public:
  void Resize(std::size_t points) { groups_.resize((points + kLanes - 1) / kLanes); }
  bool operator[](std::size_t point) const { return (groups_[point / kLanes] >> point % kLanes & 1U) != 0; }
  // Returns a bit for each of the kLanes points from `first` on, a multiple of kLanes. Bits behind the last point are
  // 0.
  unsigned Group(std::size_t first) const { return groups_[first / kLanes]; }
  void SetGroup(std::size_t first, unsigned seen) { groups_[first / kLanes] = static_cast<std::uint8_t>(seen); }
  void HideAll() { std::fill(groups_.begin(), groups_.end(), std::uint8_t{0}); }
  void Show(std::size_t point)
  {
    groups_[point / kLanes] = static_cast<std::uint8_t>(Group(point) | 1U << point % kLanes);
  }
  void Hide(std::size_t point)
  {
    groups_[point / kLanes] = static_cast<std::uint8_t>(Group(point) & ~(1U << point % kLanes));
  }

private:
  std::vector<std::uint8_t> groups_;
};

class DiscField
{
public:
  // Takes the cylinders around an eye at height `eye` (m, in the space) that reach into the heights from `lowest` to
  // `highest`. These are relative to the eye and include 0. The cylinders must stay until the last Look. `reach` (m) is
  // the usual distance of points. `at_themselves` means that the points are the cylinders' origins, in their order,
  // moved by one height.
  void Sort(const NearBodies& discs, float eye, float lowest, float highest, float reach, bool at_themselves);
  // Finds the points that no cylinder hides. The heights of the points must be within those given to Sort.
  void Look(const PointView& points, SeenPoints& seen);

private:
  static constexpr std::size_t kQuadrants = 4;
  static constexpr std::size_t kSectors = 8;  // of a quadrant
  static constexpr std::size_t kHandful = 8;  // up to this all are tested for every line
  static constexpr std::size_t kFew = 56;     // more than this are thinned out or split into sectors
  static constexpr std::size_t kBlock = 64;   // cylinders whose pairs are tested at once

  // The relation of the cylinders' heights to those of the points.
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
  // Lines from the eye to kLanes points.
  struct Lines
  {
    FloatLanes x, y;  // directions along the floor, of length 1
    FloatLanes length;
    FloatLanes from, to;     // the parts of the way, 0..1, at the heights of the cylinders
    FloatLanes inverse;      // of the height of the point: kMixed
    FloatLanes first, last;  // from and to in m
  };

  // Lines to kByteLanes points, and the pairs of them and cylinders that may meet.
  struct Chunk
  {
    std::array<float, kByteLanes> x, y, first, last, slope, length;
    std::array<std::uint8_t, kByteLanes> turn, distance;
    // The lines that may meet one of two cylinders, kByteLanes bits for each, and the number of the first cylinder.
    std::array<std::uint64_t, kBlock / 2> meeting;
    std::array<std::uint32_t, kBlock / 2> disc;
    std::array<std::int32_t, kBlock * kByteLanes + kLanes> pairs;  // number of the cylinder, then of the line
    std::size_t count;
    IntLanes hidden;  // a bit for each line
  };
  // The owner of each point.
  enum class Owners
  {
    kSamePlaces,  // the cylinder at the same place
    kPlaces,      // the place of a cylinder
    kEntities
  };

  // Cylinders that may hide points: their direction bytes, and their places if these are not 0, 1 …
  struct Candidates
  {
    std::size_t count;
    const std::int32_t* meets;
    const std::int32_t* place;
  };
  // The points and cylinders that the cover does not hide, in half of the directions. The owner of each point is its
  // place among all points.
  struct Half
  {
    SightPoints left;
    std::size_t count = 0;  // of cylinders
    std::vector<std::int32_t> place, meets;

    void Reserve(std::size_t places);
  };

  void Classify(const NearBodies& discs, float eye, float lowest, float highest);
  void Measure(float eye, float lowest, float highest);
  void SortByQuadrants(const NearBodies& discs, float eye, float lowest, float highest);
  void SplitQuadrant(std::size_t quadrant);
  void Close();
  Lines LinesTo(const PointView& points, std::size_t group) const;
  void LookByBytes(const PointView& points, SeenPoints& seen);
  void ThinOut(const PointView& points);
  // Calls found(first, seen) with a bit for each of kByteLanes points.
  template <bool kMixedHeights, Owners kOwners, class Found>
  void LookThrough(const PointView& points, const Candidates& discs, Found&& found);
  template <bool kMixedHeights, Owners kOwners>
  void TestPairs(const std::int32_t* owners, const std::int32_t* places);
  template <bool kMixedHeights>
  void LookAtHandful(const PointView& points, SeenPoints& seen) const;
  template <bool kMixedHeights>
  void LookAtMany(const PointView& points, SeenPoints& seen) const;

  Heights heights_ = Heights::kSpanning;
  float low_ = 0, high_ = 0;  // kEqual: of all, from the eye
  bool all_count_ = true;     // none of them is too low or too high to hide anything

  // The cylinders in the form of direction bytes.
  const NearBodies* discs_ = nullptr;
  bool by_bytes_ = false;
  bool are_handful_ = false;
  bool at_themselves_ = false;
  bool is_crowd_ = false;
  float steps_per_m_ = 0;
  DirectionBytes bytes_;
  std::vector<float> square_, disc_low_, disc_high_;
  std::size_t equal_count_ = 0;  // so many squares are equal
  Chunk chunk_;
  DiscCover cover_;
  std::array<Half, 2> halves_;

  // The arrays for many cylinders.
  std::array<std::size_t, kQuadrants * kSectors> depth_{};  // places of each cell to test
  Cells quadrants_, cells_;
};

}  // namespace swarmanoid
