// The scene: what there is to draw of a space, without any graphics library. A stable list of items (a part of a robot,
// a wall, a patch of floor), and marks that change with each tick (beams, trails, labels). Every renderer holds one and
// calls Update before it draws. One thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/plugin_descriptions/led_cones.h"
#include "common/space/collision_models.h"
#include "common/space/query.h"
#include "visualiser/scene/drawn_marks.h"
#include "visualiser/scene/meshes.h"
#include "visualiser/scene/proximity_rays.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

inline constexpr std::uint32_t kNoEntity = 0xffffffff;

struct SceneItem
{
  enum class Role : std::uint8_t
  {
    kBody,   // throws a shadow
    kWall,   // at the edge of the arena: no shadow, and glass if it hides the arena (picking.h)
    kPatch,  // a painted area just above the floor: takes shadows, throws none
    kFloor   // of the arena
  };

  std::uint32_t entity = kNoEntity;
  std::uint16_t model = 0;  // into Scene::Models()
  Role role = Role::kBody;
  bool present = true;  // false while its entity is not in the arena: not drawn
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  Eigen::Vector3f scale = Eigen::Vector3f::Ones();  // along the axes of the model, before it is turned
  Colour tint = 0xffffff;                           // of Material::kTint
  std::int32_t lights = -1;                         // the first of kLightsPerRobot colours in Scene::Lights(), -1: none
};

// A straight line, as wide as it looks in pixels; its opacity goes from one end to the other.
struct SceneLine
{
  Eigen::Vector3f from, to;
  Colour colour;
  float width;  // pixels
  float opacity_from, opacity_to;
  bool on_top = false;  // drawn over what is in front of it
};

// A soft light spot: of a laser on a surface (flat), or about a lamp.
struct SceneGlow
{
  Eigen::Vector3f position;
  float radius;  // m
  Colour colour;
  bool flat;
};

struct SceneLabel
{
  std::uint32_t entity;
  Eigen::Vector3f position;
  std::string_view text;
};

struct SceneOptions
{
  bool ids = false;
  std::span<const std::string> names;  // what labels say, by entity; empty: the ids
  bool trails = false;
  bool rays = false;  // of proximity sensors, and the cones of directional LEDs that are lit
  bool collision_models = false;
  bool beams = true;
  std::optional<std::uint32_t> selected;  // an entity: marked, with its id, and its rays if `rays` is off
};

class Scene
{
public:
  // Reads the terrains, the meshes and the pictures of the floor; throws ConfigurationError for those. The space
  // outlives the scene.
  explicit Scene(const CSwarmanoidSpace& space);
  ~Scene();

  // Brings items and marks to the present state of the space.
  void Update(const SceneOptions& options);
  // For states that are not drawn: notes where everything is, so that trails miss nothing. Much cheaper than Update.
  void Track();
  // Trails begin anew: the state is not one that came after the last.
  void ForgetTrails();

  const CSwarmanoidSpace& Space() const { return space_; }
  // The standard models, then those of users' kinds and terrains.
  std::span<const Model> Models() const { return models_; }
  // Items never change their number, entity, model or role. Those of one entity stand together.
  std::span<const SceneItem> Items() const { return items_; }
  // 0xRRGGBB, 0 if a light is off.
  std::span<const Colour> Lights() const { return lights_; }
  std::span<const SceneLine> Lines() const { return lines_; }
  std::span<const SceneGlow> Glows() const { return glows_; }
  std::span<const SceneLabel> Labels() const { return labels_; }
  // What experiment functions draw.
  const DrawnMarks& Drawn() const { return drawn_; }

