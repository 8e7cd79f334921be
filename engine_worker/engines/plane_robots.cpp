#include "engine_worker/engines/plane_robots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/math/elementary.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr double kGravity = 9.81;  // m/s2

// Returns the distance (m) from a point to a body, 0 inside.
double DistanceTo(const Shape& shape, const Pose& pose, const Vector3& point)
{
  const Vector3 local = pose.orientation.conjugate() * (point - pose.position) - shape.centre;
  Vector3 outside = (local.cwiseAbs() - shape.half_size).cwiseMax(0);
  if (shape.kind == Shape::Kind::kCylinder)
  {
    const double from_axis = std::sqrt(local.x() * local.x() + local.y() * local.y());
    outside = {std::max(from_axis - shape.half_size.x(), 0.0), 0, outside.z()};
  }
  return std::sqrt(outside.squaredNorm());
}

// Finds the robot of an entity, or the position for it, in `robots` by ascending entity.
template <class Robots>
auto PlaceOf(Robots& robots, std::uint32_t entity)
{
  return std::lower_bound(robots.begin(), robots.end(), entity,
                          [](const auto& robot, std::uint32_t e) { return robot.entity < e; });
}

template <class Robot>
Robot& Find(std::vector<Robot>& robots, std::uint32_t entity)
{
  return *PlaceOf(robots, entity);
}

template <class Robot>
const Robot& Find(const std::vector<Robot>& robots, std::uint32_t entity)
{
  return *PlaceOf(robots, entity);
}

}  // namespace

void PlaneRobots::Init(const CSwarmanoidSpace& space, const PlaneFrame& frame, PlaneGrips& grips)
{
  space_ = &space;
  frame_ = &frame;
  grips_ = &grips;
  if (space.GetExperiment().wind) wind_ = std::make_unique<Wind>(space.GetExperiment());
  up_ = frame.Frame().orientation * Vector3::UnitZ();
  // A plane that leans, or stands upright, has no ceiling.
  if (up_.z() > 1 - 1e-12) ceiling_ = std::max(space.GetExperiment().arena_size.z() - frame.Frame().position.z(), 0.0);
}

void PlaneRobots::AddOwned(const CSwarmanoidSpaceEntity& entity)
{
  const std::uint32_t index = entity.GetIndex();
  const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
  if (kind.mechanism == Mechanism::kArms)
  {
    Handbot handbot;
    handbot.entity = index;
    handbots_.push_back(handbot);
    lifted_.push_back({index, 0, 0, 0, 0});
  }
  if (!kind.links.empty())
  {
    Jointed& robot = jointed_.emplace_back(Jointed{.entity = index, .links = &kind.links});
    robot.commands.resize(kind.links.size());
    robot.speeds.resize(kind.links.size());
    for (const MovingLink& link : kind.links) robot.positions.push_back(link.Start());
  }
  if (kind.propellers && kind.propellers->magnet_reach_m > 0)
    magnets_.push_back({index, entity.GetSize().z() + kind.propellers->magnet_reach_m, false});
  if (kind.role != EntityRole::kObject || !kind.grippable) return;
  objects_.push_back(index);
  const Shape shape = ShapeOf(entity.GetConfiguration());
  near_objects_.Add(shape.centre.norm() + BoundingRadius(shape));
  lifted_.push_back({index, 0, 0, 0, 0});
}

PlaneRobots::Handbot& PlaneRobots::HandbotOf(std::uint32_t entity) { return Find(handbots_, entity); }
PlaneRobots::Lifted& PlaneRobots::LiftedOf(std::uint32_t entity) { return Find(lifted_, entity); }

