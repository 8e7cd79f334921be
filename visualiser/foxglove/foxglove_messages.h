// The messages by which Foxglove and Lichtblick see a run, as JSON: transforms, bodies, attributes and events. Used by
// `swarmanoid export --mcap` and by foxglove_render, each in one thread.
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
  std::string schema;       // of JSON
};

class FoxgloveMessages
{
public:
  enum Topic : std::size_t
  {
    kFixed,  // what stands for ever
    kMoving,
    kScene,
    kAttributes,
    kEvents,
    kTopicCount
  };

  // `entities`: those that are shown. The space outlives this.
  FoxgloveMessages(const CSwarmanoidSpace& space, std::vector<std::size_t> entities);
  ~FoxgloveMessages();

  std::array<FoxgloveTopic, kTopicCount> Topics() const;
  // Simulated time of a tick, in ns; of the space's without an argument.
  std::uint64_t TimeOfTick(double tick) const;
  std::uint64_t Time() const;

  // Where the entities are at the tick of the space: those that can move, or the others.
  std::string Transforms(bool movable) const;
  // All bodies, in the frames of their entities; nothing if they are as in the call before.
  std::optional<std::string> ChangedScene();
  std::string Attributes() const;
  // A line of events.csv, at a time in ns.
  static std::string Event(std::string_view line, std::uint64_t time);

  // The next scene counts as changed.
  void ForgetScene() { shown_.reset(); }

private:
  struct Entity;

  const CSwarmanoidSpace& space_;
  std::vector<Entity> entities_;
  std::optional<std::vector<double>> shown_;  // of all entities: whether they are there, and their colours
};

}  // namespace swarmanoid
