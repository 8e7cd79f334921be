// The items are made once, from the kinds of the entities: parts of robots, bodies, walls, areas, terrains. Update then
// changes only poses, colours and presence, and only if the space's revisions have changed. Marks are made again in
// each update. Areas of the floor are lifted by a layer each, in their order, so that later ones cover earlier ones
// without flicker.
#include "visualiser/scene/scene.h"

#include <numbers>

#include "common/space/attributes.h"
#include "common/space/space.h"
#include "visualiser/scene/kind_model.h"
#include "visualiser/scene/object_model.h"
#include "visualiser/scene/painted_floor.h"
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

constexpr Colour kPlainColour = 0xc0c0c0;  // for blocks without a colour
constexpr double kLargeBody = 1;           // m: larger bodies are tested one by one
constexpr float kLayer = 0.0003F;          // m between one area of the floor and the next
constexpr std::uint32_t kLayers = 40;
constexpr int kMostPaintedPixels = 512;  // along an edge of a picture on the floor

Isometry3f PlaceOf(const Pose& pose)
{
  return Translation3f(pose.position.cast<float>()) * Eigen::Quaternionf(pose.orientation.cast<float>());
}

AngleAxisf About(const Vector3f& axis, double angle) { return AngleAxisf(static_cast<float>(angle), axis); }

int FirstJointOf(EntityKind kind)
{
  const std::vector<MovingLink>& links = DescriptionOf(kind).links;
  return links.empty() ? -1 : AttributeOffset(kind, links.front().attribute);
}

std::uint16_t Number(ModelId model) { return static_cast<std::uint16_t>(model); }

}  // namespace

Scene::Scene(const CSwarmanoidSpace& space)
    : space_(space), models_(StandardModels()), drawn_state_(space), scanner_rays_(space)
{
  const Vector3f arena = ArenaSize().cast<float>();
  SceneItem& floor = AddItem(kNoEntity, ModelId::kRectangle);
  floor.role = SceneItem::Role::kFloor;
  floor.position = {arena.x() / 2, arena.y() / 2, 0};
  floor.scale = {arena.x(), arena.y(), 1};
  floor.tint = palette::kFloor;

  for (std::size_t k = 0; k < EntityKindCount(); ++k)
  {
    const auto offset = [&](std::string_view name) { return AttributeOffset(static_cast<EntityKind>(k), name); };
    const AttributeSpec* led = FindAttribute(static_cast<EntityKind>(k), "led");
    slots_.push_back({offset("led"), led == nullptr ? 0 : led->count, offset("beacon"), offset("colour"),
                      offset("intensity"), offset("gripper_aperture"), offset("turret_angle"), offset("gripped"),
                      offset("head_angle"), offset("arm"), offset("wrist"), offset("hand_aperture"),
                      offset("rope_attached"), offset("laser"), FirstJointOf(static_cast<EntityKind>(k))});
  }
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

const Vector3& Scene::ArenaSize() const { return space_.GetExperiment().arena_size; }

double Scene::Attribute(const Body& body, int offset) const
{
  return space_.Attributes()[body.first_slot + static_cast<std::uint32_t>(offset)];
}

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
  const EntityKindDescription& kind = DescriptionOf(configuration.kind);
  Body body{entity,        static_cast<std::uint32_t>(items_.size()), e.FirstSlot(), -1, 0, 0, configuration.kind,
            kind.mechanism};
  switch (kind.role)
  {
    case EntityRole::kRobot:
      if (kind.mechanism == Mechanism::kNone)
      {
        AddUsersEntity(body);
        break;
      }
      body.lights = AddLights();
      for (const RestingPart& part : RestingParts(kind.mechanism)) AddItem(entity, part.model).lights = body.lights;
      break;
    case EntityRole::kObject:
      if (AddMeshOfObject(entity)) break;
      if (!IsBuiltIn(configuration.kind))
      {
        AddUsersEntity(body);
        break;
      }
      AddItem(entity, kind.form == BodyForm::kBox ? ModelId::kBox : ModelId::kCylinder).scale = size;
      if (IsBoundaryWall(configuration, ArenaSize())) items_.back().role = SceneItem::Role::kWall;
      break;
    case EntityRole::kLight:
      body.lights = AddLights();
      AddItem(entity, ModelId::kLightBulb).lights = body.lights;
      break;
    case EntityRole::kSound:
      AddItem(entity, ModelId::kSoundSource);
      break;
    case EntityRole::kPatch:
    case EntityRole::kHole:
      body.lift = kLayer * static_cast<float>(areas_++ % kLayers);
      AddArea(entity);
      break;
    case EntityRole::kTerrain:
      AddTerrain(entity);
      break;
  }
  body.items = static_cast<std::uint32_t>(items_.size()) - body.first_item;
  if (std::optional<LedCones> cones = LedConesOf(space_.GetExperiment(), configuration))
  {
    body.cones = static_cast<std::int32_t>(led_cones_.size());
    led_cones_.push_back(std::move(*cones));
  }
  bodies_.push_back(body);
}

