// What a user's kind looks like: the parts that its row lists, or its body with its LEDs. Used by Scene, and by the web
// renderer, which sends it to its pages.
#pragma once

#include "common/experiment/experiment.h"
#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

// Of a row without parts whose entities give their own sizes: of size 1, to be scaled by them. The experiment says
// where the files are that it names; throws ConfigurationError for one that cannot be read.
Model KindModel(const EntityKindDescription& kind, const Experiment& experiment);
bool IsScaled(const EntityKindDescription& kind);

}  // namespace swarmanoid