bool PlaneRobots::Command(const ChannelBlock& block, std::span<const double> values)
{
  const bool arms = block.name == "handbot_arms";
  const bool hands = block.name == "handbot_hands";
  const bool rope = block.name == "handbot_rope";
  const bool joints = block.name == "joints";
  if (!arms && !hands && !rope && !joints && block.name != "eyebot_attach") return false;
  const auto width = static_cast<std::size_t>(block.width);
  for (std::size_t k = 0; k < block.entities.size(); ++k)
  {
    const std::uint32_t entity = block.entities[k];
    const double* const value = &values[k * width];
    if (!std::all_of(value, value + width, [](double v) { return std::isfinite(v); }))
      throw std::runtime_error("robot '" + space_->GetEntity(entity).GetId() + "' gave " + block.name +
                               " a value that is not a finite number");
    if (arms) std::copy_n(value, 5, HandbotOf(entity).rates);
    if (hands)
    {
      Handbot& handbot = HandbotOf(entity);
      handbot.has_hands = true;
      for (std::size_t hand = 0; hand < 2; ++hand) handbot.close[hand] = value[hand] > 0.5;
    }
    if (rope)
    {
      HandbotOf(entity).launch = value[0] > 0.5;
      HandbotOf(entity).winch = std::clamp(value[1], -PlaneHandbot::kWinchSpeed, PlaneHandbot::kWinchSpeed);
    }
    if (joints)
    {
      std::vector<JointCommand>& commands = Find(jointed_, entity).commands;
      for (std::size_t joint = 0; joint < commands.size(); ++joint)
        commands[joint] = JointCommand::From({value + kJointCommandWidth * joint, kJointCommandWidth});
    }
    if (!arms && !hands && !rope && !joints) Find(magnets_, entity).attach = value[0] > 0.5;
  }
  return true;
}

Vector2 PlaneRobots::Drift(std::uint32_t entity, double yaw_rate) const
{
  if (!wind_) return Vector2::Zero();
  const double seconds = space_->GetTickSeconds();
  const Pose pose = space_->GetPose(entity);
  const Vector3 wind = wind_->At(pose.position, static_cast<double>(space_->GetTick()) * seconds);
  const Vector3 on_plane = frame_->Frame().orientation.conjugate() * wind;
  // The engine turns the velocity with the robot. One that points along the wind in the middle of the tick gives its
  // way, longer by what the arc takes from it.
  const double half_turn = yaw_rate * seconds / 2;
  const SinCos heading = SinCosOf(frame_->ToPlane(pose).heading + half_turn);
  const double longer = std::abs(half_turn) > 1e-6 && std::abs(half_turn) < 1 ? half_turn / Sin(half_turn) : 1;
  return longer * Vector2(heading.cos * on_plane.x() + heading.sin * on_plane.y(),
                          heading.cos * on_plane.y() - heading.sin * on_plane.x());
}

void PlaneRobots::Sense(const ChannelBlock& block, std::span<double> values) const
{
  if (block.name != "joints") return;
  const auto width = static_cast<std::size_t>(block.width);
  for (std::size_t k = 0; k < block.entities.size(); ++k)
  {
    const Jointed& robot = Find(jointed_, block.entities[k]);
    const std::span<double> mine = values.subspan(k * width, width);
    std::ranges::fill(mine, 0.0);
    for (std::size_t joint = 0; joint < robot.positions.size(); ++joint)
    {
      mine[kJointReadingWidth * joint] = robot.positions[joint];
      mine[kJointReadingWidth * joint + 1] = robot.speeds[joint];
    }
  }
}

void PlaneRobots::Advance(double seconds)
{
  for (Jointed& robot : jointed_)
    for (std::size_t joint = 0; joint < robot.positions.size(); ++joint)
    {
      const MovingLink& link = (*robot.links)[joint];
      double& position = robot.positions[joint];
      const double next = NextReference(link, robot.commands[joint], position, seconds);
      robot.speeds[joint] = (next - position) / seconds;
      position = link.IsEndless() ? WrapAngle(next) : next;
    }
  near_objects_.Forget();
  attached_.clear();
  for (const Magnet& magnet : magnets_)
    if (magnet.attach && ceiling_ > 0 && magnet.reach >= ceiling_) attached_.push_back(magnet.entity);
  // Hands that open come first, then hands that close, in entity order.
  for (Handbot& handbot : handbots_)
    for (std::size_t hand = 0; hand < 2; ++hand)
      if (!handbot.close[hand] || !grips_->Holds(handbot.entity)) Release(handbot, hand);
  for (Handbot& handbot : handbots_)
  {
    UseHands(handbot);
    TurnJoints(handbot, seconds);
    UseRope(handbot, seconds);
  }
  if (handbots_.empty()) return;
  for (Lifted& lifted : lifted_)
  {
    if (lifted.bearer != 0)
    {
      lifted.height = std::max(LiftedOf(lifted.bearer - 1).height + lifted.above_bearer, 0.0);
      continue;
    }
    if (lifted.height == 0 || Hangs(lifted.entity)) continue;
    lifted.height = std::max(lifted.height - (lifted.fall + kGravity * seconds / 2) * seconds, 0.0);
    lifted.fall = lifted.height > 0 ? lifted.fall + kGravity * seconds : 0;
  }
}

