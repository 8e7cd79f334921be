// Converts the arena of a file of ARGoS3, with all its entities.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "argos3/converter/counted_bodies.h"
#include "argos3/converter/device_names.h"
#include "argos3/converter/node_reader.h"

namespace swarmanoid::argos3
{

// The forces (N) and torques (N m) with which the ground of ARGoS3's dynamics2d resists movable boxes and cylinders at
// most, whatever their mass. The defaults are those of dynamics2d_engine.cpp of ARGoS3.
struct GroundFriction
{
  double box_force = 1.49, box_torque = 1.49;
  double cylinder_force = 1.49, cylinder_torque = 1.49;
};

class ArenaConverter : NodeReader
{
public:
  // Reads the parts of `arena` that other parts of the file need.
  // `controllers`: <controllers>, or nullptr.
  ArenaConverter(const ConfigurationNode& arena, const ConfigurationNode* controllers, ConvertedExperiment& result);

  void Convert(ConfigurationNode& ours);

  // Returns the offset of positions, in m.
  const Vector3& Origin() const { return origin_; }
  // Returns the id of a floor that loop functions paint; empty: there is none.
  const std::string& FloorId() const { return floor_id_; }
  // Call it before Convert, if the file has no loop functions. ARGoS3's default ones have a white floor.
  void PaintFloorWhite();
  // In ARGoS3 attributes and <params> at a robot are its own. Here they belong to controllers. So robots of one
  // controller that differ in them have controllers of their own: the first ones `id`, others id.2, id.3 …
  struct Variant
  {
    std::string id;  // of our controller
    Bearers bearers;
  };
  // Returns one or more variants of a controller.
  const std::vector<Variant>& VariantsOf(const std::string& controller);
  // Returns whether only robots that do not exist here have the controller. Its devices are no further mistakes.
  bool IsOfUnknownRobots(const std::string& controller) const
  {
    return unknown_controllers_.contains(controller) && !variants_.contains(controller);
  }
  // Returns the largest range of a message, m.
  double LargestRadioRange() const { return largest_radio_range_; }
  // Call it before Convert. Keeps robots of a controller outside the arena until loop functions add them.
  void KeepSpare(const std::string& controller, const std::string& kind, int quantity);
  void KeepSpareLights(int quantity) { spare_lights_ = quantity; }
  // Call it before Convert, if the file has an engine dynamics2d.
  void SetGround(const GroundFriction& friction) { ground_ = friction; }
  // Call them before Convert. The media are types and ids.
  void SetPointMasses() { has_point_masses_ = true; }
  void SetMedia(std::set<std::pair<std::string, std::string>> media) { media_ = std::move(media); }
  void KeepMadeBodies(const MadeBodies& bodies) { made_bodies_ = bodies; }
  // Returns the id of their <reserve>; empty: there are none.
  std::string SpareOf(const std::string& controller) const
  {
    return spares_.contains(controller) ? "added_" + controller : "";
  }
  // Call them after Convert. They return our tags of entities in the arena, and the entities with other ids here.
  const std::set<std::string>& Kinds() const { return kinds_; }
  const std::string& Distributed() const { return distributed_; }
  const SourceLocation& Location() const { return arena_.location; }

private:
  void ReadFloor(const ConfigurationNode* floor);
  std::string Expanded(std::string text, const ConfigurationNode::Attribute* attribute);
  // Returns the path, searched like libraries: from the working folder, or from the file's folder.
  std::string PictureOf(const ConfigurationNode& floor);
  // Makes a floor over the whole arena of ARGoS3.
  void ConvertFloor(const ConfigurationNode& theirs, ConfigurationNode& parent);
  // Computes our arena. It starts at 0, 0, 0 and holds all that the file places; its floor is at the same place, at
  // height 0.
  void FindArena();
  // Includes the region in which a <distribute> may place entities.
  void HoldDistributed(const ConfigurationNode& distribute);
  void FindBearers(const ConfigurationNode& within);
  Bearers BearersOf(const ConfigurationNode& robot, const std::string& kind, const ConfigurationNode& controller);
  static std::string KindOf(const std::string& tag);
  // E-pucks are those of ARGoS3, or of argos3-epuck if their controller has a device of it.
  std::string KindOfRobot(const ConfigurationNode& robot);
  void FindDemiurgeEPucks(const std::string& id, const ConfigurationNode& controller);
  // `id` is our id. If `placed` is true, the entity has its own position; otherwise <distribute> gives it one.
  void ConvertEntity(const ConfigurationNode& theirs, const std::string& id, ConfigurationNode& parent, bool placed);
  // Returns our id of an entity. Each id of the file has one.
  std::string OurIdOf(const ConfigurationNode& theirs);
  // Adds the entities that are not distributed and whose ids need a translation.
  void AddTranslations();
  // Returns our id of an entity of <distribute>. In ARGoS3, several of them may have the same prefix, or an empty one.
  std::string OurIdOfDistributed(const ConfigurationNode& what, long long first, long long quantity);
  void AddSpares(ConfigurationNode& parent);
  void AddMadeBodies(ConfigurationNode& parent);
  // Returns the colour of an LED or a light in our notation.
  std::string Colour(const ConfigurationNode& node, const std::string& fallback);
  // Returns the colour of its LEDs in our notation.
  std::string ColourOfLeds(const ConfigurationNode& leds);
  void SetMovable(const ConfigurationNode& theirs, ConfigurationNode& made);
  void SetGroundFriction(const std::string& tag, double mass_kg, const SourceLocation& at, ConfigurationNode& made);
  // `zyx`: ARGoS3's Euler angles, degrees.
  static Quaternion OrientationOf(const Vector3& zyx);
  static Vector3 FixedAngles(const Vector3& zyx);
  void SetPlace(const ConfigurationNode& theirs, ConfigurationNode& made, double lift);
  void ConvertDistribute(const ConfigurationNode& theirs, ConfigurationNode& parent);
  // Converts positions, with `lift` (m) added to the heights.
  void ConvertPositions(const ConfigurationNode& theirs, ConfigurationNode& made, double lift);
  // Converts Euler angles. ARGoS3's order is z, y, x; only rotations about z are the same in our usual order. `tag`:
  // that of what is distributed.
  void ConvertOrientations(const ConfigurationNode& theirs, const std::string& tag, ConfigurationNode& made);
  // Returns whether the engines of the file keep the tilt of an entity, in ARGoS3.
  bool KeepsTilt(const std::string& tag) const;
  void NoteMedium(const ConfigurationNode& node);

