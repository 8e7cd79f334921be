// Problem: most robots on wheels touch only level ground, and the solver spends most of its time on them.
//
// Method: at the start of a tick, separation_test.h finds the bodies that can meet no other body before the tick ends.
// The closed form of their drive (differential_drive.h) moves them. A body that may meet others is compared with these
// in each step, and becomes solved when a gap gets small.
//
// Invariants: the set follows from the bodies at the start of the tick alone. If a solved body goes farther than the
// search allowed for, the search is repeated; then a body never ceases to be near others, so that no bit of its motion
// depends on a search that bodies elsewhere made necessary.
#include "engine_worker/engines/dynamics3d/contact_free_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/space/space.h"
#include "engine_worker/engines/dynamics3d/contact_constants.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// Robots closer than this (m) at the end of a step are solved. The lean of a robot moves its outline by less.
constexpr double kTouch = 3e-3;
// Bodies may be pushed, or speed up, by so much more (m) than they move by themselves.
constexpr double kPushed = 0.02;
// If a body is faster than this (m/s), all bodies are solved: the cells that it may reach would hold too many.
constexpr double kFastest = 2;
constexpr double kArms = 0.2;     // m, by which robots without wheels may grow
constexpr double kFarAway = 1e4;  // m

bool IsOpposedTo(const dReal* normal) { return normal[2] < -0.999; }

// All of the plane behind a wall that has no end.
StaticOutline BehindWall(const dReal* plane)
{
  const Vector2 normal(plane[0], plane[1]);
  const Vector2 along(-normal.y(), normal.x());
  const Vector2 middle = plane[3] * normal;
  return {.corners = {middle - kFarAway * along, middle + kFarAway * along,
                      middle + kFarAway * along - kFarAway * normal, middle - kFarAway * along - kFarAway * normal}};
}

StaticOutline OutlineOf(dGeomID geom, const std::array<double, 6>& box)
{
  const dReal* position = dGeomGetPosition(geom);
  const dReal* rotation = dGeomGetRotation(geom);
  const bool is_upright = std::abs(rotation[10]) > 1 - 1e-12;
  const int kind = dGeomGetClass(geom);
  if (is_upright && kind == dCylinderClass)
  {
    dReal radius = 0, length = 0;
    dGeomCylinderGetParams(geom, &radius, &length);
    return {{{position[0], position[1]}}, radius};
  }
  Vector2 middle((box[0] + box[1]) / 2, (box[2] + box[3]) / 2);
  Vector2 x((box[1] - box[0]) / 2, 0);
  Vector2 y(0, (box[3] - box[2]) / 2);
  if (is_upright && kind == dBoxClass)
  {
    dVector3 sides;
    dGeomBoxGetLengths(geom, sides);
    middle = {position[0], position[1]};
    x = Vector2(rotation[0], rotation[4]) * sides[0] / 2;
    y = Vector2(-rotation[4], rotation[0]) * sides[1] / 2;
  }
  return {.corners = {middle - x - y, middle + x - y, middle + x + y, middle - x + y}};
}

double FarthestCorner(const std::array<double, 6>& box, double x, double y)
{
  const double across = std::max(std::abs(box[0] - x), std::abs(box[1] - x));
  const double along = std::max(std::abs(box[2] - y), std::abs(box[3] - y));
  return std::sqrt(across * across + along * along);
}

double DistanceTo(const std::array<double, 6>& box, const Vector2& point)
{
  const double x = std::max({box[0] - point.x(), point.x() - box[1], 0.0});
  const double y = std::max({box[2] - point.y(), point.y() - box[3], 0.0});
  return std::sqrt(x * x + y * y);
}

double SpeedInPlane(dBodyID body)
{
  const dReal* velocity = dBodyGetLinearVel(body);
  return std::sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1]);
}
double FallOf(dBodyID body) { return std::max(0.0, -dBodyGetLinearVel(body)[2]); }
double SpinOf(dBodyID body) { return std::sqrt(VectorOf(dBodyGetAngularVel(body)).squaredNorm()); }

}  // namespace

