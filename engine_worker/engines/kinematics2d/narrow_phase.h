// Exact contacts between collision models at given poses, for a few pairs side by side: one in each lane of a vector.
// A batch is used by one thread.
#pragma once

#include <array>
#include <cmath>

#include "common/math/lanes.h"
#include "engine_worker/engines/kinematics2d/collision_model.h"

namespace swarmanoid::kinematics2d
{

// A model put somewhere: position, heading and turret as cosine and sine.
struct alignas(64) Placed
{
  double x = 0, y = 0;
  double cos = 1, sin = 0;
  double turret_cos = 1, turret_sin = 0;
  const CollisionModel* model = nullptr;
};

// Where two outlines are near. As long as neither turns, their depth at other positions a, b of the two bodies is
//   point: reach - |(a - b) + (x, y)|, pushing apart along that difference;
//   face:  reach - (a - b) . (x, y),   pushing apart along the unit vector (x, y).
struct Touch
{
  double x, y;
  double reach;
  bool face;
  std::uint8_t first_part, second_part;  // numbers of the models' parts
  double depth;                          // where it was found
};

// All pairs of a batch are of the same two models.
class PairBatch
{
public:
  std::size_t Count() const { return count_; }
  bool IsFull() const { return count_ == kDoubleLanes; }
  bool Takes(const Placed& a, const Placed& b) const
  {
    return count_ == 0 || (a.model == first_.placed[0]->model && b.model == second_.placed[0]->model);
  }
  // The two must stay where they are until the batch is cleared.
  void Add(const Placed& a, const Placed& b)
  {
    first_.placed[count_] = &a;
    second_.placed[count_] = &b;
    ++count_;
  }
  void Clear() { count_ = 0; }
  const Placed& First(std::size_t lane) const { return *first_.placed[lane]; }
  const Placed& Second(std::size_t lane) const { return *second_.placed[lane]; }

  // Finds, for every pair, all places where the outlines overlap or are less than `margin` (m) apart. Places that are
  // kTouchesApart less deep than the deepest one of their pair are left out.
  void FindTouches(double margin) { Find(Everywhere(margin), true); }
  // Works as FindTouches, with a margin for each pair, and leaves nothing out.
  void FindAllTouches(const std::array<double, kDoubleLanes>& margins)
  {
    Find(InLanes([&](std::size_t lane) { return margins[lane < count_ ? lane : 0]; }), false);
  }
  // Returns, after FindTouches, the depth (m) of the deepest touch of a pair. It is far below 0 if the pair has none.
  double Deepest(std::size_t lane) const { return deepest_[lane]; }
  // Calls act(lane, touch), after FindTouches, with the touches of each pair, one pair after the other.
  template <class Act>
  void ForEachTouch(const Act& act) const
  {
    std::uint64_t left = 0;
    for (std::size_t lane = 0; lane < count_; ++lane)
      left |= static_cast<std::uint64_t>(kept_[lane]) << (lane * kParts * kParts);
    for (; left != 0; left &= left - 1)
    {
      const auto bit = static_cast<unsigned>(__builtin_ctzll(left));
      const unsigned lane = bit / (kParts * kParts);
      const Touches& touches = found_[bit % (kParts * kParts)];
      act(lane, Touch{touches.x[lane], touches.y[lane], touches.reach[lane], touches.face[lane] != 0,
                      touches.first_part, touches.second_part, touches.depth[lane]});
    }
  }

private:
  static constexpr unsigned kParts = CollisionModel::kMaximumParts;
  static_assert(kDoubleLanes * kParts * kParts <= 64);

  struct Points
  {
    DoubleLanes x, y;
  };
  struct Axes
  {
    DoubleLanes cos, sin;

    Points ToWorld(Points p) const { return {cos * p.x - sin * p.y, sin * p.x + cos * p.y}; }
    Points ToWorld(double x, double y) const { return {cos * x - sin * y, sin * x + cos * y}; }
    Points ToLocal(Points p) const { return {cos * p.x + sin * p.y, cos * p.y - sin * p.x}; }
  };
  // One body of each pair.
  struct Side
  {
    std::array<const Placed*, kDoubleLanes> placed;
    Points position;
    Axes body, turret;
    Points centre[kParts];  // of the parts, relative to the body, along the axes of the world

    const CollisionModel& Model() const { return *placed[0]->model; }
    const Axes& AxesOf(const Polygon& polygon) const { return polygon.on_turret ? turret : body; }
    void Spread(std::size_t count);
  };
  // The faces of a polygon from which something is separated most.
  struct Faces
  {
    DoubleLanes separation;
    Points normal;
  };
  struct Touches
  {
    DoubleLanes x, y, reach, depth;
    LongLanes face;
    std::uint8_t first_part, second_part;
  };

  void Find(DoubleLanes margin, bool deepest_only);
  unsigned NearParts() const;
  void CircleWithCircle(std::size_t k, std::size_t m);
  void CircleWithPolygon(const Side& circles, const Side& polygons, std::size_t k, std::size_t p, double sign);
  void PolygonWithPolygon(std::size_t p, std::size_t q);
  static Faces SeparationAlong(const Polygon& faces, const Polygon& other, const Axes& faces_axes,
                               const Axes& other_axes, Points between);
  // Adds the touches that are not too shallow. Parts are numbered from the circles on.
  void Add(const Touches& touches);

  std::size_t count_ = 0;
  Side first_, second_;
  Points between_;      // from the second body to the first
  DoubleLanes margin_;  // touches less deep than -margin are of no interest
  DoubleLanes deepest_;
  Touches found_[kParts * kParts];
  int finds_ = 0;
  bool deepest_only_ = true;
  LongLanes kept_;  // of each lane: the finds that count, one bit each
};

// Returns the deepest overlap in metres, or 0 if the bodies do not overlap.
double Overlap(const Placed& a, const Placed& b);
// Returns the direction in which two near bodies are parted as wholes: the unit vector from the second to the first one
// along which their first parts are nearest to each other.
Vector2 PartingDirection(const Placed& a, const Placed& b);

}  // namespace swarmanoid::kinematics2d
