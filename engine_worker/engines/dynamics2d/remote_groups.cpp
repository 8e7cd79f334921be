// Problem: other processes solve groups, with the bits of one process, and a process may be lost at any time.
//
// Method: the motion of a group follows from its bodies, their commands, and the forces of the last step. All of that
// goes to a region in each tick, and comes back. A region that knows nothing gets the models of all bodies first.
//
// Invariants: a group is here or in one region in a tick. While the regions are not ready (before the start, in
// recovery), groups are solved here.
#include "engine_worker/engines/dynamics2d/remote_groups.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace swarmanoid::dynamics2d
{
namespace
{

void PutPolygon(std::span<const Vector2> polygon, ByteWriter& stream)
{
  stream.Put(static_cast<std::uint8_t>(polygon.size()));
  for (const Vector2& corner : polygon)
  {
    stream.Put(corner.x());
    stream.Put(corner.y());
  }
}

std::vector<Vector2> GetPolygon(ByteReader& stream)
{
  std::vector<Vector2> polygon(stream.Get<std::uint8_t>());
  if (polygon.size() > kMostCutCorners || (!polygon.empty() && polygon.size() < 3))
    RefuseGroup("an outline has too many or too few corners");
  for (Vector2& corner : polygon)
  {
    corner.x() = stream.Get<double>();
    corner.y() = stream.Get<double>();
  }
  return polygon;
}

// Mirrored blocks change their outlines.
bool HasOutlineThatChanges(const Body& body)
{
  return body.model.motion == EMotion::kKinematic && !body.model.polygon.empty();
}

bool IsAscending(std::span<const std::uint32_t> numbers, std::size_t bodies)
{
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] >= bodies || (i > 0 && numbers[i] <= numbers[i - 1])) return false;
  return true;
}

// Throws unless the numbers of all bodies that a group names are of bodies in it.
void Check(std::span<const Body> bodies, const GroupRun& run)
{
  const auto has = [](std::span<const std::uint32_t> numbers, std::uint32_t number)
  { return std::ranges::binary_search(numbers, number); };
  for (const std::uint32_t number : run.bodies)
  {
    const Body& body = bodies[number];
    if (body.model.motion == EMotion::kStatic) RefuseGroup("a body that moves is static");
    if (body.gripped != kNoBody && !has(run.bodies, static_cast<std::uint32_t>(body.gripped)))
      RefuseGroup("a body holds a body that is not there");
  }
  std::uint32_t last = 0;
  for (const Contact& contact : run.contacts)
  {
    if (contact.a < last || contact.forces.points < 0 || contact.forces.points > 2)
      RefuseGroup("a contact does not fit");
    last = contact.a;
  }
}

}  // namespace

void RefuseGroup(const char* reason)
{
  throw std::runtime_error(std::string("dynamics2d and its regions do not fit together: ") + reason);
}

void PutModel(const Body& body, ByteWriter& stream)
{
  const BodyModel& model = body.model;
  for (const auto flag : {static_cast<int>(model.motion), model.lies ? 1 : 0, model.has_gripper ? 1 : 0,
                          model.has_turret_motor ? 1 : 0, model.grips_by_rod ? 1 : 0})
    stream.Put(static_cast<std::uint8_t>(flag));
  for (const double value : {model.radius, model.mass, model.inertia, model.friction, model.restitution,
                             model.ground_force, model.ground_torque, body.half_axle})
    stream.Put(value);
  PutPolygon(model.polygon, stream);
  stream.Put(body.state);
}

void GetModel(Body& body, ByteReader& stream)
{
  BodyModel& model = body.model;
  const auto motion = stream.Get<std::uint8_t>();
  if (motion > static_cast<int>(EMotion::kStatic)) RefuseGroup("a body moves in an unknown way");
  model.motion = static_cast<EMotion>(motion);
  for (bool* const flag : {&model.lies, &model.has_gripper, &model.has_turret_motor, &model.grips_by_rod})
    *flag = stream.Get<std::uint8_t>() != 0;
  for (double* const value : {&model.radius, &model.mass, &model.inertia, &model.friction, &model.restitution,
                              &model.ground_force, &model.ground_torque, &body.half_axle})
    *value = stream.Get<double>();
  model.polygon = GetPolygon(stream);
  if ((model.radius > 0) != model.polygon.empty()) RefuseGroup("a body has no outline, or two");
  body.state = stream.Get<BodyState>();
  body.heading = SinCosOf(body.state.angle);
  UpdateShape(body);
}

void PutGroup(std::span<const Body> bodies, const GroupRun& run, ByteWriter& stream)
{
  stream.PutArray(run.bodies);
  for (const std::uint32_t number : run.bodies)
  {
    const Body& body = bodies[number];
    PutMotion(body, stream);
    PutGrip(body, stream);
    stream.Put(body.ground);
    stream.Put(body.grip_forces);
    stream.Put(body.drive);
    stream.Put(body.turret_speed);
    stream.Put(body.measures);
    if (HasOutlineThatChanges(body)) PutPolygon(body.model.polygon, stream);
  }
  stream.PutArray(run.ways);
  stream.PutArray(run.fixed);
  stream.PutArray(run.contacts);
  stream.Put(static_cast<std::uint8_t>(run.is_bounded ? 1 : 0));
  stream.Put(run.steps_done);
}