void ContactFreeSet::Add(Model& model, bool owned)
{
  // The closed form does not know links.
  WheeledModel* const robot = model.Reach() > 0 ? nullptr : dynamic_cast<WheeledModel*>(&model);
  Body& body = bodies_.emplace_back(Body{.model = &model, .robot = robot, .owned = owned});
  const std::array<double, 6> box = BoxOf(body);
  const Vector3 sides(box[1] - box[0], box[3] - box[2], box[5] - box[4]);
  // No rigid body, however it turns, needs more.
  body.radius = std::sqrt(3 * sides.squaredNorm()) / 2;
  if (owned && IsRobot(model.GetSpaceEntity().GetKind())) body.radius += kArms;
  body.radius = std::max(body.radius, std::sqrt(2.0) * model.Reach());
  if (body.robot != nullptr) top_ = std::max(top_, body.robot->Height());
  solids_ = 0;
}

// A plane that is level, and nothing else to stand on.
bool ContactFreeSet::HasLevelGround() const
{
  const Vector3& gravity = scene_.world.Settings().gravity;
  if (!(gravity.z() < 0) || gravity.head<2>().norm() > -1e-9 * gravity.z()) return false;
  bool has_ground = false;
  for (const auto& solid : scene_.world.Solids())
  {
    has_ground |= solid->surface == ESurface::kGround;
    if (dGeomGetBody(solid->geom) != nullptr) continue;
    if (solid->layer == ELayer::kVoxels) return false;
    if (dGeomGetClass(solid->geom) != dPlaneClass)
    {
      if (solid->surface == ESurface::kTerrain) return false;
      continue;
    }
    dVector4 plane;
    dGeomPlaneGetParams(solid->geom, plane);
    const bool is_floor = plane[2] > 0.999 && plane[3] <= 0;
    const bool is_ceiling = IsOpposedTo(plane) && -plane[3] > top_ + kPushed;
    if (!is_floor && !is_ceiling && std::abs(plane[2]) > 1e-9) return false;
  }
  return has_ground;
}

bool ContactFreeSet::IsBesideRobots(const Box& box) const { return box[5] > -kPushed && box[4] < top_ + kPushed; }

// Returns the outlines of holes and static solids, and sets uprights_ by them.
std::vector<StaticOutline> ContactFreeSet::FindStatics()
{
  std::vector<StaticOutline> outlines = holes_;
  uprights_.assign(holes_.size(), {});
  for (const auto& solid : scene_.world.Solids())
  {
    if (dGeomGetBody(solid->geom) != nullptr) continue;
    Upright upright;
    upright.touch = solid->touch;
    if (dGeomGetClass(solid->geom) == dPlaneClass)
    {
      dVector4 plane;
      dGeomPlaneGetParams(solid->geom, plane);
      if (std::abs(plane[2]) >= 1e-9) continue;
      outlines.push_back(BehindWall(plane));
      upright.is_upright = true;
      upright.low = -kFarAway;
      upright.high = kFarAway;
      upright.normal = {plane[0], plane[1]};
      upright.distance = plane[3];
    }
    else
    {
      std::array<double, 6> box;
      dGeomGetAABB(solid->geom, box.data());
      if (!IsBesideRobots(box)) continue;
      outlines.push_back(OutlineOf(solid->geom, box));
      const std::optional<Prism> prism = PrismOf(solid->geom);
      upright.is_upright = prism.has_value() && prism->slope.norm() < 1e-9;
      if (upright.is_upright)
      {
        upright.prism = *prism;
        upright.half = {prism->half_x.norm(), prism->half_y.norm()};
        if (prism->radius == 0)
        {
          upright.along_x = prism->half_x / upright.half.x();
          upright.along_y = prism->half_y / upright.half.y();
        }
      }
      upright.low = box[4];
      upright.high = box[5];
    }
    uprights_.push_back(upright);
  }
  return outlines;
}

