// The frames of an SDF file. A pose stands in the frame that its attribute relative_to names, or in one that depends on
// its element. Rules: http://sdformat.org/tutorials?tut=pose_frame_semantics_proposal
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "launcher/worlds/world_reader.h"

namespace swarmanoid
{

// The frames of one <model> or <world>, by name.
class SdfScope : WorldReader
{
public:
  // `element`: the <model> or <world>. `open_frames`: the count of the scope around it; nullptr: none is around it.
  SdfScope(const ConfigurationNode& element, World& world, int* open_frames = nullptr);
  SdfScope(const SdfScope&) = delete;
  SdfScope& operator=(const SdfScope&) = delete;

  // Returns the pose of an element of this scope in the frame of the scope. Its <pose> is relative to `default_frame`
  // unless it names another one; an empty name is the scope's own frame. Mistakes are reported once; the pose is then
  // that of its numbers.
  Pose PoseOf(const ConfigurationNode& element, const std::string& default_frame = {});
  // Returns the scope of a nested model, one of the children of this one.
  SdfScope& Nested(const ConfigurationNode& model);

private:
  struct Frame
  {
    const ConfigurationNode* element = nullptr;
    std::string default_frame;
    bool is_open = false;  // its pose is being computed
    std::optional<Pose> pose;
  };

  // Returns the numbers of the element's <pose>.
  Pose RawPose(const ConfigurationNode& element);
  // Returns the pose of a frame; nullopt if it does not exist or is relative to itself.
  std::optional<Pose> Find(const std::string& name, const SourceLocation& asked_at);
  void MissingFrame(const std::string& name, const SourceLocation& asked_at);

  const ConfigurationNode& element_;
  int own_count_ = 0;
  int* open_frames_;  // frames of all scopes whose poses are being computed, each for the one before
  std::map<std::string, Frame> frames_;
  std::map<const ConfigurationNode*, std::unique_ptr<SdfScope>> nested_;
};

}  // namespace swarmanoid
