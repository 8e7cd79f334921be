#include "visualiser/scene/scene.h"

#include <numbers>

#include "common/space/attributes.h"
#include "visualiser/scene/picking.h"
#include "visualiser/scene/trail.h"

namespace swarmanoid
{
namespace
{

using J = RobotJoints;
using Eigen::AngleAxisf;
using Eigen::Isometry3f;
using Eigen::Translation3f;
using Eigen::Vector3f;

constexpr Colour kPlainColour = 0xc0c0c0;  // of a block that has none of its own
constexpr double kLargeBody = 1;           // m: beyond it bodies are tested one by one
constexpr float kLayer = 0.0003F;          // m between one area of the floor and the next
constexpr std::uint32_t kLayers = 40;

struct FootbotSlots
{
  int led = AttributeOffset(EntityKind::kFootbot, "led");
  int beacon = AttributeOffset(EntityKind::kFootbot, "beacon");
  int aperture = AttributeOffset(EntityKind::kFootbot, "gripper_aperture");
  int turret = AttributeOffset(EntityKind::kFootbot, "turret_angle");
};

struct HandbotSlots
{
  int led = AttributeOffset(EntityKind::kHandbot, "led");
  int beacon = AttributeOffset(EntityKind::kHandbot, "beacon");
  int head = AttributeOffset(EntityKind::kHandbot, "head_angle");
  int arm = AttributeOffset(EntityKind::kHandbot, "arm");
  int wrist = AttributeOffset(EntityKind::kHandbot, "wrist");
  int hand = AttributeOffset(EntityKind::kHandbot, "hand_aperture");
};

Isometry3f PlaceOf(const Pose& pose)
{
  return Translation3f(pose.position.cast<float>()) * Eigen::Quaternionf(pose.orientation.cast<float>());
}

AngleAxisf About(const Vector3f& axis, double angle) { return AngleAxisf(static_cast<float>(angle), axis); }

std::uint16_t Number(ModelId model) { return static_cast<std::uint16_t>(model); }

}  // namespace

Scene::Scene(const CSwarmanoidSpace& space) : space_(space), models_(StandardModels())
{
  const Vector3f arena = ArenaSize().cast<float>();
  SceneItem& floor = AddItem(kNoEntity, ModelId::kRectangle);
  floor.role = SceneItem::Role::kFloor;
  floor.position = {arena.x() / 2, arena.y() / 2, 0};
  floor.scale = {arena.x(), arena.y(), 1};
  floor.tint = palette::kFloor;

  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    AddEntity(e);
    const Shape shape = ShapeOf(space.GetEntity(e).GetConfiguration());
    if (shape.kind == Shape::Kind::kNone) continue;
    const double radius = shape.centre.norm() + BoundingRadius(shape);
    if (radius > kLargeBody)
      large_.push_back(e);
    else
      search_radius_ = std::max(search_radius_, radius);
  }
}

Scene::~Scene() = default;

SceneItem& Scene::AddItem(std::uint32_t entity, ModelId model)
{
  SceneItem& item = items_.emplace_back();
  item.entity = entity;
  item.model = Number(model);
  return item;
}

std::int32_t Scene::AddLights()
{
  const std::size_t first = lights_.size();
  lights_.resize(first + kLightsPerRobot, 0);
  return static_cast<std::int32_t>(first);
}

void Scene::AddEntity(std::uint32_t entity)
{
  const CSwarmanoidSpaceEntity& e = space_.GetEntity(entity);
  const EntityConfiguration& configuration = e.GetConfiguration();
  const Vector3f size = configuration.size.cast<float>();
  Body body{entity, static_cast<std::uint32_t>(items_.size()), e.FirstSlot(), -1, 0, 0};
  switch (configuration.kind)
  {
    case EntityKind::kFootbot:
    case EntityKind::kEyebot:
    case EntityKind::kHandbot:
      body.lights = AddLights();
      for (const RestingPart& part : RestingParts(configuration.kind)) AddItem(entity, part.model).lights = body.lights;
      break;
    case EntityKind::kBlock:
    case EntityKind::kWall:
    {
      SceneItem& item = AddItem(entity, ModelId::kBox);
      item.scale = size;
      if (IsBoundaryWall(configuration, ArenaSize())) item.role = SceneItem::Role::kWall;
      break;
    }
    case EntityKind::kCylindricPrey:
      AddItem(entity, ModelId::kCylinder).scale = size;
      break;
    case EntityKind::kLightBulb:
      body.lights = AddLights();
      AddItem(entity, ModelId::kLightBulb).lights = body.lights;
      break;
    case EntityKind::kSoundSource:
      AddItem(entity, ModelId::kSoundSource);
      break;
    case EntityKind::kGroundPatch:
    case EntityKind::kHole:
      body.lift = kLayer * static_cast<float>(areas_++ % kLayers);
      AddArea(entity);
      break;
    case EntityKind::kTerrain:
      AddTerrain(entity);
      break;
  }
  body.items = static_cast<std::uint32_t>(items_.size()) - body.first_item;
  bodies_.push_back(body);
}

