#include "engine_worker/engines/dynamics3d/links.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace swarmanoid::dynamics3d
{

bool JoinsTwoEntities(const LinkSpec& spec)
{
  return spec.kind != ELink::kRope && spec.body_b >= 0 && spec.entity_b != kNoEntity;
}

Link::Link(OdeWorld& world, const LinkSpec& spec, std::uint32_t serial) : world_(world), spec_(spec), serial_(serial)
{
  pose_a_ = RawPoseOf(world_.Body(spec_.body_a));
  if (spec_.body_b >= 0) pose_b_ = RawPoseOf(world_.Body(spec_.body_b));
}

Link::~Link() { DestroyJoint(); }

void Link::DestroyJoint()
{
  if (joint_ != nullptr) dJointDestroy(joint_);
  joint_ = nullptr;
}

void Link::CreateJoint()
{
  const dBodyID a = world_.Body(spec_.body_a);
  const dBodyID b = spec_.body_b >= 0 ? world_.Body(spec_.body_b) : nullptr;
  const RawPose now_a = RawPoseOf(a);
  const RawPose now_b = b != nullptr ? RawPoseOf(b) : RawPose();
  SetRawPose(a, pose_a_);
  if (b != nullptr) SetRawPose(b, pose_b_);
  const dWorldID world = dBodyGetWorld(a);
  const double* p = spec_.anchor;
  switch (spec_.kind)
  {
    case ELink::kHinge:
      joint_ = dJointCreateHinge(world, nullptr);
      dJointAttach(joint_, a, b);
      dJointSetHingeAnchor(joint_, p[0], p[1], p[2]);
      dJointSetHingeAxis(joint_, spec_.axis[0], spec_.axis[1], spec_.axis[2]);
      dJointSetHingeParam(joint_, dParamFMax, spec_.motor_torque);
      dJointSetHingeParam(joint_, dParamVel, 0);
      break;
    case ELink::kFixed:
      joint_ = dJointCreateFixed(world, nullptr);
      dJointAttach(joint_, a, b);
      dJointSetFixed(joint_);
      break;
    case ELink::kRope:
      joint_ = dJointCreateDBall(world, nullptr);
      dJointAttach(joint_, a, b);
      dJointSetDBallAnchor1(joint_, p[0], p[1], p[2]);
      dJointSetDBallAnchor2(joint_, spec_.other[0], spec_.other[1], spec_.other[2]);
      first_length_ = dJointGetDBallDistance(joint_);
      if (length_ < 0) length_ = first_length_;
      dJointSetDBallDistance(joint_, length_);
      break;
  }
  SetRawPose(a, now_a);
  if (b != nullptr) SetRawPose(b, now_b);
  dJointSetFeedback(joint_, &feedback_);
}

void Link::SetMotorSpeed(double speed) { dJointSetHingeParam(joint_, dParamVel, -speed); }

double Link::HingeSpeed() const { return -dJointGetHingeAngleRate(joint_); }

void Link::SetLength(double length)
{
  length_ = length;
  dJointSetDBallDistance(joint_, length);
}

double Link::AnchorDistance() const
{
  dVector3 a;
  dVector3 b;
  dJointGetDBallAnchor1(joint_, a);
  dJointGetDBallAnchor2(joint_, b);
  return std::sqrt((VectorOf(a) - VectorOf(b)).squaredNorm());
}

void Link::TightenOrSlacken()
{
  taut_ = AnchorDistance() >= length_ - 1e-9;
  if (taut_)
    dJointEnable(joint_);
  else
    dJointDisable(joint_);
}

Link& LinkTable::Add(const LinkSpec& spec)
{
  links_.push_back(std::make_unique<Link>(world_, spec, next_serial_++));
  IgnorePair(spec);
  return *links_.back();
}

void LinkTable::CreateJoints()
{
  for (const auto& link : links_)
    if (link->joint_ == nullptr) link->CreateJoint();
}

void LinkTable::IgnorePair(const LinkSpec& spec)
{
  if (JoinsTwoEntities(spec)) world_.Ignore(spec.entity_a, spec.entity_b);
}

Link* LinkTable::Find(std::uint32_t serial)
{
  return const_cast<Link*>(static_cast<const LinkTable*>(this)->Find(serial));
}

const Link* LinkTable::Find(std::uint32_t serial) const
{
  for (const auto& link : links_)
    if (link->serial_ == serial) return link.get();
  return nullptr;
}

void LinkTable::Erase(std::size_t k)
{
  const LinkSpec& spec = links_[k]->spec_;
  if (JoinsTwoEntities(spec)) world_.Respect(spec.entity_a, spec.entity_b);
  links_.erase(links_.begin() + static_cast<std::ptrdiff_t>(k));
}

void LinkTable::Remove(std::uint32_t serial)
{
  for (std::size_t k = 0; k < links_.size(); ++k)
  {
    if (links_[k]->serial_ != serial) continue;
    Erase(k);
    return;
  }
}

void LinkTable::Mark(std::vector<std::uint8_t>& has_links) const
{
  for (const auto& link : links_)
    for (const std::uint32_t entity : {link->Spec().entity_a, link->Spec().entity_b})
      if (entity < has_links.size()) has_links[entity] = 1;
}

bool LinkTable::AreConnected(std::uint32_t a, std::uint32_t b) const
{
  std::vector<std::uint32_t> reached{a};
  for (std::size_t k = 0; k < reached.size(); ++k)
  {
    if (reached[k] == b) return true;
    for (const auto& link : links_)
    {
      if (!JoinsTwoEntities(link->spec_)) continue;
      const std::uint32_t x = link->spec_.entity_a;
      const std::uint32_t y = link->spec_.entity_b;
      if (x != reached[k] && y != reached[k]) continue;
      const std::uint32_t next = x == reached[k] ? y : x;
      if (std::find(reached.begin(), reached.end(), next) == reached.end()) reached.push_back(next);
    }
  }
  return false;
}

void LinkTable::SaveLink(const Link& link, ByteWriter& state)
{
  state.Put(link.serial_);
  const LinkSpec& spec = link.spec_;
  state.Put(spec.kind);
  state.Put(spec.body_a);
  state.Put(spec.body_b);
  state.Put(spec.entity_a);
  state.Put(spec.entity_b);
  state.Put(spec.anchor);
  state.Put(spec.axis);
  state.Put(spec.other);
  state.Put(spec.motor_torque);
  state.Put(link.pose_a_);
  state.Put(link.pose_b_);
  if (spec.kind == ELink::kRope) state.Put(link.length_);
}

std::unique_ptr<Link> LinkTable::LoadLink(ByteReader& state) const
{
  const auto serial = state.Get<std::uint32_t>();
  LinkSpec spec;
  spec.kind = state.Get<ELink>();
  spec.body_a = state.Get<int>();
  spec.body_b = state.Get<int>();
  spec.entity_a = state.Get<std::uint32_t>();
  spec.entity_b = state.Get<std::uint32_t>();
  for (double* values : {spec.anchor, spec.axis, spec.other})
    for (int i = 0; i < 3; ++i) values[i] = state.Get<double>();
  spec.motor_torque = state.Get<double>();
  const auto pose_a = state.Get<RawPose>();
  const auto pose_b = state.Get<RawPose>();
  const double length = spec.kind == ELink::kRope ? state.Get<double>() : -1;

  const auto bodies = static_cast<int>(world_.BodyCount());
  if (spec.kind > ELink::kRope || spec.body_a < 0 || spec.body_a >= bodies || spec.body_b < -1 || spec.body_b >= bodies)
    throw std::runtime_error("saved state: a grip names a body that the engine does not have");
  auto link = std::make_unique<Link>(world_, spec, serial);
  link->pose_a_ = pose_a;
  link->pose_b_ = pose_b;
  link->length_ = length;
  return link;
}

void LinkTable::Save(ByteWriter& state) const
{
  state.Put(next_serial_);
  state.Put(static_cast<std::uint64_t>(links_.size()));
  for (const auto& link : links_) SaveLink(*link, state);
}

void LinkTable::Load(ByteReader& state)
{
  while (!links_.empty()) Erase(links_.size() - 1);
  next_serial_ = state.Get<std::uint32_t>();
  const auto count = state.Get<std::uint64_t>();
  for (std::uint64_t k = 0; k < count; ++k)
  {
    links_.push_back(LoadLink(state));
    IgnorePair(links_.back()->spec_);
  }
}

void LinkTable::Follow(std::size_t count, ByteReader& state)
{
  // Serials ascend in both lists.
  std::size_t place = 0;
  for (std::size_t k = 0; k < count; ++k, ++place)
  {
    std::unique_ptr<Link> link = LoadLink(state);
    while (place < links_.size() && links_[place]->serial_ < link->serial_) Erase(place);
    if (place < links_.size() && links_[place]->serial_ == link->serial_)
    {
      links_[place]->FollowLength(link->length_);
      continue;
    }
    IgnorePair(link->spec_);
    links_.insert(links_.begin() + static_cast<std::ptrdiff_t>(place), std::move(link));
  }
  while (links_.size() > place) Erase(links_.size() - 1);
}

}  // namespace swarmanoid::dynamics3d
