// The model of a user's kind: the parts that its row lists, or its body with its LEDs. Scene uses it, and so does the
// web renderer, which sends it to its pages.
#pragma once

#include "common/experiment/experiment.h"
#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

// Returns the model with all joints where they start. If the row has no parts and entities give their own sizes, the
// model has size 1 and is scaled by them. The experiment gives the folders of mesh files. Throws ConfigurationError for
// a file that cannot be read.
Model KindModel(const EntityKindDescription& kind, const Experiment& experiment);
// Returns the models of the parts that move with each link, the base first, all with the joints at 0. A kind without
// links has one.
std::vector<Model> LinkModels(const EntityKindDescription& kind, const Experiment& experiment);
bool IsScaled(const EntityKindDescription& kind);

}  // namespace swarmanoid
