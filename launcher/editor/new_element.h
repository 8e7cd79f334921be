// What an element of an experiment file begins with that a user adds in the editor: values that stand for what is
// required, an id that nobody has, a place on the floor. Used by EditedExperiment.
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

// As a user writes it: at most four digits behind the point.
std::string NumberText(double number);

// `at`: where an entity of <arena> is put (m); nothing: in the middle.
std::vector<std::pair<std::string, std::string>> ValuesForNew(const std::string& tag,
                                                              const std::vector<ParameterSpec>& required,
                                                              const EditedExperiment& experiment,
                                                              const std::vector<std::size_t>& parent,
                                                              const std::optional<Vector2>& at);

// The text for the entities of the <distribute> at a path, in lines as it stands.
std::string EntitiesOneByOne(const EditedExperiment& experiment, const std::vector<std::size_t>& path);

}  // namespace swarmanoid
