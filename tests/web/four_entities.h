// The experiment has a footbot, an eyebot above it, a prey and a nest, in one engine.
#pragma once

#include "common/messages/assignment.h"
#include "common/space/space.h"
#include "tests/world/small_experiment.h"

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
    test::Add(experiment, test::Entity(EntityKind::kFootbot, "fb_0", {1, 1, 0}, {0.085, 0.085, 0.147}, true));
    test::Add(experiment, test::Entity(EntityKind::kEyebot, "eb_0", {2, 2, 1.5}));
    test::Add(experiment, test::Entity(EntityKind::kCylindricPrey, "prey", {3, 2, 0}, {0.1, 0.1, 0.2}, true));
    test::Add(experiment, test::Entity(EntityKind::kGroundPatch, "nest", {3, 3, 0}, {1, 1, 0}, false));
    experiment.engines[0].tag = "dummy_engine";
    experiment.engines[0].id = "ground";
    return experiment;
  }
};

}  // namespace swarmanoid