  // Of the arena, in metres.
  const Vector3& ArenaSize() const;
  // What holds all bodies that are in the arena, and its floor.
  void Bounds(Vector3& low, Vector3& high) const;

private:
  // Where an entity's items and attributes are.
  struct Body
  {
    std::uint32_t entity;
    std::uint32_t first_item;
    std::uint32_t first_slot;
    std::int32_t lights;
    std::uint32_t items;
    float lift;  // m above its place: of patches, so that the one that counts lies on top of those it overlaps
    EntityKind kind;
    Mechanism mechanism;
    std::int32_t cones = -1;  // of its LEDs, in led_cones_; -1: they are seen from all sides
  };
  struct Trail;
  // Where the attributes of a kind are that are shown, -1: none.
  struct Slots
  {
    int led, leds, beacon, colour, intensity;
    int aperture, turret, gripped;  // Mechanism::kTurretGripper
    int head, arm, wrist, hand, rope;
    int laser;
  };

  void AddEntity(std::uint32_t entity);
  SceneItem& AddItem(std::uint32_t entity, ModelId model);
  void AddUsersEntity(Body& body);
  // Of an object that has a mesh of its own; false for others.
  bool AddMeshOfObject(std::uint32_t entity);
  const Slots& SlotsOf(const Body& body) const { return slots_[static_cast<std::size_t>(body.kind)]; }
  std::int32_t AddLights();
  void AddTerrain(std::uint32_t entity);
  void AddArea(std::uint32_t entity);

  void UpdateBodies();
  void UpdateLights();
  void PlaceFootbot(const Body& body);
  void PlaceEyebot(const Body& body);
  void PlaceHandbot(const Body& body);
  void Place(std::uint32_t item, const Eigen::Isometry3f& place);

  void AddBeam(const Body& eyebot);
  void AddRope(const Body& handbot);
  void AddGrips(const Body& robot);
  void AddRays(std::uint32_t robot);
  void AddLedCones(const Body& robot);
  // Over all else: the plain body, and what the engine collides.
  void AddOutline(std::uint32_t entity, Colour colour, float width);
  void AddCollisionModel(std::uint32_t entity);
  void AddOutline(bool is_cylinder, const Pose& centre, const Vector3& half_size, Colour colour, float width);
  void AddLine(const Vector3& from, const Vector3& to, Colour colour, float width, float opacity, bool on_top = false);
  void AddTrails();
  // The fraction of the way to the first body but one, whatever its engine; 1 if there is none.
  double FirstHit(const Vector3& from, const Vector3& to, std::uint32_t without);
  double Attribute(const Body& body, int offset) const;

  const CSwarmanoidSpace& space_;
  std::vector<Model> models_;
  std::vector<SceneItem> items_;
  std::vector<Colour> lights_;
  std::vector<Slots> slots_;                            // by kind
  std::map<EntityKind, std::uint16_t> users_models_;    // of users' kinds, once an entity has one
  std::map<std::string, std::uint16_t> object_models_;  // by the names of the models
  std::vector<Body> bodies_;                            // all entities that have items, ascending
  std::vector<SceneLine> lines_;
  std::vector<SceneGlow> glows_;
  std::vector<SceneLabel> labels_;
  DrawnMarks drawn_;
  std::vector<std::pair<std::uint32_t, std::shared_ptr<const Terrain>>> terrains_;
  std::vector<std::uint32_t> large_;                     // bodies too large for the search about a line
  double search_radius_ = 0;                             // of the largest of the others
  std::uint32_t areas_ = 0;                              // patches and holes
  std::map<std::uint32_t, std::vector<Colour>> paints_;  // of patches with a picture: of their items
  // Made when first needed.
  std::unique_ptr<SpaceQuery> query_;
  std::unique_ptr<CollisionModels> collision_models_;
  std::vector<CollisionBody> collision_bodies_;
  std::vector<ProximityRay> rays_;
  std::vector<LedCones> led_cones_;  // of robots with directional LEDs
  std::unique_ptr<Trail[]> trails_;  // of the movable entities, once shown
  std::uint64_t revision_ = 0;
  std::uint64_t attribute_revision_ = 0;
};

}  // namespace swarmanoid