void ContactFreeSet::Configure()
{
  solids_ = scene_.world.Solids().size();
  has_level_ground_ = !solve_all_ && HasLevelGround();
  if (!has_level_ground_) return;
  outlines_.assign(bodies_.size(), {});
  for (std::size_t k = 0; k < bodies_.size(); ++k)
  {
    // The cells cover the arena, wherever the bodies are.
    const Vector3 corner = k % 2 == 0 ? Vector3::Zero() : scene_.space.GetExperiment().arena_size;
    const Vector3 place = scene_.frame.PointToLocal(corner);
    outlines_[k].whole = {place.x(), place.y(), bodies_[k].radius, 0};
  }
  isolation_.Configure(outlines_, FindStatics(), kFastest * steps_ * step_seconds_);
}

void ContactFreeSet::BeginTick()
{
  if (solids_ != scene_.world.Solids().size()) Configure();
  is_searched_ = false;
  pairs_.clear();
  for (Body& body : bodies_) body.is_in_plane = false;
  if (!has_level_ground_) return;
  has_links_.assign(scene_.models.size(), 0);
  scene_.links.Mark(has_links_);
  for (Body& body : bodies_)
  {
    body.advanced = 0;
    body.is_near = false;
    body.may_be_free =
        body.robot != nullptr && body.owned && !body.IsLeftOut() && has_links_[body.model->Entity()] == 0;
  }
  Search(0);
}

void ContactFreeSet::SearchAgain(int step)
{
  if (!is_searched_) return;
  Search(step);
  for (Body& body : bodies_)
    if (body.IsFree() && (body.is_near || !is_searched_)) AdvanceTo(body, step);
}

void ContactFreeSet::Search(int step)
{
  bool are_within = true;
  for (std::size_t k = 0; k < bodies_.size(); ++k)
  {
    const int done = bodies_[k].IsFree() ? bodies_[k].advanced : step;
    Outline(bodies_[k], (steps_ - done) * step_seconds_, outlines_[k]);
    if (bodies_[k].robot == nullptr && !bodies_[k].IsLeftOut())
    {
      const MovingCircle& whole = outlines_[k].whole;
      are_within = are_within && FarthestCorner(BoxOf(bodies_[k]), whole.x, whole.y) <= whole.radius;
    }
  }
  is_searched_ = are_within && isolation_.Find(outlines_, kPushed + kTouch, nearness_, &pairs_);
  for (Body& body : bodies_) body.is_in_plane = false;
  if (!is_searched_) return pairs_.clear();
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    bodies_[k].is_near = bodies_[k].is_near || nearness_[k] == Nearness::kNear;
  FindInPlane(step);
  const auto may_be_free = [&](std::uint32_t number) { return number < bodies_.size() && bodies_[number].may_be_free; };
  std::erase_if(pairs_,
                [&](const kinematics2d::Pair& pair) { return !may_be_free(pair.first) && !may_be_free(pair.second); });
  // The planar solver takes contacts in this order.
  std::ranges::sort(pairs_, {}, [](const kinematics2d::Pair& pair) { return std::pair(pair.first, pair.second); });
}

// Finds the robots that need no world of ODE, since all that they can meet, directly or through others, are robots that
// stand on wheels and upright walls. This changes no bit. ODE leaves them out at once, since other groups may step
// before theirs.
void ContactFreeSet::FindInPlane(int step)
{
  const auto count = static_cast<std::uint32_t>(bodies_.size());
  needs_ode_.assign(count, 0);
  for (std::uint32_t k = 0; k < count; ++k)
    needs_ode_[k] = bodies_[k].may_be_free && bodies_[k].robot->StandsOnWheels() ? 0 : 1;
  islands_.Reset(count);
  for (const kinematics2d::Pair& pair : pairs_)
  {
    const bool is_met = needs_ode_[pair.first] == 0 && MeetInPlane(bodies_[pair.first], pair.second);
    if (pair.second < count) islands_.Join(pair.first, pair.second);
    if (!is_met) needs_ode_[pair.first] = 1;
  }
  for (std::uint32_t k = 0; k < count; ++k)
    if (needs_ode_[k] != 0) needs_ode_[islands_.Of(k)] = 1;
  for (std::uint32_t k = 0; k < count; ++k)
  {
    Body& body = bodies_[k];
    body.is_in_plane = needs_ode_[islands_.Of(k)] == 0 && body.is_near;
    if (!body.is_in_plane || body.IsFree() || body.IsPlanar()) continue;
    body.robot->BecomePlanar();
    body.advanced = step;
  }
}

