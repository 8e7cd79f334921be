// The scene: what to draw of a space, without any graphics library. It has a stable list of items (a part of a robot, a
// wall, a patch of floor), and marks that change with each tick (beams, trails, labels). Every renderer owns one and
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
#include "common/space/drawn_state.h"
#include "common/space/space_query.h"
#include "visualiser/scene/drawn_marks.h"
#include "visualiser/scene/meshes.h"
#include "visualiser/scene/proximity_rays.h"
#include "visualiser/scene/scanner_rays.h"

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
    kPatch,  // a painted area just above the floor: takes shadows, but throws none
    kFloor   // the floor of the arena
  };

  std::uint32_t entity = kNoEntity;
  std::uint16_t model = 0;  // into Scene::Models()
  Role role = Role::kBody;
  bool present = true;  // false while its entity is not in the arena: not drawn
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  Eigen::Vector3f scale = Eigen::Vector3f::Ones();  // along the axes of the model, before rotation
  Colour tint = 0xffffff;                           // for Material::kTint
  std::int32_t lights = -1;                         // the first of kLightsPerRobot colours in Scene::Lights(), -1: none
};

// A straight line with a width in pixels; its opacity changes linearly from one end to the other.
struct SceneLine
{
  Eigen::Vector3f from, to;
  Colour colour;
  float width;  // pixels
  float opacity_from, opacity_to;
  bool on_top = false;  // drawn over all bodies
};

// A soft light spot: of a laser on a surface (flat), or around a lamp.
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
  std::span<const std::string> names;  // the texts of labels, by entity; empty: the ids
  bool trails = false;
  bool rays = false;  // rays of proximity sensors and range scanners, and cones of lit directional LEDs
  bool collision_models = false;
  bool beams = true;
  std::optional<std::uint32_t> selected;  // an entity that gets a mark, its id, and its rays if `rays` is off
};

class Scene
{
public:
  // Reads terrains, meshes and pictures of the floor; throws ConfigurationError if one cannot be read. The space must
  // outlive the scene.
  explicit Scene(const CSwarmanoidSpace& space);
  ~Scene();

  // Updates items and marks to the state of the space.
  void Update(const SceneOptions& options);
  // Records the positions in a state that is not drawn, so that trails are complete. It is much cheaper than Update.
  void Track();
  // Starts the trails again, since the state does not follow the last one.
  void ForgetTrails();

  const CSwarmanoidSpace& Space() const { return space_; }
  // Returns the standard models, then those of users' kinds and terrains.
  std::span<const Model> Models() const { return models_; }
  // Returns the items. Their number, entities, models and roles never change. Those of one entity are adjacent.
  std::span<const SceneItem> Items() const { return items_; }
  // Returns colours as 0xRRGGBB; 0 for a light that is off.
  std::span<const Colour> Lights() const { return lights_; }
  std::span<const SceneLine> Lines() const { return lines_; }
  std::span<const SceneGlow> Glows() const { return glows_; }
  std::span<const SceneLabel> Labels() const { return labels_; }
  // Returns parts of the state and drawings of experiment functions.
  const DrawnMarks& Drawn() const { return drawn_; }

  // Returns the size of the arena in metres.
  const Vector3& ArenaSize() const;
  // Returns the bounds of all bodies in the arena, and of its floor.
  void Bounds(Vector3& low, Vector3& high) const;

private:
  // The indices of an entity's items and attributes.
  struct Body
  {
    std::uint32_t entity;
    std::uint32_t first_item;
    std::uint32_t first_slot;
    std::int32_t lights;
    std::uint32_t items;
    float lift;  // m above its position: the patch that counts lies above those that it overlaps
    EntityKind kind;
    Mechanism mechanism;
    std::int32_t cones = -1;  // index in led_cones_ of its LEDs; -1: they are seen from all sides
  };
  struct Trail;
  // The indices of the shown attributes of a kind; -1: none.
  struct Slots
  {
    int led, leds, beacon, colour, intensity;
    int aperture, turret, gripped;  // Mechanism::kTurretGripper
    int head, arm, wrist, hand, rope;
    int laser;
    int joint;  // the first one; the others follow
  };

  void AddEntity(std::uint32_t entity);
  SceneItem& AddItem(std::uint32_t entity, ModelId model);
  void AddUsersEntity(Body& body);
  // Adds the mesh of an object; returns false if it has none.
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
  void PlaceLinks(const Body& body);
  void Place(std::uint32_t item, const Eigen::Isometry3f& place);

  void AddBeam(const Body& eyebot);
  void AddRope(const Body& handbot);
  void AddGrips(const Body& robot);
  void AddRays(std::uint32_t robot);
  void AddLedCones(const Body& robot);
  // Adds the plain body, and the bodies that the engine collides, over all other items.
  void AddOutline(std::uint32_t entity, Colour colour, float width);
  void AddCollisionModel(std::uint32_t entity);
  void AddOutline(bool is_cylinder, const Pose& centre, const Vector3& half_size, Colour colour, float width);
  void AddLine(const Vector3& from, const Vector3& to, Colour colour, float width, float opacity, bool on_top = false);
  void AddTrails();
  // Returns the fraction of the way to the first body except one, in any engine; 1 if it meets none.
  double FirstHit(const Vector3& from, const Vector3& to, std::uint32_t without);
  double Attribute(const Body& body, int offset) const;

  const CSwarmanoidSpace& space_;
  std::vector<Model> models_;
  std::vector<SceneItem> items_;
  std::vector<Colour> lights_;
  std::vector<Slots> slots_;                            // by kind
  std::map<EntityKind, std::uint16_t> users_models_;    // by users' kind that an entity has: the first of its models
  std::map<std::string, std::uint16_t> object_models_;  // by the name of the model
  std::vector<Body> bodies_;                            // all entities with items, ascending
  std::vector<SceneLine> lines_;
  std::vector<SceneGlow> glows_;
  std::vector<SceneLabel> labels_;
  DrawnState drawn_state_;
  DrawnMarks drawn_;
  std::vector<std::pair<std::uint32_t, std::shared_ptr<const Terrain>>> terrains_;
  std::vector<std::uint32_t> large_;                     // bodies too large for the search around a line
  double search_radius_ = 0;                             // radius of the largest other body
  std::uint32_t areas_ = 0;                              // number of patches and holes
  std::map<std::uint32_t, std::vector<Colour>> paints_;  // by patch with a picture: the colours of its items
  // Made at first use.
  std::unique_ptr<SpaceQuery> query_;
  std::unique_ptr<CollisionModels> collision_models_;
  std::vector<CollisionBody> collision_bodies_;
  std::vector<ProximityRay> rays_;
  ScannerRays scanner_rays_;
  std::vector<LedCones> led_cones_;  // by robot with directional LEDs
  std::unique_ptr<Trail[]> trails_;  // by movable entity; made when trails are first shown
  std::uint64_t revision_ = 0;
  std::uint64_t attribute_revision_ = 0;
};

}  // namespace swarmanoid
