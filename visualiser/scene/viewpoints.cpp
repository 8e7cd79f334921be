// A camera is given in one of three ways: by the number of a viewpoint of the experiment file, by a word (default,
// top), or by its place and angles in metres and degrees. The default view is the nearest one that shows the whole
// arena up to the highest movable body; walls and ceilings that are higher do not count, since the robots would be
// small.
#include "visualiser/scene/viewpoints.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{
namespace
{

constexpr std::string_view kPlaceName = "camera_view_XYZ_";
constexpr std::string_view kTurnName = "camera_view_HPR_";
constexpr double kTopFieldOfView = 20;  // degrees: nearly parallel, like a map

// Returns the number of a viewpoint's parameter, or -1 for another name.
int NumberOf(std::string_view name)
{
  for (const std::string_view family : {kPlaceName, kTurnName})
    if (name.starts_with(family))
    {
      const std::string_view digits = name.substr(family.size());
      int number = -1;
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
      return number;
    }
  return -1;
}

Camera CameraOf(const Vector3& place, const Vector3& turn)
{
  Camera camera;
  camera.position = place;
  camera.heading = turn.x();
  camera.pitch = turn.y();
  camera.roll = turn.z();
  return camera;
}

std::optional<Vector3> ParseVector(std::string_view text)
{
  Vector3 vector = Vector3::Zero();
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto skip = [&](char wanted)
  {
    while (at != end && *at == ' ') ++at;
    if (at == end || *at != wanted) return false;
    ++at;
    return true;
  };
  for (Eigen::Index i = 0; i < 3; ++i)
  {
    if (i > 0 && !skip(',')) return std::nullopt;
    while (at != end && *at == ' ') ++at;
    const auto [stop, error] = std::from_chars(at, end, vector[i]);
    if (error != std::errc()) return std::nullopt;
    at = stop;
  }
  while (at != end && *at == ' ') ++at;
  if (at != end) return std::nullopt;
  return vector;
}

}  // namespace

Viewpoints::Viewpoints(const Parameters& parameters)
{
  const TConfigurationTree& tree = parameters.Tree();
  const auto check = [](const std::string& name, const SourceLocation& location)
  {
    if (NumberOf(name) >= kCount) throw ConfigurationError(location, name + ": viewpoints have the numbers 0 to 9");
  };
  for (const TConfigurationTree& child : tree.Children()) check(child.Name(), child.Location());
  for (int number = 0; number < kCount; ++number)
  {
    const std::string place = fmt::format("{}{}", kPlaceName, number);
    const std::string turn = fmt::format("{}{}", kTurnName, number);
    if (parameters.IsGiven(place))
      Store(number, CameraOf(parameters.Vector3Of(place), parameters.Vector3Of(turn)));
    else if (parameters.IsGiven(turn))
      throw ConfigurationError(tree.ValueLocation(turn), turn + " says where viewpoint " + std::to_string(number) +
                                                             " looks, but not where it stands; add " + place);
  }
}

Viewpoints Viewpoints::Of(const Experiment& experiment)
{
  for (const RenderConfiguration& visualisation : experiment.visualisations)
  {
    const PluginDescription* description = PluginCatalogue::Instance().Find(PluginKind::kRenderer, visualisation.tag);
    if (description == nullptr) continue;
    const std::vector<ParameterSpec>& specs = description->parameters;
    const bool has_viewpoints = std::any_of(specs.begin(), specs.end(),
                                            [](const ParameterSpec& spec) { return spec.name == "camera_view_XYZ_n"; });
    if (!has_viewpoints) continue;
    const Viewpoints viewpoints(Parameters(visualisation.tree, specs));
    if (viewpoints.First()) return viewpoints;
  }
  return {};
}

std::optional<Camera> Viewpoints::First() const
{
  const auto given = [](const std::optional<Camera>& view) { return view.has_value(); };
  const auto first = std::find_if(views_.begin(), views_.end(), given);
  return first == views_.end() ? std::nullopt : *first;
}

std::string ViewpointXml(int number, const Camera& camera)
{
  const auto text = [](double value)
  {
    std::string digits = fmt::format("{:.5f}", value);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits == "-0" ? std::string("0") : digits;
  };
  return fmt::format(
      "<camera_view_XYZ_{0}>{1}, {2}, {3}</camera_view_XYZ_{0}>\n<camera_view_HPR_{0}>{4}, {5}, "
      "{6}</camera_view_HPR_{0}>",
      number, text(camera.position.x()), text(camera.position.y()), text(camera.position.z()), text(camera.heading),
      text(camera.pitch), text(camera.roll));
}

Camera DefaultView(const Experiment& experiment, double aspect, bool top, const HiddenEdges& hidden)
{
  // The height covers only the robots, since an arena may have a ceiling far above them.
  double height = 0.35;
  for (const EntityConfiguration& entity : experiment.entities)
    if (entity.movable) height = std::max(height, entity.pose.position.z() + entity.size.z());
  const Vector3& size = experiment.arena_size;
  const Vector3 high(size.x(), size.y(), std::min(height, size.z()));
  if (top) return FrameBox(Vector3::Zero(), high, aspect, 90, -90, kTopFieldOfView, hidden);
  return FrameBox(Vector3::Zero(), high, aspect, 62, -38, 45, hidden);
}

Camera CameraFromText(const std::string& text, const Viewpoints& viewpoints, const Experiment& experiment,
                      double aspect, const SourceLocation& location)
{
  if (text == "default") return DefaultView(experiment, aspect);
  if (text == "top") return DefaultView(experiment, aspect, true);
  if (text.size() == 1 && text[0] >= '0' && text[0] <= '9')
  {
    const int number = text[0] - '0';
    if (viewpoints.At(number)) return *viewpoints.At(number);
    throw ConfigurationError(location, "camera is viewpoint " + text + ", but there is no camera_view_XYZ_" + text);
  }
  const std::size_t slash = text.find('/');
  const std::optional<Vector3> place = ParseVector(std::string_view(text).substr(0, slash));
  const std::optional<Vector3> turn = slash == std::string::npos
                                          ? std::optional<Vector3>(Vector3::Zero())
                                          : ParseVector(std::string_view(text).substr(slash + 1));
  if (place && turn) return CameraOf(*place, *turn);
  throw ConfigurationError(location, "camera is '" + text +
                                         "'; it must be the number of a viewpoint, top, default, or "
                                         "x,y,z/heading,pitch,roll in metres and degrees");
}

}  // namespace swarmanoid