bool PlaneRobots::Hangs(std::uint32_t entity) const
{
  const auto handbot = PlaceOf(handbots_, entity);
  return handbot != handbots_.end() && handbot->entity == entity && handbot->is_hanging;
}

void PlaneRobots::Release(Handbot& handbot, std::size_t hand)
{
  const std::uint32_t held = handbot.held[hand];
  if (held == 0) return;
  handbot.held[hand] = 0;
  if (handbot.held[1 - hand] == held) return;
  if (grips_->Holds(handbot.entity)) grips_->LetGo(handbot.entity);
  LiftedOf(held - 1).bearer = 0;
}

void PlaneRobots::UseHands(Handbot& handbot)
{
  for (std::size_t hand = 0; hand < 2; ++hand)
  {
    if (!handbot.close[hand] || handbot.held[hand] != 0) continue;
    const std::uint32_t object = ObjectAt(handbot, hand);
    if (object == 0) continue;
    const std::uint32_t other = handbot.held[1 - hand];
    if (other != 0 && other != object) continue;
    Lifted& lifted = LiftedOf(object - 1);
    if (other == 0 && (lifted.bearer != 0 || !grips_->Hold(handbot.entity, object - 1))) continue;
    handbot.held[hand] = object;
    lifted.bearer = handbot.entity + 1;
    lifted.fall = 0;
    lifted.above_bearer = lifted.height - LiftedOf(handbot.entity).height;
  }
}

// Returns 1 + the nearest object within the reach of a hand, or 0 if there is no such object. The head rolls about its
// forward axis and carries both arms; an arm's aperture opens it outwards.
std::uint32_t PlaneRobots::ObjectAt(const Handbot& handbot, std::size_t hand) const
{
  const double side = hand == 0 ? 1 : -1;
  const SinCos arm = SinCosOf(handbot.arm[hand]);
  const SinCos head = SinCosOf(handbot.head);
  const double beside = side * (PlaneHandbot::kShoulder + PlaneHandbot::kArmLength * arm.sin);
  const Vector3 tip(PlaneHandbot::kHeadForward + PlaneHandbot::kArmLength * arm.cos, beside * head.cos,
                    PlaneHandbot::kHeadHeight + beside * head.sin);
  const Vector3 place = space_->GetPose(handbot.entity).Apply(tip);
  const auto origin = [this](std::size_t k) -> Vector3
  {
    if (!space_->IsPresent(objects_[k]) || std::ranges::binary_search(elsewhere_, objects_[k]))
      return Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
    return space_->GetPose(objects_[k]).position;
  };
  double nearest = PlaneHandbot::kReach;
  std::uint32_t found = 0;
  for (const std::uint32_t k : near_objects_.Near(space_->GetExperiment(), place, nearest, origin))
  {
    const std::uint32_t object = objects_[k];
    const double distance =
        DistanceTo(ShapeOf(space_->GetEntity(object).GetConfiguration()), space_->GetPose(object), place);
    if (distance >= nearest) continue;
    nearest = distance;
    found = object + 1;
  }
  return found;
}