void Scene::AddUsersEntity(Body& body)
{
  const EntityKindDescription& kind = DescriptionOf(body.kind);
  const auto [model, is_new] = users_models_.emplace(body.kind, static_cast<std::uint16_t>(models_.size()));
  if (is_new)
    for (Model& part : LinkModels(kind, space_.GetExperiment())) models_.push_back(std::move(part));
  if (kind.leds) body.lights = AddLights();
  for (std::size_t link = 0; link <= kind.links.size(); ++link)
  {
    SceneItem& item = AddItem(body.entity, ModelId::kBox);
    item.model = static_cast<std::uint16_t>(model->second + link);
    item.tint = Paint(kind.colour);
    if (IsScaled(kind)) item.scale = space_.GetEntity(body.entity).GetSize().cast<float>();
    item.lights = body.lights;
  }
}

bool Scene::AddMeshOfObject(std::uint32_t entity)
{
  const EntityConfiguration& configuration = space_.GetEntity(entity).GetConfiguration();
  const std::string name = ObjectModelName(configuration, space_.GetExperiment().folder);
  if (name.empty()) return false;
  const auto [model, is_new] = object_models_.emplace(name, static_cast<std::uint16_t>(models_.size()));
  if (is_new) models_.push_back(ObjectModel(configuration, space_.GetExperiment().folder));
  SceneItem& item = AddItem(entity, ModelId::kBox);
  item.model = model->second;
  item.scale = configuration.size.cast<float>();
  return true;
}

void Scene::AddArea(std::uint32_t entity)
{
  const EntityConfiguration& configuration = space_.GetEntity(entity).GetConfiguration();
  const Vector3f size = configuration.size.cast<float>();
  if (const auto picture = LoadFloorPicture(configuration, space_.GetExperiment().folder))
  {
    const PaintedFloor floor = Simplified(*picture, kMostPaintedPixels);
    paints_[entity] = floor.palette;
    for (Model& model : FloorModels(floor, "floor_" + configuration.id))
    {
      models_.push_back(std::move(model));
      SceneItem& item = AddItem(entity, ModelId::kRectangle);
      item.model = static_cast<std::uint16_t>(models_.size() - 1);
      item.role = SceneItem::Role::kPatch;
      item.scale = {size.x(), size.y(), 1};
    }
    return;
  }
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
    const EntityKindDescription& kind = DescriptionOf(body.kind);
    const bool is_light = kind.role == EntityRole::kLight;
    if (body.mechanism == Mechanism::kPropellers && options.beams) AddBeam(body);
    if (body.mechanism == Mechanism::kArms) AddRope(body);
    if (kind.grippers > 0) AddGrips(body);
    if (is_light && lights_[static_cast<std::size_t>(body.lights)] != 0)
      glows_.push_back(
          {entity.GetPosition().cast<float>(), 0.35F, lights_[static_cast<std::size_t>(body.lights)], false});
    const bool selected = options.selected == body.entity;
    if (kind.role == EntityRole::kRobot && (options.rays || selected)) AddRays(body.entity);
    if (body.cones >= 0 && (options.rays || selected)) AddLedCones(body);
    if (options.collision_models) AddCollisionModel(body.entity);
    if (selected) AddOutline(body.entity, palette::kSelection, 2.5F);
    if ((options.ids && entity.IsMovable()) || selected)
    {
      Vector3f top = entity.GetPosition().cast<float>();
      top.z() += static_cast<float>(kind.label_height_m > 0 ? kind.label_height_m : entity.GetSize().z() + 0.06);
      labels_.push_back(
          {body.entity, top, options.names.empty() ? std::string_view(entity.GetId()) : options.names[body.entity]});
    }
  }
  if (options.trails || trails_ != nullptr) Track();
  if (options.trails) AddTrails();
  CutDrawing(drawn_state_, drawn_);
}

