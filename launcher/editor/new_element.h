// The first values of an element that a user adds in the editor: the required values, a free id, a position on the
// floor. EditedExperiment uses it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/math/pose.h"

namespace swarmanoid
{

class EditedExperiment;

// Returns a number in the form that users write: at most four digits after the point.
std::string NumberText(double number);

// Returns names and values of a new element. `at`: the position of an entity of <arena> (m); nothing: the middle.
std::vector<std::pair<std::string, std::string>> ValuesForNew(const std::string& tag,
                                                              const std::vector<ParameterSpec>& required,
                                                              const EditedExperiment& experiment,
                                                              const std::vector<std::size_t>& parent,
                                                              const std::optional<Vector2>& at);

// Returns the text of the entities of the <distribute> at a path, one element in each line, with its indent.
std::string EntitiesOneByOne(const EditedExperiment& experiment, const std::vector<std::size_t>& path);

}  // namespace swarmanoid
