// The arena of a file of ARGoS3 with all that stands in it, as ours.
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
  // Reads of `arena` what other parts of the file need.
  ArenaConverter(const ConfigurationNode& arena, ConvertedExperiment& result);

  void Convert(ConfigurationNode& ours);

  // What is added to their places, m.
  const Vector3& Origin() const { return origin_; }
  // Of a floor that loop functions paint; empty: there is none.
  const std::string& FloorId() const { return floor_id_; }
  // The robots that have a controller of that id.
  const Bearers& BearersOf(const std::string& controller) { return bearers_[controller]; }
  // Before Convert: robots of a controller that are not in the arena until loop functions add them.
  void KeepSpare(const std::string& controller, const std::string& kind, int quantity);
  void KeepSpareLights(int quantity) { spare_lights_ = quantity; }
  void KeepMadeBodies(const MadeBodies& bodies) { made_bodies_ = bodies; }
  // The id of their <reserve>; empty: there are none.
  std::string SpareOf(const std::string& controller) const
  {
    return spares_.contains(controller) ? "added_" + controller : "";
  }
  // After Convert: tags of ours that stand in the arena, and entities that are distributed.
  const std::set<std::string>& Kinds() const { return kinds_; }
  const std::string& Distributed() const { return distributed_; }
  const SourceLocation& Location() const { return arena_.location; }

private:
  void ReadFloor(const ConfigurationNode* floor);
  // Found as libraries are: from the working folder, or from that of the file.
  std::string PictureOf(const ConfigurationNode& floor);
  // Over all of their arena.
  void ConvertFloor(const ConfigurationNode& theirs, ConfigurationNode& parent);
  // Ours starts at 0, 0, 0 and holds all that the file places; its floor is where theirs is, at height 0.
  void FindArena();
  // Where a <distribute> may put something.
  void HoldDistributed(const ConfigurationNode& distribute);
  void FindBearers(const ConfigurationNode& within);
  static std::string KindOf(const std::string& tag);
  // `id`: ours. `placed`: with a place of its own; otherwise <distribute> gives it one.
  void ConvertEntity(const ConfigurationNode& theirs, const std::string& id, ConfigurationNode& parent, bool placed);
  // Of what <distribute> holds: several may have one prefix there, and it may be empty.
  std::string OurIdOfDistributed(const ConfigurationNode& what, long long first);
  void AddSpares(ConfigurationNode& parent);
  void AddMadeBodies(ConfigurationNode& parent);
  // The colour of its LEDs, as ours.
  std::string ColourOfLeds(const ConfigurationNode& leds);
  void SetMovable(const ConfigurationNode& theirs, ConfigurationNode& made);
  void SetPlace(const ConfigurationNode& theirs, ConfigurationNode& made, double lift);
  void ConvertDistribute(const ConfigurationNode& theirs, ConfigurationNode& parent);
  // `lift`: added to the heights, m.
  void ConvertPositions(const ConfigurationNode& theirs, ConfigurationNode& made, double lift);
  // Theirs are z, y, x, and only rotations about z are the same in both orders.
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
  std::set<std::string> distributed_ids_;  // ours
};

}  // namespace swarmanoid::argos3
