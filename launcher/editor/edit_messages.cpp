#include "launcher/editor/edit_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/experiment/notes.h"
#include "common/experiment/reference.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostMistakes = 100;   // limit for the mistakes in one message
constexpr std::size_t kMostPlacings = 1000;  // limit for one request
constexpr std::size_t kMostXml = 32768;      // bytes of an element that is edited as text: it must fit into a message
constexpr double kMostMetres = 1e6;

std::string Text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// ---- requests ----

std::string TextIn(const Json& json, const char* name)
{
  const auto found = json.find(name);
  if (found == json.end() || !found->is_string()) RefuseEdit(fmt::format("the request needs a text '{}'", name));
  return found->get<std::string>();
}

double NumberIn(const Json& json, double most)
{
  if (!json.is_number()) RefuseEdit("the request needs a number");
  const double number = json.get<double>();
  if (!(std::abs(number) <= most)) RefuseEdit(fmt::format("{} is out of all bounds", number));
  return number;
}

template <int kCount>
std::optional<Eigen::Matrix<double, kCount, 1>> PlaceIn(const Json& json, const char* name)
{
  const auto found = json.find(name);
  if (found == json.end() || found->is_null()) return std::nullopt;
  if (!found->is_array() || found->size() != kCount) RefuseEdit(fmt::format("'{}' must be {} numbers", name, kCount));
  Eigen::Matrix<double, kCount, 1> place;
  for (int i = 0; i < kCount; ++i) place[i] = NumberIn((*found)[static_cast<std::size_t>(i)], kMostMetres);
  return place;
}

const Json& ListIn(const Json& json, const char* name)
{
  const auto found = json.find(name);
  if (found == json.end() || !found->is_array() || found->size() > kMostPlacings)
    RefuseEdit(fmt::format("the request needs a list '{}' of at most {}", name, kMostPlacings));
  return *found;
}

ElementPath PathIn(const Json& json) { return ParsePath(TextIn(json, "path")); }

std::vector<Placing> PlacingsIn(const Json& json)
{
  std::vector<Placing> placings;
  for (const Json& each : ListIn(json, "places"))
  {
    if (!each.is_object()) RefuseEdit("each of 'places' is an object");
    Placing placing{PathIn(each), PlaceIn<3>(each, "position"), std::nullopt};
    if (each.contains("heading")) placing.heading = NumberIn(each["heading"], 1e5);
    placings.push_back(std::move(placing));
  }
  return placings;
}

EditedRun::Pace PaceIn(const Json& json)
{
  constexpr double kFastest = 1e9;
  EditedRun::Pace pace;
  pace.is_paused = json.value("paused", Json(false)) == Json(true);
  if (const auto speed = json.find("speed"); speed != json.end())
    pace.real_time_factor = std::max(NumberIn(*speed, kFastest), 0.0);
  return pace;
}

// ---- the run and scripts ----

// The token is a part of the run's address, behind "token=". Only pages that may edit get the document.
Json JsonOf(const EditedRun& run)
{
  constexpr const char* kPhases[] = {"none", "starting", "running", "ending"};
  const std::string& url = run.Url();
  const std::size_t token = url.find("token=");
  return {{"phase", kPhases[static_cast<std::size_t>(run.GetPhase())]},
          {"token", token == std::string::npos ? "" : url.substr(token + std::string_view("token=").size())},
          {"failure", run.Failure()}};
}

Json JsonOf(const std::vector<ControllerScript>& scripts)
{
  Json list = Json::array();
  for (const ControllerScript& script : scripts) list.push_back({{"name", script.name}, {"file", script.file}});
  return list;
}

// ---- forms ----

Json JsonOf(const ParameterSpec& spec)
{
  constexpr const char* kTypes[] = {"boolean", "integer", "number", "text",   "choice",
                                    "vector2", "vector3", "path",   "colour", "tree"};
  Json json{{"name", spec.name},
            {"type", kTypes[static_cast<std::size_t>(spec.type)]},
            {"unit", spec.unit},
            {"description", spec.description},
            {"allowed", AllowedText(spec)},
            {"required", !spec.default_value.has_value()}};
  if (spec.default_value) json["default"] = *spec.default_value;
  if (std::isfinite(spec.minimum)) json["minimum"] = spec.minimum;
  if (std::isfinite(spec.maximum)) json["maximum"] = spec.maximum;
  if (!spec.choices.empty()) json["choices"] = spec.choices;
  return json;
}