// Returns whether a robot and what it can meet stand side by side.
bool ContactFreeSet::MeetInPlane(const Body& robot, std::uint32_t other) const
{
  if (other >= bodies_.size())
  {
    const Upright& upright = uprights_[other - bodies_.size()];
    return upright.is_upright && robot.robot->MeetsUpright(upright.low, upright.high);
  }
  const Body& body = bodies_[other];
  if (body.robot == nullptr) return false;
  const PlanarOutline& first = robot.robot->InPlane();
  const PlanarOutline& second = body.robot->InPlane();
  return robot.robot->MeetsUpright(second.low, second.high) && body.robot->MeetsUpright(first.low, first.high);
}

namespace
{

// The outline of a robot where its motion is.
Prism PrismOf(const WheeledModel& robot)
{
  const PlanarOutline& outline = robot.InPlane();
  const PlaneMotion& motion = robot.Motion();
  Prism prism;
  prism.centre = {motion.x, motion.y};
  prism.radius = outline.radius;
  prism.half_x = Vector2(motion.cosine, motion.sine) * outline.half_size.x();
  prism.half_y = Vector2(-motion.sine, motion.cosine) * outline.half_size.y();
  return prism;
}

// Where a robot meets a wall without end.
PlaneContact MeetWall(const Prism& robot, const Vector2& normal, double distance)
{
  PlaneContact contact;
  contact.normal = normal;
  const auto add = [&](const Vector2& point)
  {
    const PlanePoint here{point, distance - normal.dot(point)};
    if (contact.count < 2)
      contact.points[contact.count++] = here;
    else if (PlanePoint& least = contact.points[contact.points[0].depth < contact.points[1].depth ? 0 : 1];
             here.depth > least.depth)
      least = here;
  };
  if (robot.radius > 0)
    add(robot.centre - normal * robot.radius);
  else
    for (const Vector2& corner : robot.CornersOfBox()) add(corner);
  return contact;
}

}  // namespace

PlaneContact ContactFreeSet::MeetUpright(const Prism& robot, const Upright& upright) const
{
  if (!upright.normal.isZero(0)) return MeetWall(robot, upright.normal, upright.distance);
  if (robot.radius == 0 || upright.prism.radius > 0) return Meet(robot, upright.prism);
  // A disc beside a box.
  const Vector2 way = robot.centre - upright.prism.centre;
  const Vector2 place(way.dot(upright.along_x), way.dot(upright.along_y));
  const Vector2 nearest = place.cwiseMax(-upright.half).cwiseMin(upright.half);
  const Vector2 apart = place - nearest;
  const double distance = std::sqrt(apart.squaredNorm());
  if (distance < 1e-9) return Meet(robot, upright.prism);
  PlaneContact contact;
  contact.normal = (apart.x() * upright.along_x + apart.y() * upright.along_y) / distance;
  contact.points[0] = {upright.prism.centre + nearest.x() * upright.along_x + nearest.y() * upright.along_y,
                       robot.radius - distance};
  contact.count = 1;
  return contact;
}

