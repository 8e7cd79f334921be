// Converts the arena of a file of ARGoS3, with all its entities.
#pragma once

#include <map>
#include <set>
#include <string>

#include "argos3/converter/counted_bodies.h"
#include "argos3/converter/device_names.h"
#include "argos3/converter/node_reader.h"

namespace swarmanoid::argos3
{

class ArenaConverter : NodeReader
{
public:
  // Reads the parts of `arena` that other parts of the file need.
  ArenaConverter(const ConfigurationNode& arena, ConvertedExperiment& result);

  void Convert(ConfigurationNode& ours);

  // Returns the offset of positions, in m.
  const Vector3& Origin() const { return origin_; }
  // Returns the id of a floor that loop functions paint; empty: there is none.
  const std::string& FloorId() const { return floor_id_; }
  // Returns the properties of the robots that have a controller of that id.
  const Bearers& BearersOf(const std::string& controller) { return bearers_[controller]; }
  // Call it before Convert. Keeps robots of a controller outside the arena until loop functions add them.
  void KeepSpare(const std::string& controller, const std::string& kind, int quantity);
  void KeepSpareLights(int quantity) { spare_lights_ = quantity; }
  void KeepMadeBodies(const MadeBodies& bodies) { made_bodies_ = bodies; }
  // Returns the id of their <reserve>; empty: there are none.
  std::string SpareOf(const std::string& controller) const
  {
    return spares_.contains(controller) ? "added_" + controller : "";
  }
  // Call them after Convert. They return our tags of entities in the arena, and the distributed entities.
  const std::set<std::string>& Kinds() const { return kinds_; }
  const std::string& Distributed() const { return distributed_; }
  const SourceLocation& Location() const { return arena_.location; }

private:
  void ReadFloor(const ConfigurationNode* floor);
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
  static std::string KindOf(const std::string& tag);
  // `id`: our id. `placed`: the entity has its own position; otherwise <distribute> gives it one.
  void ConvertEntity(const ConfigurationNode& theirs, const std::string& id, ConfigurationNode& parent, bool placed);
  // Returns our id of an entity of <distribute>. In ARGoS3, several of them may have the same prefix, or an empty one.
  std::string OurIdOfDistributed(const ConfigurationNode& what, long long first);
  void AddSpares(ConfigurationNode& parent);
  void AddMadeBodies(ConfigurationNode& parent);
  // Returns the colour of its LEDs in our notation.
  std::string ColourOfLeds(const ConfigurationNode& leds);
  void SetMovable(const ConfigurationNode& theirs, ConfigurationNode& made);
  void SetPlace(const ConfigurationNode& theirs, ConfigurationNode& made, double lift);
  void ConvertDistribute(const ConfigurationNode& theirs, ConfigurationNode& parent);
  // `lift`: added to the heights, m.
  void ConvertPositions(const ConfigurationNode& theirs, ConfigurationNode& made, double lift);
  // Converts Euler angles. ARGoS3's order is z, y, x; only rotations about z are the same in both orders.
  void ConvertOrientations(const ConfigurationNode& theirs, ConfigurationNode& made);

  const ConfigurationNode& arena_;
  std::string floor_id_;
  Vector3 low_ = Vector3::Zero();
  Vector3 high_ = Vector3::Zero();
  Vector3 origin_ = Vector3::Zero();
  std::map<std::string, Bearers> bearers_;  // by controller
  std::set<std::string> kinds_;
  int spare_lights_ = 0;
  MadeBodies made_bodies_;
  std::map<std::string, std::pair<std::string, int>> spares_;  // by controller: kind and quantity
  std::string distributed_;
  std::set<std::string> distributed_ids_;  // our ids
};

}  // namespace swarmanoid::argos3