void Scene::UpdateLights()
{
  for (const Body& body : bodies_)
  {
    const Slots& slots = SlotsOf(body);
    const auto light = [&](int number, int offset)
    { lights_[static_cast<std::size_t>(body.lights + number)] = static_cast<Colour>(Attribute(body, offset)); };
    if (slots.led >= 0)
    {
      for (int i = 0; i < slots.leds; ++i) light(i, slots.led + i);
      if (slots.beacon >= 0) light(kBeaconLight, slots.beacon);
    }
    else if (body.lights >= 0)
    {
      const bool on = Attribute(body, slots.intensity) > 0;
      light(0, slots.colour);
      if (!on) lights_[static_cast<std::size_t>(body.lights)] = 0;
    }
    else if (const auto paint = paints_.find(body.entity); paint != paints_.end())
    {
      const auto tint = static_cast<Colour>(Attribute(body, slots.colour));
      for (std::size_t i = 0; i < body.items; ++i) items_[body.first_item + i].tint = Tinted(paint->second[i], tint);
    }
    else if (slots.colour >= 0)
    {
      SceneItem& item = items_[body.first_item];
      const auto given = static_cast<Colour>(Attribute(body, slots.colour));
      const bool plain_wall = item.role == SceneItem::Role::kWall && given == kPlainColour;
      item.tint = plain_wall ? palette::kWall : Paint(given);
    }
  }
}

void Scene::UpdateBodies()
{
  for (const Body& body : bodies_)
  {
    const bool present = space_.IsPresent(body.entity);
    for (std::uint32_t i = 0; i < body.items; ++i) items_[body.first_item + i].present = present;
    if (!present) continue;
    switch (body.mechanism)
    {
      case Mechanism::kTurretGripper:
        PlaceFootbot(body);
        break;
      case Mechanism::kPropellers:
        PlaceEyebot(body);
        break;
      case Mechanism::kArms:
        PlaceHandbot(body);
        break;
      case Mechanism::kNone:
        if (SlotsOf(body).joint >= 0)
        {
          PlaceLinks(body);
          break;
        }
        for (std::uint32_t i = 0; i < body.items; ++i)
        {
          Place(body.first_item + i, PlaceOf(space_.GetPose(body.entity)));
          items_[body.first_item + i].position.z() += body.lift;
        }
    }
  }
}

void Scene::Place(std::uint32_t item, const Isometry3f& place)
{
  items_[item].position = place.translation();
  items_[item].orientation = Eigen::Quaternionf(place.linear());
}

// The parts are in the order of RestingParts.
void Scene::PlaceFootbot(const Body& body)
{
  const Slots& slots = SlotsOf(body);
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
  static const std::vector<RestingPart> parts = RestingParts(Mechanism::kPropellers);
  for (std::uint32_t part = 0; part < parts.size(); ++part) Place(body.first_item + part, place * parts[part].place);
}

void Scene::PlaceHandbot(const Body& body)
{
  const Slots& slots = SlotsOf(body);
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

// The parts are the base, then the links.
void Scene::PlaceLinks(const Body& body)
{
  const std::vector<MovingLink>& links = DescriptionOf(body.kind).links;
  const Pose pose = space_.GetPose(body.entity);
  std::vector<double> positions;
  for (std::size_t k = 0; k < links.size(); ++k)
    positions.push_back(Attribute(body, SlotsOf(body).joint + static_cast<int>(k)));
  const std::vector<Pose> motions = MotionsOfLinks(links, positions);
  Place(body.first_item, PlaceOf(pose));
  for (std::uint32_t k = 0; k < links.size(); ++k) Place(body.first_item + 1 + k, PlaceOf(pose.Compose(motions[k])));
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