  const ConfigurationNode& arena_;
  std::string floor_id_;
  Vector3 low_ = Vector3::Zero();
  Vector3 high_ = Vector3::Zero();
  Vector3 origin_ = Vector3::Zero();
  std::map<std::string, std::vector<Variant>> variants_;                    // by controller
  std::map<std::pair<std::string, std::string>, std::string> variant_ids_;  // by controller and properties
  std::map<const ConfigurationNode*, std::string> controller_of_robot_;
  std::set<std::string> controllers_;              // ids in the file
  std::map<std::string, double> demiurge_epucks_;  // the range of messages, m, by controller
  std::set<std::string> unknown_controllers_;
  double largest_radio_range_ = 0.001;
  std::set<std::string> kinds_;
  int spare_lights_ = 0;
  std::optional<GroundFriction> ground_;
  bool has_point_masses_ = false;
  std::set<std::pair<std::string, std::string>> media_;
  MadeBodies made_bodies_;
  std::map<std::string, std::pair<std::string, int>> spares_;  // by controller: kind and quantity
  std::string distributed_;
  std::set<std::string> distributed_ids_;  // our ids
  std::set<std::string> groups_;           // the ids of <distribute>
  std::set<std::string> single_ids_;       // the entities' ids in the file
  std::map<std::string, std::string> our_ids_;
  std::set<std::string> used_ids_;  // our ids of entities
};

}  // namespace swarmanoid::argos3
