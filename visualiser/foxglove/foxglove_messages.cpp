// Foxglove shows a scene of entities that stay until they are replaced or deleted. Each body lies in a frame of its own
// that is locked to the entity, so while robots only move, transforms alone are sent. After a change of presence,
// colour or LEDs the whole scene is sent, with the deletion of all before it, so that one message describes the scene
// at any time. The names of the schemas' fields are fixed by Foxglove.
#include "visualiser/foxglove/foxglove_messages.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/program/csv.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "visualiser/led_place.h"

namespace swarmanoid
{
namespace
{

using MessageJson = nlohmann::ordered_json;

constexpr const char* kWorldFrame = "arena";
constexpr double kThin = 0.002;  // m: the thickness of flat entities on the floor
constexpr double kLedRadius = 0.008;

MessageJson TimeOf(std::uint64_t time) { return {{"sec", time / 1'000'000'000}, {"nsec", time % 1'000'000'000}}; }
MessageJson VectorOf(const Vector3& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }
MessageJson QuaternionOf(const Quaternion& q) { return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}}; }
MessageJson PoseOf(const Vector3& position)
{
  return {{"position", VectorOf(position)}, {"orientation", QuaternionOf(Quaternion::Identity())}};
}
MessageJson ColourOf(double colour)
{
  const auto rgb = static_cast<std::uint32_t>(colour);
  const auto channel = [&](unsigned shift) { return (rgb >> shift & 0xffU) / 255.0; };
  return {{"r", channel(16)}, {"g", channel(8)}, {"b", channel(0)}, {"a", 1.0}};
}

// Return the parts of JSON schemas that these messages need.
MessageJson Number() { return {{"type", "number"}}; }
MessageJson Integer() { return {{"type", "integer"}}; }
MessageJson Text() { return {{"type", "string"}}; }
MessageJson ListOf(const MessageJson& items) { return {{"type", "array"}, {"items", items}}; }
MessageJson Object(const MessageJson& properties) { return {{"type", "object"}, {"properties", properties}}; }
MessageJson TimeSchema() { return Object({{"sec", Integer()}, {"nsec", Integer()}}); }
MessageJson VectorSchema() { return Object({{"x", Number()}, {"y", Number()}, {"z", Number()}}); }
MessageJson QuaternionSchema() { return Object({{"x", Number()}, {"y", Number()}, {"z", Number()}, {"w", Number()}}); }
MessageJson Titled(const char* title, MessageJson schema)
{
  schema["title"] = title;
  return schema;
}

MessageJson TransformsSchema()
{
  return Object({{"transforms", ListOf(Object({{"timestamp", TimeSchema()},
                                               {"parent_frame_id", Text()},
                                               {"child_frame_id", Text()},
                                               {"translation", VectorSchema()},
                                               {"rotation", QuaternionSchema()}}))}});
}

MessageJson SceneSchema()
{
  const MessageJson colour = Object({{"r", Number()}, {"g", Number()}, {"b", Number()}, {"a", Number()}});
  const MessageJson pose = Object({{"position", VectorSchema()}, {"orientation", QuaternionSchema()}});
  const MessageJson body = Object({{"pose", pose}, {"size", VectorSchema()}, {"color", colour}});
  MessageJson cylinder = body;
  cylinder["properties"]["bottom_scale"] = cylinder["properties"]["top_scale"] = Number();
  const MessageJson entity = Object({{"timestamp", TimeSchema()},
                                     {"frame_id", Text()},
                                     {"id", Text()},
                                     {"lifetime", TimeSchema()},
                                     {"frame_locked", {{"type", "boolean"}}},
                                     {"metadata", ListOf(Object({{"key", Text()}, {"value", Text()}}))},
                                     {"arrows", ListOf(Object(MessageJson::object()))},
                                     {"cubes", ListOf(body)},
                                     {"spheres", ListOf(body)},
                                     {"cylinders", ListOf(cylinder)},
                                     {"lines", ListOf(Object(MessageJson::object()))},
                                     {"triangles", ListOf(Object(MessageJson::object()))},
                                     {"texts", ListOf(Object(MessageJson::object()))},
                                     {"models", ListOf(Object(MessageJson::object()))}});
  const MessageJson deletion = Object({{"timestamp", TimeSchema()}, {"type", Integer()}, {"id", Text()}});
  return Object({{"deletions", ListOf(deletion)}, {"entities", ListOf(entity)}});
}