void PlaneRobots::TurnJoints(Handbot& handbot, double seconds) const
{
  handbot.head = WrapAngle(handbot.head + handbot.rates[0] * seconds);
  for (std::size_t k = 0; k < 2; ++k)
  {
    handbot.arm[k] = std::clamp(handbot.arm[k] + handbot.rates[1 + k] * seconds, 0.0, PlaneHandbot::kWidestArm);
    handbot.wrist[k] = std::clamp(handbot.wrist[k] + handbot.rates[3 + k] * seconds, 0.0, PlaneHandbot::kWidestWrist);
    if (!handbot.has_hands || handbot.held[k] != 0) continue;
    const double turn = (handbot.close[k] ? -1 : 1) * PlaneHandbot::kHandSpeed * seconds;
    handbot.aperture[k] = std::clamp(handbot.aperture[k] + turn, 0.0, PlaneHandbot::kWidestHand);
  }
}

void PlaneRobots::UseRope(Handbot& handbot, double seconds)
{
  Lifted& lifted = LiftedOf(handbot.entity);
  if (!handbot.launch)
  {
    handbot.is_hanging = false;
    handbot.rope = 0;
    return;
  }
  if (!handbot.is_hanging)
  {
    const double distance = ceiling_ - lifted.height - PlaneHandbot::kHeight;
    if (ceiling_ == 0 || distance < 0 || distance > PlaneHandbot::kLongestRope) return;
    handbot.is_hanging = true;
    handbot.rope = distance;
    lifted.fall = 0;
  }
  handbot.rope =
      std::clamp(handbot.rope + handbot.winch * seconds, PlaneHandbot::kShortestRope, PlaneHandbot::kLongestRope);
  // A slack rope lets the robot stand.
  lifted.height = std::max(ceiling_ - PlaneHandbot::kHeight - handbot.rope, 0.0);
}

void PlaneRobots::Moved(std::uint32_t entity)
{
  for (Handbot& handbot : handbots_)
  {
    const bool is_it = handbot.entity == entity;
    for (std::uint32_t& held : handbot.held)
    {
      if (held == 0 || (!is_it && held != entity + 1)) continue;
      if (space_->Structure().Holds(handbot.entity, held - 1)) continue;
      LiftedOf(held - 1).bearer = 0;
      held = 0;
    }
    if (is_it) handbot.is_hanging = false;
  }
  for (Lifted& lifted : lifted_)
  {
    if (lifted.entity != entity) continue;
    lifted.height = lifted.fall = 0;
    if (lifted.bearer == 0) lifted.above_bearer = 0;
  }
}

void PlaneRobots::TakeOver(std::uint32_t entity, double height, const EntityVelocity& velocity)
{
  std::erase(elsewhere_, entity);
  Moved(entity);
  if (const auto robot = PlaceOf(handbots_, entity); robot != handbots_.end() && robot->entity == entity)
  {
    const CSwarmanoidSpaceEntity& it = space_->GetEntity(entity);
    robot->head = it.GetAttribute("head_angle");
    for (int k = 0; k < 2; ++k)
    {
      robot->arm[k] = it.GetAttribute("arm", k);
      robot->wrist[k] = it.GetAttribute("wrist", k);
      robot->aperture[k] = it.GetAttribute("hand_aperture", k);
    }
  }
  if (const auto robot = PlaceOf(jointed_, entity); robot != jointed_.end() && robot->entity == entity)
    for (std::size_t joint = 0; joint < robot->positions.size(); ++joint)
      robot->positions[joint] = space_->GetEntity(entity).GetAttribute((*robot->links)[joint].attribute);
  if (handbots_.empty()) return;  // nothing lifts or falls
  if (const auto lifted = PlaceOf(lifted_, entity); lifted != lifted_.end() && lifted->entity == entity && height > 0)
  {
    lifted->height = height;
    lifted->fall = -velocity.linear.dot(up_);
  }
}

void PlaneRobots::HandOver(std::uint32_t entity)
{
  const auto is_object = std::ranges::binary_search(objects_, entity);
  const auto at = std::ranges::lower_bound(elsewhere_, entity);
  if (is_object && (at == elsewhere_.end() || *at != entity)) elsewhere_.insert(at, entity);
  for (Handbot& handbot : handbots_)
    for (std::uint32_t& held : handbot.held)
      if (held == entity + 1 || handbot.entity == entity)
      {
        if (held != 0) LiftedOf(held - 1).bearer = 0;
        held = 0;
      }
  Moved(entity);
}