void Scene::AddArea(std::uint32_t entity)
{
  const EntityConfiguration& configuration = space_.GetEntity(entity).GetConfiguration();
  const Vector3f size = configuration.size.cast<float>();
  const bool disc = size.y() == 0;
  SceneItem& item = AddItem(entity, disc ? ModelId::kDisc : ModelId::kRectangle);
  item.role = SceneItem::Role::kPatch;
  item.scale = disc ? Vector3f(size.x(), size.x(), 1) : Vector3f(size.x(), size.y(), 1);
  item.tint = palette::kHole;
}

void Scene::AddTerrain(std::uint32_t entity)
{
  const EntityConfiguration& configuration = space_.GetEntity(entity).GetConfiguration();
  terrains_.emplace_back(entity, LoadTerrain(configuration, space_.GetExperiment().folder));
  models_.push_back(TerrainModel(*terrains_.back().second, "terrain_" + configuration.id));
  SceneItem& item = AddItem(entity, ModelId::kBox);
  item.model = static_cast<std::uint16_t>(models_.size() - 1);
  item.tint = palette::kTerrain;
}

void Scene::Update(const SceneOptions& options)
{
  const bool moved = revision_ != space_.Revision();
  const bool changed = attribute_revision_ != space_.AttributeRevision();
  revision_ = space_.Revision();
  attribute_revision_ = space_.AttributeRevision();
  if (changed) UpdateLights();
  if (moved || changed) UpdateBodies();

  lines_.clear();
  glows_.clear();
  labels_.clear();
  for (const Body& body : bodies_)
  {
    if (!space_.IsPresent(body.entity)) continue;
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(body.entity);
    const EntityKind kind = entity.GetKind();
    if (kind == EntityKind::kEyebot && options.beams) AddBeam(body);
    if (kind == EntityKind::kHandbot) AddRope(body);
    if (kind == EntityKind::kFootbot || kind == EntityKind::kHandbot) AddGrips(body);
    if (kind == EntityKind::kLightBulb && lights_[static_cast<std::size_t>(body.lights)] != 0)
      glows_.push_back(
          {entity.GetPosition().cast<float>(), 0.35F, lights_[static_cast<std::size_t>(body.lights)], false});
    const bool selected = options.selected == body.entity;
    if (kind == EntityKind::kFootbot && (options.rays || selected)) AddRays(body.entity);
    if (options.collision_models) AddOutline(body.entity, palette::kCollision, 1.5F, true);
    if (selected) AddOutline(body.entity, palette::kSelection, 2.5F, true);
    if ((options.ids && entity.IsMovable()) || selected)
    {
      Vector3f top = entity.GetPosition().cast<float>();
      top.z() += static_cast<float>(kind == EntityKind::kFootbot ? 0.33 : entity.GetSize().z() + 0.06);
      labels_.push_back(
          {body.entity, top, options.names.empty() ? std::string_view(entity.GetId()) : options.names[body.entity]});
    }
  }
  if (options.trails || trails_ != nullptr) Track();
  if (options.trails) AddTrails();
}

void Scene::UpdateLights()
{
  static const FootbotSlots footbot;
  static const HandbotSlots handbot;
  static const int eyebot_led = AttributeOffset(EntityKind::kEyebot, "led");
  for (const Body& body : bodies_)
  {
    const EntityKind kind = space_.GetEntity(body.entity).GetKind();
    const auto light = [&](int number, int offset)
    { lights_[static_cast<std::size_t>(body.lights + number)] = static_cast<Colour>(Attribute(body, offset)); };
    if (kind == EntityKind::kFootbot)
    {
      for (int i = 0; i < CFootBotEntity::kLeds; ++i) light(i, footbot.led + i);
      light(kBeaconLight, footbot.beacon);
    }
    else if (kind == EntityKind::kEyebot)
    {
      for (int i = 0; i < CEyeBotEntity::kLeds; ++i) light(i, eyebot_led + i);
    }
    else if (kind == EntityKind::kHandbot)
    {
      for (int i = 0; i < CHandBotEntity::kLeds; ++i) light(i, handbot.led + i);
      light(kBeaconLight, handbot.beacon);
    }
    else if (kind == EntityKind::kLightBulb)
    {
      const bool on = Attribute(body, AttributeOffset(kind, "intensity")) > 0;
      light(0, AttributeOffset(kind, "colour"));
      if (!on) lights_[static_cast<std::size_t>(body.lights)] = 0;
    }
    else if (const int colour = AttributeOffset(kind, "colour"); colour >= 0)
    {
      SceneItem& item = items_[body.first_item];
      const auto given = static_cast<Colour>(Attribute(body, colour));
      const bool plain_wall = item.role == SceneItem::Role::kWall && given == kPlainColour;
      item.tint = plain_wall ? palette::kWall : Paint(given);
    }
  }
}