void ContactFreeSet::AddContacts(const kinematics2d::Pair& pair, PlanarSolver& solver) const
{
  const Body& first = bodies_[pair.first];
  const WorldSettings& settings = scene_.world.Settings();
  const Prism robot = PrismOf(*first.robot);
  PlaneContact meeting;
  PlanarContact contact{.first = first.in_solver, .friction = settings.friction, .restitution = settings.restitution};
  double reach = kTouch + first.step_way;
  if (pair.second < bodies_.size())
  {
    const Body& second = bodies_[pair.second];
    contact.second = static_cast<int>(second.in_solver);
    contact.yielding = kRubbing;
    meeting = Meet(robot, PrismOf(*second.robot));
    reach += second.step_way;
  }
  else
  {
    const Upright& upright = uprights_[pair.second - bodies_.size()];
    contact.friction = std::sqrt(settings.friction * upright.touch.friction.value_or(settings.friction));
    contact.restitution = std::max(settings.restitution, upright.touch.restitution.value_or(settings.restitution));
    meeting = MeetUpright(robot, upright);
  }
  contact.normal = meeting.normal;
  for (const PlanePoint& point : std::span(meeting.points).first(meeting.count))
  {
    if (point.depth < -reach) continue;
    contact.point = point.point;
    contact.depth = point.depth;
    solver.Add(contact);
  }
}

int ContactFreeSet::PlanarStep(std::span<const std::uint32_t> bodies, std::span<const kinematics2d::Pair> pairs,
                               PlanarSolver& solver)
{
  const WorldSettings& settings = scene_.world.Settings();
  solver.Begin(step_seconds_, settings.wheel_friction, std::sqrt(settings.gravity.squaredNorm()));
  for (const std::uint32_t k : bodies)
    if (Body& body = bodies_[k]; body.IsPlanar()) body.in_solver = body.robot->AddTo(solver);
  if (solver.IsEmpty()) return 0;
  for (const kinematics2d::Pair& pair : pairs)
    if (bodies_[pair.first].IsPlanar() && (pair.second >= bodies_.size() || bodies_[pair.second].IsPlanar()))
      AddContacts(pair, solver);
  solver.Solve(settings.iterations);
  for (const std::uint32_t k : bodies)
    if (Body& body = bodies_[k]; body.IsPlanar()) body.robot->AfterPlanarStep(step_seconds_);
  return static_cast<int>(solver.ContactCount());
}