MessageJson LogSchema()
{
  return Object({{"timestamp", TimeSchema()},
                 {"level", Integer()},
                 {"message", Text()},
                 {"name", Text()},
                 {"file", Text()},
                 {"line", Integer()}});
}

MessageJson AttributesSchema(const CSwarmanoidSpace& space)
{
  MessageJson properties{{"id", Text()}, {"kind", Text()}};
  for (std::size_t e = 0; e < space.Size(); ++e)
    for (const AttributeSpec& spec : AttributesOf(space.GetEntity(e).GetKind()))
      properties[std::string(spec.name)] = ListOf(Number());
  return Object({{"timestamp", TimeSchema()}, {"tick", Integer()}, {"entities", ListOf(Object(properties))}});
}

FoxgloveTopic TopicOf(const char* topic, const char* schema_name, const MessageJson& schema)
{
  return {topic, schema_name, Titled(schema_name, schema).dump()};
}

}  // namespace

struct FoxgloveMessages::Entity
{
  std::uint32_t number;
  bool is_shown;  // it has a body, or lies on the floor
  bool is_cylinder = false;
  Vector3 size = Vector3::Zero();
  Vector3 centre = Vector3::Zero();  // in the frame of the entity
};

FoxgloveMessages::FoxgloveMessages(const CSwarmanoidSpace& space, std::vector<std::size_t> entities) : space_(space)
{
  for (const std::size_t e : entities)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
    Entity shown{static_cast<std::uint32_t>(e), kind.role != EntityRole::kTerrain};
    shown.size = entity.GetSize();
    if (kind.role == EntityRole::kRobot || kind.role == EntityRole::kObject)
    {
      shown.is_cylinder = kind.form == BodyForm::kCylinder;
      if (shown.is_cylinder) shown.size = {2 * shown.size.x(), 2 * shown.size.x(), shown.size.z()};
      if (kind.origin == BodyOrigin::kBase) shown.centre.z() = shown.size.z() / 2;
    }
    else if (kind.role == EntityRole::kPatch || kind.role == EntityRole::kHole)
    {
      shown.is_cylinder = shown.size.y() == 0;
      if (shown.is_cylinder) shown.size.y() = shown.size.x() *= 2;
      shown.size.z() = kThin;
    }
    else
      shown.size = Vector3::Constant(0.1);
    entities_.push_back(shown);
  }
}

FoxgloveMessages::~FoxgloveMessages() = default;

std::array<FoxgloveTopic, FoxgloveMessages::kTopicCount> FoxgloveMessages::Topics() const
{
  return {TopicOf("/tf_static", "foxglove.FrameTransforms", TransformsSchema()),
          TopicOf("/tf", "foxglove.FrameTransforms", TransformsSchema()),
          TopicOf("/scene", "foxglove.SceneUpdate", SceneSchema()),
          TopicOf("/attributes", "swarmanoid.Attributes", AttributesSchema(space_)),
          TopicOf("/events", "foxglove.Log", LogSchema())};
}

std::uint64_t FoxgloveMessages::TimeOfTick(double tick) const
{
  return static_cast<std::uint64_t>(std::llround(tick * space_.GetTickSeconds() * 1e9));
}

std::uint64_t FoxgloveMessages::Time() const { return TimeOfTick(static_cast<double>(space_.GetTick())); }

std::string FoxgloveMessages::Transforms(bool movable) const
{
  const std::uint64_t time = Time();
  MessageJson transforms = MessageJson::array();
  for (const Entity& shown : entities_)
  {
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(shown.number);
    if (entity.IsMovable() != movable || !space_.IsPresent(shown.number)) continue;
    const Pose pose = entity.GetPose();
    transforms.push_back({{"timestamp", TimeOf(time)},
                          {"parent_frame_id", kWorldFrame},
                          {"child_frame_id", entity.GetId()},
                          {"translation", VectorOf(pose.position)},
                          {"rotation", QuaternionOf(pose.orientation)}});
  }
  return MessageJson{{"transforms", std::move(transforms)}}.dump();
}