// Returns the values that a parameter may refer to: the ids of controllers, of engines, of entities.
std::vector<std::string> SuggestionsFor(const EditedExperiment& experiment, const std::string& tag,
                                        const std::string& parameter)
{
  std::vector<std::string> ids;
  const auto collect = [&](const char* section)
  {
    for (const auto& child : experiment.NodeAt({}).children)
      if (child->name == section)
        for (const auto& each : child->children)
          if (const auto id = TConfigurationTree(each).Value("id")) ids.push_back(*id);
  };
  if (parameter == "controller") collect("controllers");
  if (parameter == "library")
    for (const KnownController& known : experiment.Controllers())
      if (std::ranges::find(ids, known.library) == ids.end()) ids.push_back(known.library);
  if (parameter == "id" && tag == "engine") collect("engines");
  if (parameter == "id" && tag == "entity") collect("arena");
  if (parameter == "kind" && tag == "all")
    for (std::size_t kind = 0; kind < EntityKindCount(); ++kind)
      ids.emplace_back(TagName(static_cast<EntityKind>(kind)));
  return ids;
}

// Adds each member of a family, such as camera_view_XYZ_1, as a parameter of its own.
void AddMembers(const ConfigurationNode& node, const ParameterSpec& spec, const TConfigurationTree& tree, Json& list)
{
  const auto add = [&](const std::string& name)
  {
    if (!Matches(spec, name)) return;
    Json member = JsonOf(spec);
    member["name"] = name;
    member["value"] = *tree.Value(name);
    list.push_back(member);
  };
  for (const auto& attribute : node.attributes) add(attribute.name);
  for (const auto& child : node.children) add(child->name);
}

Json ParametersOf(const EditedExperiment& experiment, const ConfigurationNode& node, const ElementForm& form)
{
  const TConfigurationTree tree = TreeOf(node);
  Json list = Json::array();
  for (const ParameterSpec& spec : form.parameters)
  {
    if (IsNumbered(spec))
    {
      AddMembers(node, spec, tree, list);
      continue;
    }
    Json json = JsonOf(spec);
    const auto value = tree.Value(spec.name);
    json["value"] = value ? Json(*value) : Json(nullptr);
    if (value)
      if (const std::string mistake = MistakeIn(spec, *value, spec.name); !mistake.empty()) json["mistake"] = mistake;
    if (const auto suggestions = SuggestionsFor(experiment, node.name, spec.name); !suggestions.empty())
      json["suggestions"] = suggestions;
    list.push_back(json);
  }
  return list;
}

// Returns the child elements that are no values.
Json PartsOf(const EditedExperiment& experiment, const ConfigurationNode& node, const ElementForm& form,
             const ElementPath& path)
{
  Json list = Json::array();
  for (std::size_t i = 0; i < node.children.size(); ++i)
  {
    const ConfigurationNode& child = *node.children[i];
    if (std::ranges::any_of(form.parameters, [&](const auto& spec) { return Matches(spec, child.name); })) continue;
    ElementPath inner = path;
    inner.push_back(i);
    list.push_back({{"path", PathText(inner)}, {"tag", child.name}, {"name", experiment.NameOf(inner)}});
  }
  return list;
}

Json PathsAbove(const EditedExperiment& experiment, const ElementPath& path)
{
  Json list = Json::array();
  for (std::size_t length = 0; length < path.size(); ++length)
  {
    const ElementPath above(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(length));
    list.push_back({{"path", PathText(above)}, {"name", experiment.NameOf(above)}});
  }
  return list;
}

Json MistakeList(const EditedExperiment& experiment)
{
  Json list = Json::array();
  const auto add = [&](const Diagnostic& diagnostic, const char* kind)
  {
    if (list.size() >= kMostMistakes) return;
    list.push_back({{"kind", kind},
                    {"place", diagnostic.location.Text()},
                    {"text", diagnostic.message},
                    {"path", PathText(experiment.PathAt(diagnostic.location))}});
  };
  for (const Diagnostic& mistake : experiment.Mistakes()) add(mistake, "mistake");
  if (experiment.Mistakes().empty() && experiment.GetExperiment() != nullptr)
    for (const Diagnostic& note : NotesOn(*experiment.GetExperiment())) add(note, "note");
  return list;
}

}  // namespace

EditRequest ParseEditRequest(std::string_view text)
{
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) RefuseEdit("a request is a JSON object");
  EditRequest request;
  request.verb = TextIn(json, "do");
  request.text = text;
  if (request.verb == "form") request.path = PathIn(json);
  if (request.verb == "edit")
  {
    const auto revision = json.find("revision");
    if (revision == json.end() || !revision->is_number_unsigned()) RefuseEdit("an edit needs the number 'revision'");
    request.revision = revision->get<std::uint64_t>();
  }
  request.anyway = json.value("anyway", Json(false)) == Json(true);
  if (request.verb == "script" || request.verb == "save_script") request.file = TextIn(json, "file");
  if (request.verb == "save_script") request.content = TextIn(json, "text");
  if (request.verb == "run") request.pace = PaceIn(json);
  return request;
}