// Sets the outline of a body at its position, and how far the body can move by itself within `seconds`.
void ContactFreeSet::Outline(const Body& body, double seconds, MovingOutline& outline)
{
  outline.present = !body.IsLeftOut();
  outline.part_count = 0;
  if (!outline.present)
  {
    outline.whole = {0, 0, body.radius, 0};
    return;
  }
  if (body.robot != nullptr && body.robot->IsUpright())
  {
    const Vector2 place = body.robot->GroundPoint();
    const double way = body.robot->LargestSpeed() * seconds;
    outline.whole = {place.x(), place.y(), body.radius, way};
    outline.parts[0] = {place.x(), place.y(), body.robot->Radius(), way};
    outline.part_count = 1;
    return;
  }
  const std::array<double, 6> box = BoxOf(body);
  const dBodyID main = MainBodyOf(body);
  outline.whole = {(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, body.radius, SpeedInPlane(main) * seconds};
  // A body above all robots is left out if it cannot fall onto one.
  const double falls = FallOf(main) * seconds - scene_.world.Settings().gravity.z() * seconds * seconds / 2;
  outline.present = box[4] - falls < top_ + kPushed;
}

bool ContactFreeSet::IsAnyTooFar(std::span<const std::uint32_t> bodies) const
{
  return is_searched_ && std::ranges::any_of(bodies,
                                             [&](std::uint32_t k)
                                             {
                                               const Body& body = bodies_[k];
                                               return !body.IsFree() && !body.IsLeftOut() &&
                                                      IsTooFar(body, outlines_[k]);
                                             });
}

bool ContactFreeSet::IsTooFar(const Body& body, const MovingOutline& outline) const
{
  const MovingCircle& whole = outline.whole;
  const dBodyID main = MainBodyOf(body);
  const double next = (body.IsPlanar() ? body.robot->PlanarSpeed() : SpeedInPlane(main)) * step_seconds_;
  if (outline.part_count > 0)
    return !body.robot->IsUpright() ||
           (body.robot->GroundPoint() - Vector2(whole.x, whole.y)).norm() + next > whole.way + kPushed;
  const std::array<double, 6> box = BoxOf(body);
  if (!outline.present) return box[4] - FallOf(main) * step_seconds_ < top_;
  return FarthestCorner(box, whole.x, whole.y) + next > whole.radius + whole.way + kPushed;
}

// Returns the largest distance (m) by which a body can come nearer to others in one step.
double ContactFreeSet::LargestStep(const Body& body) const
{
  if (body.robot != nullptr && body.robot->IsUpright()) return body.robot->LargestSpeed() * step_seconds_;
  if (body.model->Reach() > 0) return body.model->LargestSpeed() * step_seconds_;
  const dBodyID main = MainBodyOf(body);
  return (SpeedInPlane(main) + SpinOf(main) * body.radius) * step_seconds_;
}

double ContactFreeSet::GapBetween(const Body& robot, std::uint32_t other) const
{
  const Vector2 place = robot.robot->GroundPoint();
  double gap = -robot.robot->Radius();
  if (other >= bodies_.size() && uprights_[other - bodies_.size()].is_upright)
  {
    const Upright& upright = uprights_[other - bodies_.size()];
    if (!upright.normal.isZero(0)) return gap + upright.normal.dot(place) - upright.distance;
    const Vector2 way = place - upright.prism.centre;
    if (upright.prism.radius > 0) return gap + way.norm() - upright.prism.radius;
    const double x = std::max(std::abs(way.dot(upright.along_x)) - upright.half.x(), 0.0);
    const double y = std::max(std::abs(way.dot(upright.along_y)) - upright.half.y(), 0.0);
    return gap + std::sqrt(x * x + y * y);
  }
  if (other >= bodies_.size()) return gap + swarmanoid::DistanceTo(isolation_.Statics()[other - bodies_.size()], place);
  const Body& body = bodies_[other];
  if (body.robot != nullptr && body.robot->IsUpright())
    return gap + (body.robot->GroundPoint() - place).norm() - body.robot->Radius();
  return gap + DistanceTo(BoxOf(body), place);
}

// Finds the bodies that touch, and for each its island of bodies that touch one another.
void ContactFreeSet::FindTouching(std::span<const std::uint32_t> bodies, std::span<const kinematics2d::Pair> pairs)
{
  for (const std::uint32_t k : bodies)
  {
    Body& body = bodies_[k];
    body.touches = false;
    body.island = k;
    body.step_way = body.IsLeftOut() ? 0 : LargestStep(body);
    body.needs_ode = !body.may_be_free || !body.robot->StandsOnWheels();
  }
  for (const kinematics2d::Pair& pair : pairs)
  {
    std::uint32_t robot = pair.first;
    std::uint32_t other = pair.second;
    if (!bodies_[robot].may_be_free) std::swap(robot, other);
    Body& body = bodies_[robot];
    double reach = kTouch + body.step_way;
    if (other < bodies_.size()) reach += bodies_[other].step_way;
    if (GapBetween(body, other) >= reach) continue;
    body.touches = true;
    if (!MeetInPlane(body, other)) body.needs_ode = true;
    if (other >= bodies_.size()) continue;
    bodies_[other].touches = true;
    const std::uint32_t a = IslandOf(robot), b = IslandOf(other);
    bodies_[std::max(a, b)].island = std::min(a, b);
  }
  for (const std::uint32_t k : bodies)
    if (bodies_[k].needs_ode) bodies_[IslandOf(k)].needs_ode = true;
}

std::uint32_t ContactFreeSet::IslandOf(std::uint32_t body) const
{
  while (bodies_[body].island != body) body = bodies_[body].island;
  return body;
}

bool ContactFreeSet::BeforeStep(std::span<const std::uint32_t> bodies, std::span<const kinematics2d::Pair> pairs,
                                int step, std::vector<Model*>& solved)
{
  solved.clear();
  if (is_searched_) FindTouching(bodies, pairs);
  bool is_any_left = false;
  for (const std::uint32_t k : bodies)
  {
    Body& body = bodies_[k];
    if (!body.owned || body.IsLeftOut()) continue;
    if (body.robot != nullptr) Decide(body, step);
    if (!body.IsFree() && !body.IsPlanar()) solved.push_back(body.model);
    is_any_left = is_any_left || !body.IsFree() || body.is_near;
  }
  return is_any_left;
}

void ContactFreeSet::Decide(Body& body, int step)
{
  WheeledModel& robot = *body.robot;
  const bool may_be_free = is_searched_ && body.may_be_free;
  const bool is_in_contact = body.is_near && body.touches;
  if (may_be_free && !bodies_[IslandOf(body.model->AssemblyNumber())].needs_ode)
  {
    const bool was_free = robot.IsFree();
    if (was_free && !is_in_contact) return;
    if (was_free) AdvanceTo(body, step);
    body.advanced = step;
    robot.BecomePlanar();
    if (!is_in_contact && robot.RollsFreely()) robot.BecomeFree();
    return;
  }
  if (robot.IsPlanar())
  {
    robot.MoveBodies();
    robot.BecomeSolved();
  }
  if (robot.IsFree())
  {
    if (may_be_free && !is_in_contact) return;
    AdvanceTo(body, step);
    robot.MoveBodies();
    robot.BecomeSolved();
  }
  else if (may_be_free && !is_in_contact && robot.RollsFreely())
  {
    robot.BecomeFree();
    body.advanced = step;
  }
  else
    robot.BecomeSolved();
}

void ContactFreeSet::AdvanceTo(Body& body, int step) const
{
  if (step > body.advanced) body.robot->AdvanceFreely(step - body.advanced, step_seconds_);
  body.advanced = step;
}

// Robots near others advance step by step. All other free robots do their steps at once, in EndTick.
void ContactFreeSet::AfterStep(std::span<const std::uint32_t> bodies, int step)
{
  for (const std::uint32_t k : bodies)
    if (Body& body = bodies_[k]; body.is_near && body.IsFree()) AdvanceTo(body, step + 1);
}

void ContactFreeSet::EndTick(std::uint32_t number)
{
  Body& body = bodies_[number];
  if (body.IsFree()) AdvanceTo(body, steps_);
  if (body.IsFree() || body.IsPlanar()) body.robot->MoveBodies();
}

void ContactFreeSet::SaveTick(std::uint32_t number, ByteWriter& state) const
{
  const Body& body = bodies_[number];
  state.Put(body.may_be_free);
  state.Put(body.is_near);
  state.Put(body.is_in_plane);
  state.Put(static_cast<std::int32_t>(body.advanced));
  if (!is_searched_) return;
  const MovingOutline& outline = outlines_[number];
  state.Put(outline.whole);
  state.Put(static_cast<std::int32_t>(outline.part_count));
  state.Put(outline.present);
}

void ContactFreeSet::LoadTick(std::uint32_t number, ByteReader& state)
{
  Body& body = bodies_[number];
  body.may_be_free = state.Get<std::uint8_t>() != 0;
  body.is_near = state.Get<std::uint8_t>() != 0;
  body.is_in_plane = state.Get<std::uint8_t>() != 0;
  body.advanced = state.Get<std::int32_t>();
  if (!is_searched_) return;
  MovingOutline& outline = outlines_[number];
  outline.whole = state.Get<MovingCircle>();
  outline.part_count = state.Get<std::int32_t>();
  outline.present = state.Get<std::uint8_t>() != 0;
}

void ContactFreeSet::FollowSearch(bool is_searched)
{
  if (solids_ != scene_.world.Solids().size()) Configure();
  if (is_searched && !has_level_ground_) throw std::runtime_error("a region of dynamics3d has no level ground");
  is_searched_ = is_searched;
}

std::size_t ContactFreeSet::Count() const
{
  return static_cast<std::size_t>(std::ranges::count_if(bodies_, [](const Body& body) { return body.IsFree(); }));
}

}  // namespace swarmanoid::dynamics3d
