// A footbot, an eyebot above it, a prey and a nest, in one engine.
#pragma once

#include "common/messages/assignment.h"
#include "common/space/space.h"

namespace swarmanoid
{

struct FourEntities
{
  Experiment experiment = Make();
  CSwarmanoidSpace space{experiment};
  Assignment assignment = MakeAssignment(experiment, 1);

  static Experiment Make()
  {
    Experiment experiment;
    experiment.name = "small";
    experiment.arena_size = {4, 4, 2};
    experiment.entities = {Entity(EntityKind::kFootbot, "fb_0", {1, 1, 0}, {0.085, 0.085, 0.147}, true),
                           Entity(EntityKind::kEyebot, "eb_0", {2, 2, 1.5}, {0.25, 0.25, 0.566}, true),
                           Entity(EntityKind::kCylindricPrey, "prey", {3, 2, 0}, {0.1, 0.1, 0.2}, true),
                           Entity(EntityKind::kGroundPatch, "nest", {3, 3, 0}, {1, 1, 0}, false)};
    EngineConfiguration engine;
    engine.tag = "dummy_engine";
    engine.id = "ground";
    engine.entities = {0, 1, 2, 3};
    experiment.engines = {engine};
    return experiment;
  }

  static EntityConfiguration Entity(EntityKind kind, const std::string& id, const Vector3& position,
                                    const Vector3& size, bool movable)
  {
    EntityConfiguration entity;
    entity.kind = kind;
    entity.id = id;
    entity.pose.position = position;
    entity.size = size;
    entity.movable = movable;
    return entity;
  }
};

}  // namespace swarmanoid