ElementPath CarryOut(const EditRequest& request, EditedExperiment& experiment)
{
  const Json json = Json::parse(request.text);
  const std::string change = TextIn(json, "change");
  if (change == "set")
  {
    const auto value = json.find("value");
    const bool drops = value != json.end() && value->is_null();
    experiment.SetValue(PathIn(json), TextIn(json, "name"),
                        drops ? std::nullopt : std::optional(TextIn(json, "value")));
  }
  else if (change == "place")
    experiment.Place(PlacingsIn(json));
  else if (change == "add")
    return experiment.Add(PathIn(json), TextIn(json, "tag"), PlaceIn<2>(json, "at"));
  else if (change == "remove")
  {
    std::vector<ElementPath> paths;
    for (const Json& path : ListIn(json, "paths"))
      paths.push_back(path.is_string() ? ParsePath(path) : (RefuseEdit("a path is a text"), ElementPath()));
    experiment.Remove(paths);
  }
  else if (change == "rewrite")
    experiment.Rewrite(PathIn(json), TextIn(json, "xml"));
  else if (change == "write out")
    experiment.WriteOut(PathIn(json));
  else
    RefuseEdit(fmt::format("there is no change '{}'", change.substr(0, 40)));
  return {};
}

std::string DocumentText(const EditedExperiment& experiment, const DocumentState& state)
{
  const EditedText& history = experiment.History();
  // Many entities share one element, so each element is listed once, and each entity has its number.
  Json paths = Json::array(), numbers = Json::array(), alike = Json::array();
  std::map<ElementPath, std::size_t> known;
  for (const ElementPath& path : experiment.EntityPaths())
  {
    const auto [found, is_new] = known.emplace(path, known.size());
    if (is_new)
    {
      paths.push_back(PathText(path));
      alike.push_back(experiment.IsDistributed(path));
    }
    numbers.push_back(found->second);
  }
  const auto arena = std::ranges::find(experiment.Root().children, "arena", &XmlElement::name);
  const bool has_arena = arena != experiment.Root().children.end();
  const ElementPath arena_path{static_cast<std::size_t>(arena - experiment.Root().children.begin())};
  Json kinds = Json::array();
  if (has_arena)
    for (const ElementForm::Child& child : experiment.FormAt(arena_path).children)
      if (child.may_be_added) kinds.push_back({{"tag", child.tag}, {"description", child.description}});

  const auto name = [](const std::string* text) { return text == nullptr ? Json(nullptr) : Json(*text); };
  Json json{{"type", "document"},
            {"revision", history.Revision()},
            {"file", state.file},
            {"saved", state.is_saved},
            {"changed_on_disk", state.changed_on_disk},
            {"undo", name(history.UndoName())},
            {"redo", name(history.RedoName())},
            {"hidden", state.hidden},
            {"mistakes", MistakeList(experiment)},
            {"all_mistakes", experiment.Mistakes().size()},
            {"checking", state.is_checking},
            {"checked", name(state.checked)},
            {"added", state.added == nullptr ? Json(nullptr) : Json(PathText(*state.added))},
            {"paths", paths},
            {"distributed", alike},
            {"path_of", numbers},
            {"kinds", kinds}};
  json["scripts"] = JsonOf(state.scripts);
  if (state.run != nullptr) json["run"] = JsonOf(*state.run);
  json["arena"] = has_arena ? Json(PathText(arena_path)) : Json(nullptr);
  return Text(json);
}

std::string ScriptText(const std::string& file, const std::string& content)
{
  try
  {
    return Json{{"type", "script"}, {"file", file}, {"text", content}}.dump();
  }
  catch (const Json::exception&)
  {
    RefuseEdit(file + " is no text in UTF-8, and cannot be edited here");
  }
}

std::string FormText(const EditedExperiment& experiment, const ElementPath& path)
{
  const ConfigurationNode& node = experiment.NodeAt(path);
  const ElementForm form = experiment.FormAt(path);
  Json addable = Json::array();
  for (const ElementForm::Child& child : form.children)
    if (child.may_be_added) addable.push_back({{"tag", child.tag}, {"description", child.description}});
  const XmlElement& element = experiment.At(path);
  const std::string xml(element.whole.Of(experiment.Text()));
  const bool is_distributed = experiment.IsDistributed(path);
  return Text({{"type", "form"},
               {"revision", experiment.History().Revision()},
               {"path", PathText(path)},
               {"above", PathsAbove(experiment, path)},
               {"tag", node.name},
               {"name", experiment.NameOf(path)},
               {"line", node.location.line},
               {"description", form.description},
               {"known", form.known},
               {"distributed", is_distributed},
               {"removable", !path.empty() && !form.required && !is_distributed},
               {"parameters", ParametersOf(experiment, node, form)},
               {"parts", PartsOf(experiment, node, form, path)},
               {"addable", addable},
               {"xml", xml.size() <= kMostXml ? Json(xml) : Json(nullptr)}});
}

}  // namespace swarmanoid
