// Problem: find where two outlines of circles and convex polygons are near each other, and how that depends on their
// positions.
//
// Method: two parts are apart by the largest separation along the normals of their faces, and for a circle beyond the
// end of a face by its distance from the corner. Parts whose circles are not near are left out. All tests run on
// kDoubleLanes pairs at once; lanes with another case are masked.
//
// Invariant: the result of a lane does not depend on the others, so batches may be filled in any way.
#include "engine_worker/engines/kinematics2d/narrow_phase.h"

#include <algorithm>

#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr double kNone = 1e300;
constexpr unsigned kFirstOfEach = 0x1111;  // in a set of near parts: the first one of a with every one of b

}  // namespace

void PairBatch::Side::Spread(std::size_t count)
{
  for (std::size_t lane = count; lane < kDoubleLanes; ++lane) placed[lane] = placed[0];
  const auto of_all = [this](double Placed::*value)
  { return InLanes([&](std::size_t lane) { return placed[lane]->*value; }); };
  position = {of_all(&Placed::x), of_all(&Placed::y)};
  body = {of_all(&Placed::cos), of_all(&Placed::sin)};
  const Points turn{of_all(&Placed::turret_cos), of_all(&Placed::turret_sin)};
  turret = {body.cos * turn.x - body.sin * turn.y, body.sin * turn.x + body.cos * turn.y};
  const CollisionModel& model = Model();
  for (int k = 0; k < model.parts; ++k)
    centre[k] = (model.on_turret[k] ? turret : body).ToWorld(model.part_x[k], model.part_y[k]);
}

void PairBatch::Find(DoubleLanes margin, bool deepest_only)
{
  first_.Spread(count_);
  second_.Spread(count_);
  between_ = {first_.position.x - second_.position.x, first_.position.y - second_.position.y};
  margin_ = margin;
  deepest_only_ = deepest_only;
  deepest_ = Everywhere(-kNone);
  finds_ = 0;

  const CollisionModel& a = first_.Model();
  const CollisionModel& b = second_.Model();
  const unsigned circles_a = a.circles;
  const unsigned circles_b = b.circles;
  const unsigned all_circles_a = (1U << circles_a) - 1;
  const unsigned all_circles_b = kFirstOfEach & ((1U << (kParts * circles_b)) - 1);
  // The first circle of a model is its largest part: where two of them touch, little else counts.
  const bool round = circles_a > 0 && circles_b > 0;
  if (round) CircleWithCircle(0, 0);
  const unsigned near = NearParts();
  ForEachBit(near & all_circles_a * all_circles_b & ~1U,
             [&](unsigned bit) { CircleWithCircle(bit % kParts, bit / kParts); });
  for (unsigned q = circles_b; q < static_cast<unsigned>(b.parts); ++q)
    ForEachBit(near >> (kParts * q) & all_circles_a,
               [&](unsigned k) { CircleWithPolygon(first_, second_, k, q - circles_b, 1); });
  for (unsigned p = circles_a; p < static_cast<unsigned>(a.parts); ++p)
    ForEachBit(near >> p & all_circles_b,
               [&](unsigned bit) { CircleWithPolygon(second_, first_, bit / kParts, p - circles_a, -1); });
  for (unsigned p = circles_a; p < static_cast<unsigned>(a.parts); ++p)
    for (unsigned q = circles_b; q < static_cast<unsigned>(b.parts); ++q)
      if ((near >> (kParts * q + p) & 1) != 0) PolygonWithPolygon(p - circles_a, q - circles_b);

  kept_ = LongLanes{};
  for (int k = 0; k < finds_; ++k) kept_ |= (found_[k].depth >= -margin_) & (std::int64_t{1} << k);
}

// The parts that are near in any pair, polygons as the circles around them. Bit kParts * m + k: part k of the first
// body and part m of the second.
unsigned PairBatch::NearParts() const
{
  const CollisionModel& a = first_.Model();
  const CollisionModel& b = second_.Model();
  unsigned near = 0;
  for (int m = 0; m < b.parts; ++m)
  {
    const Points to{between_.x - second_.centre[m].x, between_.y - second_.centre[m].y};
    const DoubleLanes reach = b.part_radius[m] + margin_;
    for (int k = 0; k < a.parts; ++k)
    {
      const DoubleLanes dx = first_.centre[k].x + to.x;
      const DoubleLanes dy = first_.centre[k].y + to.y;
      const DoubleLanes limit = a.part_radius[k] + reach;
      near |= (LaneMask(dx * dx + dy * dy < limit * limit) != 0 ? 1U : 0U) << (static_cast<int>(kParts) * m + k);
    }
  }
  return near;
}

