// The JSON messages with which Foxglove and Lichtblick show a run: transforms, bodies, attributes and events.
// `swarmanoid export --mcap` and foxglove_render use it, each in one thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swarmanoid
{

class CSwarmanoidSpace;

struct FoxgloveTopic
{
  std::string topic;        // "/tf"
  std::string schema_name;  // "foxglove.FrameTransforms"
  std::string schema;       // a JSON schema
};

class FoxgloveMessages
{
public:
  enum Topic : std::size_t
  {
    kFixed,  // transforms that never change
    kMoving,
    kScene,
    kAttributes,
    kEvents,
    kTopicCount
  };

  // `entities` are the shown ones. The space must outlive the object.
  FoxgloveMessages(const CSwarmanoidSpace& space, std::vector<std::size_t> entities);
  ~FoxgloveMessages();

  std::array<FoxgloveTopic, kTopicCount> Topics() const;
  // Returns the simulated time of a tick in ns; without an argument, of the space's tick.
  std::uint64_t TimeOfTick(double tick) const;
  std::uint64_t Time() const;

  // Returns the poses of the entities at the tick of the space: of the movable ones, or of the others.
  std::string Transforms(bool movable) const;
  // Returns all bodies, in the frames of their entities; nothing if they have not changed since the last call.
  std::optional<std::string> ChangedScene();
  std::string Attributes() const;
  // Returns the message for a line of events.csv, at a time in ns.
  static std::string Event(std::string_view line, std::uint64_t time);

  // Makes the next scene count as changed.
  void ForgetScene() { shown_.reset(); }

private:
  struct Entity;

  const CSwarmanoidSpace& space_;
  std::vector<Entity> entities_;
  std::optional<std::vector<double>> shown_;  // by entity: whether it is in the arena, and its colours
};

}  // namespace swarmanoid