// Sends the whole scene after any change, so that one message describes the scene at any time. Moving bodies are in the
// frames of their entities.
std::optional<std::string> FoxgloveMessages::ChangedScene()
{
  const std::uint64_t time = Time();
  std::vector<double> shown;
  MessageJson entities = MessageJson::array();
  for (const Entity& of : entities_)
  {
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(of.number);
    const bool is_present = space_.IsPresent(of.number);
    shown.push_back(is_present ? 1 : 0);
    if (!of.is_shown || !is_present) continue;
    const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
    const bool is_coloured = FindAttribute(entity.GetKind(), "colour") != nullptr;
    double colour = kind.role == EntityRole::kHole ? 0 : kind.colour;
    if (is_coloured) shown.push_back(colour = entity.GetAttribute("colour"));
    MessageJson body{{"pose", PoseOf(of.centre)}, {"size", VectorOf(of.size)}, {"color", ColourOf(colour)}};
    if (of.is_cylinder) body["bottom_scale"] = body["top_scale"] = 1.0;
    MessageJson leds = MessageJson::array();
    for (std::size_t led = 0; led < (kind.leds ? kind.leds->places.size() : 0); ++led)
    {
      const double lit = entity.GetAttribute("led", static_cast<int>(led));
      shown.push_back(lit);
      if (lit == 0) continue;
      leds.push_back({{"pose", PoseOf(LedPlace(entity, led))},
                      {"size", VectorOf(Vector3::Constant(2 * kLedRadius))},
                      {"color", ColourOf(lit)}});
    }
    const MessageJson kind_of{{"key", "kind"}, {"value", TagName(entity.GetKind())}};
    MessageJson scene_entity{{"timestamp", TimeOf(time)}, {"frame_id", entity.GetId()},
                             {"id", entity.GetId()},      {"lifetime", TimeOf(0)},
                             {"frame_locked", true},      {"metadata", MessageJson::array({kind_of})}};
    for (const char* none : {"arrows", "lines", "triangles", "texts", "models"})
      scene_entity[none] = MessageJson::array();
    for (const char* some : {"cubes", "spheres", "cylinders"}) scene_entity[some] = MessageJson::array();
    const bool is_ball = kind.role == EntityRole::kLight || kind.role == EntityRole::kSound;
    scene_entity[is_ball ? "spheres" : of.is_cylinder ? "cylinders" : "cubes"].push_back(std::move(body));
    for (MessageJson& led : leds) scene_entity["spheres"].push_back(std::move(led));
    entities.push_back(std::move(scene_entity));
  }
  if (shown == shown_) return std::nullopt;
  shown_ = std::move(shown);
  constexpr int kAll = 1;
  const MessageJson deletion{{"timestamp", TimeOf(time)}, {"type", kAll}, {"id", ""}};
  return MessageJson{{"deletions", MessageJson::array({deletion})}, {"entities", std::move(entities)}}.dump();
}

std::string FoxgloveMessages::Attributes() const
{
  MessageJson entities = MessageJson::array();
  for (const Entity& shown : entities_)
  {
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(shown.number);
    if (!space_.IsPresent(shown.number)) continue;
    MessageJson values{{"id", entity.GetId()}, {"kind", TagName(entity.GetKind())}};
    for (const AttributeSpec& spec : AttributesOf(entity.GetKind()))
    {
      MessageJson elements = MessageJson::array();
      for (int element = 0; element < spec.count; ++element)
        elements.push_back(entity.GetAttribute(spec.name, element));
      values[std::string(spec.name)] = std::move(elements);
    }
    entities.push_back(std::move(values));
  }
  const MessageJson message{
      {"timestamp", TimeOf(Time())}, {"tick", space_.GetTick()}, {"entities", std::move(entities)}};
  return message.dump();
}

std::string FoxgloveMessages::Event(std::string_view line, std::uint64_t time)
{
  const std::vector<std::string> fields = CsvFields(line);
  std::string text = fields.at(1);
  for (const std::size_t field : {2, 3})
    if (!fields.at(field).empty()) text += " " + fields[field];
  if (fields.size() > 4 && !fields[4].empty()) text += ": " + fields[4];
  constexpr int kInfo = 2, kWarning = 3;
  const bool is_bad = fields[1] == "failed" || fields[1] == "refused";
  const MessageJson message{{"timestamp", TimeOf(time)}, {"level", is_bad ? kWarning : kInfo},
                            {"message", text},           {"name", fields[1]},
                            {"file", "events.csv"},      {"line", 0}};
  return message.dump(-1, ' ', false, MessageJson::error_handler_t::replace);
}

}  // namespace swarmanoid