void PairBatch::Add(const Touches& touches)
{
  Touches& found = found_[finds_++];
  found = touches;
  found.depth = touches.depth > -margin_ ? touches.depth : Everywhere(-kNone);
  deepest_ = found.depth > deepest_ ? found.depth : deepest_;
  if (!deepest_only_) return;
  const DoubleLanes apart = kTouchesApart - deepest_;
  margin_ = apart < margin_ ? apart : margin_;
}

void PairBatch::CircleWithCircle(std::size_t k, std::size_t m)
{
  const DoubleLanes x = first_.centre[k].x - second_.centre[m].x;
  const DoubleLanes y = first_.centre[k].y - second_.centre[m].y;
  const DoubleLanes dx = between_.x + x;
  const DoubleLanes dy = between_.y + y;
  const double reach = first_.Model().part_radius[k] + second_.Model().part_radius[m];
  Add({x, y, Everywhere(reach), reach - SquareRoot(dx * dx + dy * dy), LongLanes{}, static_cast<std::uint8_t>(k),
       static_cast<std::uint8_t>(m)});
}

// `sign` is 1 if the circles belong to the first body of the pair, else -1.
void PairBatch::CircleWithPolygon(const Side& circles, const Side& polygons, std::size_t k, std::size_t p, double sign)
{
  const Polygon& polygon = polygons.Model().polygons[p];
  const Axes& axes = polygons.AxesOf(polygon);
  const double radius = circles.Model().part_radius[k];
  const Points& offset = circles.centre[k];
  const Points q = axes.ToLocal({sign * between_.x + offset.x, sign * between_.y + offset.y});
  DoubleLanes separations[Polygon::kMaximumVertices];
  DoubleLanes separation = Everywhere(-kNone);
  for (int n = 0; n < polygon.count; ++n)
  {
    separations[n] = polygon.nx[n] * q.x + polygon.ny[n] * q.y - polygon.offset[n];
    separation = separations[n] > separation ? separations[n] : separation;
  }
  if (LaneMask(separation <= radius + margin_) == 0) return;

  // The first face from which the circle is separated most: its ends, and its normal and offset.
  Points begin{}, end{}, normal{};
  DoubleLanes face_offset{};
  for (int n = polygon.count - 1, next = 0; n >= 0; next = n--)
  {
    const LongLanes best = separations[n] == separation;
    const auto set = [&](DoubleLanes& v, double value) { v = best ? Everywhere(value) : v; };
    set(begin.x, polygon.x[n]);
    set(begin.y, polygon.y[n]);
    set(end.x, polygon.x[next]);
    set(end.y, polygon.y[next]);
    set(normal.x, polygon.nx[n]);
    set(normal.y, polygon.ny[n]);
    set(face_offset, polygon.offset[n]);
  }
  const Points n = axes.ToWorld(normal);
  const DoubleLanes face_reach = radius + face_offset - (n.x * offset.x + n.y * offset.y);

  // Outside and beyond an end of that face: the corner counts, as a circle of radius 0.
  const Points edge{end.x - begin.x, end.y - begin.y};
  const DoubleLanes along = (q.x - begin.x) * edge.x + (q.y - begin.y) * edge.y;
  const LongLanes before = along < 0.0;
  const LongLanes beyond = (separation > 0.0) & (before | (along > edge.x * edge.x + edge.y * edge.y));
  const Points corner = axes.ToWorld(Points{before ? begin.x : end.x, before ? begin.y : end.y});
  const DoubleLanes x = sign * (beyond ? offset.x - corner.x : n.x);
  const DoubleLanes y = sign * (beyond ? offset.y - corner.y : n.y);
  const DoubleLanes reach = beyond ? Everywhere(radius) : face_reach;
  const DoubleLanes face_length = between_.x * x + between_.y * y;
  const DoubleLanes dx = between_.x + x;
  const DoubleLanes dy = between_.y + y;
  const auto circle = static_cast<std::uint8_t>(k);
  const auto other = static_cast<std::uint8_t>(static_cast<std::size_t>(polygons.Model().circles) + p);
  Add({x, y, reach, reach - (beyond ? SquareRoot(dx * dx + dy * dy) : face_length), ~beyond, sign > 0 ? circle : other,
       sign > 0 ? other : circle});
}