void Scene::UpdateBodies()
{
  for (const Body& body : bodies_)
  {
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(body.entity);
    const bool present = space_.IsPresent(body.entity);
    for (std::uint32_t i = 0; i < body.items; ++i) items_[body.first_item + i].present = present;
    if (!present) continue;
    switch (entity.GetKind())
    {
      case EntityKind::kFootbot:
        PlaceFootbot(body);
        break;
      case EntityKind::kEyebot:
        PlaceEyebot(body);
        break;
      case EntityKind::kHandbot:
        PlaceHandbot(body);
        break;
      default:
        Place(body.first_item, PlaceOf(space_.GetPose(body.entity)));
        items_[body.first_item].position.z() += body.lift;
    }
  }
}

void Scene::Place(std::uint32_t item, const Isometry3f& place)
{
  items_[item].position = place.translation();
  items_[item].orientation = Eigen::Quaternionf(place.linear());
}

// In the order of RestingParts.
void Scene::PlaceFootbot(const Body& body)
{
  static const FootbotSlots slots;
  const Pose pose = space_.GetPose(body.entity);
  SceneItem& base = items_[body.first_item];
  base.position = pose.position.cast<float>();
  base.orientation = pose.orientation.cast<float>();
  SceneItem& turret = items_[body.first_item + 1];
  turret.position = base.position;
  turret.orientation = base.orientation;
  if (const double angle = Attribute(body, slots.turret); angle != 0)
    turret.orientation = base.orientation * About(Vector3f::UnitZ(), angle);

  const double aperture = std::abs(Attribute(body, slots.aperture));
  for (std::uint32_t jaw = 0; jaw < 2; ++jaw)
  {
    const float side = jaw == 0 ? 1.0F : -1.0F;
    SceneItem& item = items_[body.first_item + 2 + jaw];
    item.position = turret.position + turret.orientation * Vector3f(J::kFootbotJawForward, side * J::kFootbotJawSide,
                                                                    J::kFootbotJawHeight);
    item.orientation = turret.orientation * About(Vector3f::UnitZ(), side * aperture);
    if (jaw == 1) item.orientation = item.orientation * About(Vector3f::UnitX(), std::numbers::pi);
  }
}

void Scene::PlaceEyebot(const Body& body)
{
  const Isometry3f place = PlaceOf(space_.GetPose(body.entity));
  static const std::vector<RestingPart> parts = RestingParts(EntityKind::kEyebot);
  for (std::uint32_t part = 0; part < parts.size(); ++part) Place(body.first_item + part, place * parts[part].place);
}

void Scene::PlaceHandbot(const Body& body)
{
  static const HandbotSlots slots;
  const Isometry3f place = PlaceOf(space_.GetPose(body.entity));
  std::uint32_t item = body.first_item;
  Place(item++, place);
  const Isometry3f head = place * Translation3f(J::kHandbotHeadForward, 0, J::kHandbotHeadHeight) *
                          About(Vector3f::UnitX(), Attribute(body, slots.head));
  Place(item++, head);
  for (int arm = 0; arm < 2; ++arm)
  {
    const float side = arm == 0 ? 1.0F : -1.0F;
    const Isometry3f shoulder = head * Translation3f(0, side * J::kHandbotShoulder, 0) *
                                About(Vector3f::UnitZ(), side * Attribute(body, slots.arm + arm));
    Place(item++, shoulder);
    const Isometry3f wrist = shoulder * Translation3f(J::kHandbotArmLength, 0, 0) *
                             About(Vector3f::UnitX(), Attribute(body, slots.wrist + arm));
    const double opening = Attribute(body, slots.hand + arm) / 2;
    for (const float finger : {1.0F, -1.0F})
    {
      Isometry3f hinge =
          wrist * Translation3f(0, finger * J::kHandbotFingerSide, 0) * About(Vector3f::UnitZ(), finger * opening);
      if (finger < 0) hinge = hinge * About(Vector3f::UnitX(), std::numbers::pi);
      Place(item++, hinge);
    }
  }
}

void Scene::Bounds(Vector3& low, Vector3& high) const
{
  low = Vector3::Zero();
  high = Vector3(ArenaSize().x(), ArenaSize().y(), 0.3);
  for (const SceneItem& item : items_)
  {
    if (item.role != SceneItem::Role::kBody || !item.present) continue;
    const Eigen::AlignedBox3f& box = models_[item.model].box;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vector3f local = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)).cwiseProduct(item.scale);
      const Vector3 point = (item.position + item.orientation * local).cast<double>();
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
}

}  // namespace swarmanoid