void GetGroup(std::span<Body> bodies, GroupRun& run, ByteReader& stream)
{
  stream.GetArray(run.bodies);
  if (!IsAscending(run.bodies, bodies.size())) RefuseGroup("a group has bodies that do not exist");
  for (const std::uint32_t number : run.bodies)
  {
    Body& body = bodies[number];
    GetMotion(body, stream);
    GetGrip(body, stream);
    body.heading = SinCosOf(body.state.angle);
    body.ground = stream.Get<GroundForce>();
    body.grip_forces = stream.Get<GripForces>();
    body.drive = stream.Get<Twist>();
    body.turret_speed = stream.Get<double>();
    body.measures = stream.Get<TickMeasures>();
    if (!HasOutlineThatChanges(body)) continue;
    body.model.polygon = GetPolygon(stream);
    if (body.model.polygon.empty()) RefuseGroup("a body has no outline");
    UpdateShape(body);
  }
  stream.GetArray(run.ways);
  stream.GetArray(run.fixed);
  stream.GetArray(run.contacts);
  run.is_bounded = stream.Get<std::uint8_t>() != 0;
  run.steps_done = stream.Get<std::int32_t>();
  run.goes_too_far = false;
  if (run.ways.size() != run.bodies.size() || !IsAscending(run.fixed, bodies.size()) || run.steps_done < 0)
    RefuseGroup("a group is not whole");
  Check(bodies, run);
}

void PutResult(std::span<const Body> bodies, const GroupRun& run, const SolverSettings& settings, ByteWriter& result)
{
  result.Put(run.steps_done);
  result.Put(static_cast<std::uint8_t>(run.goes_too_far ? 1 : 0));
  for (const std::uint32_t number : run.bodies)
  {
    const Body& body = bodies[number];
    PutMotion(body, result);
    result.Put(body.ground);
    if (body.gripped != kNoBody) result.Put(body.grip_forces);
    if (body.half_axle > 0)
    {
      result.Put(body.measures.left_arc);
      result.Put(body.measures.right_arc);
    }
    if (settings.measures_loads != 0 && body.gripped != kNoBody) result.Put(body.measures.load);
  }
  result.PutArray(run.contacts);
}

void GetResult(std::span<Body> bodies, GroupRun& run, const SolverSettings& settings, ByteReader& result)
{
  run.steps_done = result.Get<std::int32_t>();
  run.goes_too_far = result.Get<std::uint8_t>() != 0;
  for (const std::uint32_t number : run.bodies)
  {
    Body& body = bodies[number];
    GetMotion(body, result);
    body.ground = result.Get<GroundForce>();
    if (body.gripped != kNoBody) body.grip_forces = result.Get<GripForces>();
    if (body.half_axle > 0)
    {
      body.measures.left_arc = result.Get<double>();
      body.measures.right_arc = result.Get<double>();
    }
    if (settings.measures_loads != 0 && body.gripped != kNoBody) body.measures.load = result.Get<TurretLoad>();
  }
  result.GetArray(run.contacts);
  Check(bodies, run);
}

RemoteGroups::RemoteGroups(RegionTeam& team, unsigned threads)
    : streams_(team), threads_(threads), runs_(team.RegionCount())
{
}

void RemoteGroups::ForgetLoads()
{
  streams_.ForgetLoads();
  for (std::vector<GroupRun*>& runs : runs_) runs.clear();
}

void RemoteGroups::Add(GroupRun& run) { runs_[streams_.ChooseRegion(run.bodies.size())].push_back(&run); }

void RemoteGroups::Run(std::span<Body> bodies, const SolverSettings& settings, double seconds, int steps,
                       const std::function<void()>& meanwhile)
{
  if (std::ranges::all_of(runs_, [](const std::vector<GroupRun*>& runs) { return runs.empty(); })) return meanwhile();
  const auto write = [&](bool all_data, std::span<ByteWriter> streams)
  {
    for (std::size_t region = 0; region < streams.size(); ++region)
    {
      ByteWriter& stream = streams[region];
      stream.Put(static_cast<std::uint8_t>(all_data ? 1 : 0));
      if (all_data)
      {
        stream.Put(settings);
        stream.Put(static_cast<std::uint32_t>(threads_));
        stream.Put(static_cast<std::uint32_t>(bodies.size()));
        for (const Body& body : bodies) PutModel(body, stream);
      }
      stream.Put(seconds);
      stream.Put(static_cast<std::int32_t>(steps));
      stream.Put(static_cast<std::uint32_t>(runs_[region].size()));
      for (const GroupRun* run : runs_[region]) PutGroup(bodies, *run, stream);
    }
  };
  streams_.Run(write, meanwhile);
  for (std::size_t region = 0; region < streams_.Count(); ++region)
  {
    if (runs_[region].empty()) continue;
    ByteReader result(streams_.ResultOf(region));
    for (GroupRun* run : runs_[region]) GetResult(bodies, *run, settings, result);
    if (!result.AtEnd()) RefuseGroup("a result does not end");
  }
}

}  // namespace swarmanoid::dynamics2d