// `between` is the vector from the body of `faces` to that of `other`.
PairBatch::Faces PairBatch::SeparationAlong(const Polygon& faces, const Polygon& other, const Axes& faces_axes,
                                            const Axes& other_axes, Points between)
{
  // The vertices of `other` relative to the body of `faces`.
  Points vertices[Polygon::kMaximumVertices];
  for (int k = 0; k < other.count; ++k)
  {
    const Points p = other_axes.ToWorld(other.x[k], other.y[k]);
    vertices[k] = faces_axes.ToLocal({p.x + between.x, p.y + between.y});
  }
  Faces best{Everywhere(-kNone), {}};
  for (int k = 0; k < faces.count; ++k)
  {
    DoubleLanes nearest = Everywhere(kNone);
    for (int m = 0; m < other.count; ++m)
    {
      const DoubleLanes distance = faces.nx[k] * vertices[m].x + faces.ny[k] * vertices[m].y;
      nearest = distance < nearest ? distance : nearest;
    }
    nearest -= faces.offset[k];
    const LongLanes better = nearest > best.separation;
    best.separation = better ? nearest : best.separation;
    best.normal.x = better ? Everywhere(faces.nx[k]) : best.normal.x;
    best.normal.y = better ? Everywhere(faces.ny[k]) : best.normal.y;
  }
  return best;
}

void PairBatch::PolygonWithPolygon(std::size_t p, std::size_t q)
{
  const Polygon& a = first_.Model().polygons[p];
  const Polygon& b = second_.Model().polygons[q];
  const Axes& axes_a = first_.AxesOf(a);
  const Axes& axes_b = second_.AxesOf(b);
  const Faces along_b = SeparationAlong(b, a, axes_b, axes_a, between_);
  if (LaneMask(along_b.separation <= margin_) == 0) return;
  const Faces along_a = SeparationAlong(a, b, axes_a, axes_b, {-between_.x, -between_.y});
  const LongLanes from_b = along_b.separation >= along_a.separation;
  const Points n_b = axes_b.ToWorld(along_b.normal);
  const Points n_a = axes_a.ToWorld({-along_a.normal.x, -along_a.normal.y});
  const Points n{from_b ? n_b.x : n_a.x, from_b ? n_b.y : n_a.y};
  // The reach is chosen so that the depth is -separation at this position.
  const DoubleLanes separation = from_b ? along_b.separation : along_a.separation;
  const DoubleLanes reach = n.x * between_.x + n.y * between_.y - separation;
  const DoubleLanes depth = reach - (between_.x * n.x + between_.y * n.y);
  const auto part = [](const Side& side, std::size_t polygon)
  { return static_cast<std::uint8_t>(static_cast<std::size_t>(side.Model().circles) + polygon); };
  Add({n.x, n.y, reach, depth, ~LongLanes{}, part(first_, p), part(second_, q)});
}

Vector2 PartingDirection(const Placed& a, const Placed& b)
{
  std::array<double, kDoubleLanes> everywhere;
  everywhere.fill(kNone);
  PairBatch batch;
  batch.Add(a, b);
  batch.FindAllTouches(everywhere);
  Vector2 direction = Vector2::UnitX();
  batch.ForEachTouch(
      [&](std::size_t, const Touch& touch)
      {
        if (touch.first_part != 0 || touch.second_part != 0) return;
        const Vector2 way = touch.face ? Vector2(touch.x, touch.y) : Vector2(a.x - b.x + touch.x, a.y - b.y + touch.y);
        const double length = std::sqrt(way.squaredNorm());
        if (length > 0) direction = way / length;
      });
  return direction;
}

double Overlap(const Placed& a, const Placed& b)
{
  PairBatch batch;
  batch.Add(a, b);
  batch.FindTouches(0);
  return std::max(0.0, batch.Deepest(0));
}

}  // namespace swarmanoid::kinematics2d