void PlaneRobots::Raise(std::span<const std::uint32_t> owned, std::span<double> poses) const
{
  for (const Lifted& lifted : lifted_)
  {
    if (lifted.height == 0) continue;
    const auto at = std::lower_bound(owned.begin(), owned.end(), lifted.entity) - owned.begin();
    for (std::size_t axis = 0; axis < 3; ++axis)
      poses[axis * owned.size() + static_cast<std::size_t>(at)] += lifted.height * up_[static_cast<int>(axis)];
  }
}

void PlaneRobots::Report(AttributeChanges& changes) const
{
  const SparseVector<double>& known = space_->Attributes();
  const auto report = [&](std::uint32_t slot, double value)
  {
    if (known[slot] != value) changes.Add(slot, value);
  };
  for (const Magnet& magnet : magnets_)
    report(space_->GetEntity(magnet.entity).SlotOf("attached"),
           std::binary_search(attached_.begin(), attached_.end(), magnet.entity) ? 1 : 0);
  for (const Jointed& robot : jointed_)
  {
    const CSwarmanoidSpaceEntity& entity = space_->GetEntity(robot.entity);
    for (std::size_t joint = 0; joint < robot.positions.size(); ++joint)
      report(entity.SlotOf((*robot.links)[joint].attribute), robot.positions[joint]);
  }
  for (const Handbot& handbot : handbots_)
  {
    const CSwarmanoidSpaceEntity& entity = space_->GetEntity(handbot.entity);
    report(entity.SlotOf("head_angle"), handbot.head);
    for (int k = 0; k < 2; ++k)
    {
      report(entity.SlotOf("arm", k), handbot.arm[k]);
      report(entity.SlotOf("wrist", k), handbot.wrist[k]);
      report(entity.SlotOf("hand_aperture", k), handbot.aperture[k]);
      report(entity.SlotOf("gripped", k), handbot.held[k]);
    }
    report(entity.SlotOf("rope_attached"), handbot.is_hanging ? 1 : 0);
    report(entity.SlotOf("rope_length"), handbot.rope);
  }
}

// The state has no commands, since each tick brings new ones.
void PlaneRobots::SaveState(ByteWriter& state) const
{
  for (const Handbot& handbot : handbots_)
  {
    for (const double value : {handbot.head, handbot.arm[0], handbot.arm[1], handbot.wrist[0], handbot.wrist[1],
                               handbot.aperture[0], handbot.aperture[1], handbot.rope})
      state.Put(value);
    for (const std::uint32_t held : handbot.held) state.Put(held);
    state.Put(handbot.is_hanging);
  }
  for (const Lifted& lifted : lifted_)
  {
    state.Put(lifted.height);
    state.Put(lifted.fall);
    state.Put(lifted.bearer);
    state.Put(lifted.above_bearer);
  }
  for (const Jointed& robot : jointed_)
    for (const double position : robot.positions) state.Put(position);
}

void PlaneRobots::LoadState(ByteReader& state)
{
  // Reads 1 + an entity of lifted_, or 0.
  const auto lifted_number = [&]
  {
    const auto number = state.Get<std::uint32_t>();
    const auto is_it = [&](const Lifted& lifted) { return lifted.entity + 1 == number; };
    if (number != 0 && std::none_of(lifted_.begin(), lifted_.end(), is_it))
      throw std::runtime_error("saved state: a hand holds an entity that the engine does not have");
    return number;
  };
  for (Handbot& handbot : handbots_)
  {
    for (double* const value : {&handbot.head, &handbot.arm[0], &handbot.arm[1], &handbot.wrist[0], &handbot.wrist[1],
                                &handbot.aperture[0], &handbot.aperture[1], &handbot.rope})
      *value = state.Get<double>();
    for (std::uint32_t& held : handbot.held) held = lifted_number();
    handbot.is_hanging = state.Get<bool>();
  }
  for (Lifted& lifted : lifted_)
  {
    lifted.height = state.Get<double>();
    lifted.fall = state.Get<double>();
    lifted.bearer = lifted_number();
    lifted.above_bearer = state.Get<double>();
  }
  for (Jointed& robot : jointed_)
    for (double& position : robot.positions) position = state.Get<double>();
}

}  // namespace swarmanoid
