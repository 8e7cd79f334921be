#include "launcher/editor/new_element.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"
#include "launcher/editor/edited_experiment.h"

namespace swarmanoid
{
namespace
{

using Node = ConfigurationNode;

// Returns the last sibling with that tag, whose values the new element copies, or nullptr.
const Node* LastLike(const Node& parent, const std::string& tag)
{
  const auto found = std::ranges::find_if(parent.children.rbegin(), parent.children.rend(),
                                          [&](const auto& each) { return each->name == tag; });
  return found == parent.children.rend() ? nullptr : found->get();
}

// Returns "fb_4" after "fb_3", or "footbot_1" for the first one.
std::string FreeId(const EditedExperiment& experiment, const Node& parent, const std::string& tag, const Node* like)
{
  std::set<std::string> taken;
  for (const auto& child : parent.children) taken.insert(TreeOf(*child).Value("id").value_or(""));
  const bool is_entity = KindOfTag(tag).has_value();
  if (is_entity && experiment.GetExperiment() != nullptr)
    for (const EntityConfiguration& entity : experiment.GetExperiment()->entities) taken.insert(entity.id);
  std::string stem = like == nullptr ? "" : TreeOf(*like).Value("id").value_or("");
  stem.erase(stem.find_last_not_of("0123456789") + 1);
  if (stem.empty()) stem = tag + "_";
  if (stem.back() != '_' && stem.back() != '-') stem += '_';
  int number = 1;
  while (taken.contains(stem + std::to_string(number))) ++number;
  return stem + std::to_string(number);
}

// Prefers the simulator's own implementations of a device.
std::string ChoiceOf(const std::vector<std::string>& choices)
{
  for (const char* own : {"generic_", "dummy_"})
    for (const std::string& choice : choices)
      if (choice.starts_with(own)) return choice;
  return choices.empty() ? "" : choices.front();
}

std::string ValueOfType(const ParameterSpec& spec)
{
  switch (spec.type)
  {
    case ParameterType::kBoolean:
      return "false";
    case ParameterType::kChoice:
      return ChoiceOf(spec.choices);
    case ParameterType::kInteger:
    case ParameterType::kNumber:
      return NumberText(spec.unit == "m" ? std::clamp(0.1, spec.minimum, spec.maximum)
                                         : std::clamp(1.0, spec.minimum, spec.maximum));
    case ParameterType::kVector2:
      return "1, 1";
    case ParameterType::kVector3:
      return "0.5, 0.5, 0.5";
    case ParameterType::kColour:
      return "grey";
    case ParameterType::kText:
    case ParameterType::kPath:
    case ParameterType::kTree:
      break;
  }
  return "";
}

// Returns the height of the position above the floor: that of the copied entity if it has the same size, or the height
// at which the new one stands.
double HeightOf(EntityKind kind, const Node* like, const std::optional<std::vector<double>>& size)
{
  const EntityKindDescription& row = DescriptionOf(kind);
  if (like != nullptr && (row.form == BodyForm::kNone || !row.size.isZero()))
    if (const auto position = ParseNumbers(TreeOf(*like).Value("position").value_or(""));
        position && position->size() == 3)
      return position->back();
  if (row.form == BodyForm::kNone || row.origin == BodyOrigin::kBase) return 0;
  const double height = size && size->size() == 3 ? size->back() : row.size.z();
  return height / 2;
}

// Returns the first controller whose tag begins with the kind of a robot, such as footbot_diffusion; empty for none.
std::string ControllerFor(const EditedExperiment& experiment, EntityKind kind)
{
  if (!IsRobot(kind)) return "";
  for (const auto& section : experiment.NodeAt({}).children)
    if (section->name == "controllers")
      for (const auto& controller : section->children)
        if (controller->name.starts_with(std::string(TagName(kind)) + "_"))
          return TreeOf(*controller).Value("id").value_or("");
  return "";
}

}  // namespace

std::string NumberText(double number)
{
  std::string text = fmt::format("{:.4f}", number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::vector<std::pair<std::string, std::string>> ValuesForNew(const std::string& tag,
                                                              const std::vector<ParameterSpec>& required,
                                                              const EditedExperiment& experiment,
                                                              const std::vector<std::size_t>& parent,
                                                              const std::optional<Vector2>& at)
{
  const Node& above = experiment.NodeAt(parent);
  const Node* const like = LastLike(above, tag);
  const auto kind = KindOfTag(tag);
  std::vector<std::pair<std::string, std::string>> values;
  std::optional<std::vector<double>> size;
  const auto add = [&](const std::string& name, const std::string& value)
  {
    values.emplace_back(name, value);
    if (name == "size") size = ParseNumbers(value);
  };
  for (const ParameterSpec& spec : required)
  {
    const auto copied = like == nullptr ? std::nullopt : TreeOf(*like).Value(spec.name);
    if (spec.name == "id")
      values.insert(values.begin(), {"id", FreeId(experiment, above, tag, like)});
    else if (spec.name == "quantity")
      add(spec.name, "10");
    else if (spec.name != "position")
      // Vectors are not copied: a wall with the same corners would be in the same place.
      add(spec.name, copied && spec.type != ParameterType::kVector3 ? *copied : ValueOfType(spec));
  }
  if (!kind) return values;
  const EntityKindDescription& row = DescriptionOf(*kind);
  if (row.role == EntityRole::kPatch || row.role == EntityRole::kHole) add("size", "1, 1");
  const std::string controller =
      like == nullptr ? ControllerFor(experiment, *kind) : TreeOf(*like).Value("controller").value_or("");
  if (!controller.empty()) add("controller", controller);
  const bool is_placed = experiment.At(parent).name == "arena" && row.role != EntityRole::kTerrain;
  if (!is_placed) return values;
  const Experiment* known = experiment.GetExperiment();
  const Vector2 middle = known == nullptr ? Vector2::Zero() : Vector2(known->arena_size.head<2>() / 2);
  const Vector2 place = at.value_or(middle);
  const std::string position =
      fmt::format("{}, {}, {}", NumberText(place.x()), NumberText(place.y()), NumberText(HeightOf(*kind, like, size)));
  values.insert(values.begin() + (values.empty() || values.front().first != "id" ? 0 : 1), {"position", position});
  return values;
}

std::string EntitiesOneByOne(const EditedExperiment& experiment, const std::vector<std::size_t>& path)
{
  const std::string& text = experiment.Text();
  const XmlElement& distribution = experiment.At(path);
  const auto one = std::ranges::find_if(distribution.children,
                                        [](const XmlElement& child) { return KindOfTag(child.name).has_value(); });
  std::vector<std::size_t> inner = path;
  inner.push_back(static_cast<std::size_t>(one - distribution.children.begin()));
  const InsertionPlace outer_lines = PlaceForChild(text, experiment.At({path.begin(), path.end() - 1}));
  const std::string deep = outer_lines.line_end + PlaceForChild(text, distribution).indent;
  const std::string flat = outer_lines.line_end + outer_lines.indent;

  // The lines of the entity have a deeper indent than those that replace the <distribute>.
  std::string sample(one->whole.Of(text));
  for (std::size_t at = sample.find(deep); at != std::string::npos; at = sample.find(deep, at + flat.size()))
    sample.replace(at, deep.size(), flat);
  std::string all;
  const Experiment& known = *experiment.GetExperiment();
  for (std::size_t e = 0; e < known.entities.size(); ++e)
  {
    if (experiment.EntityPaths()[e] != inner) continue;
    const EntityConfiguration& entity = known.entities[e];
    const EulerAngles angles = EulerFromQuaternion(entity.pose.orientation);
    const Vector3& position = entity.pose.position;
    std::string element = sample;
    for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
             {"id", entity.id},
             {"position", fmt::format("{}, {}, {}", position.x(), position.y(), position.z())},
             {"orientation", fmt::format("{}, {}, {}", RadiansToDegrees(angles.alpha), RadiansToDegrees(angles.beta),
                                         RadiansToDegrees(angles.gamma))}})
      element = WithEdits(element, SetValue(element, OutlineOf(element), name, value));
    all += (all.empty() ? "" : flat) + element;
  }
  return all;
}

}  // namespace swarmanoid
