#include "launcher/worlds/sdf_frames.h"

#include <fmt/format.h>

#include <vector>

#include "common/configuration/wording.h"
#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

// Poses of frames are found by recursion, which a longer chain could take through the end of the stack.
constexpr int kMostOpenFrames = 1000;
constexpr std::size_t kMostListed = 20;
constexpr double kMostRadians = 1e5;  // SinCosOf is exact up to it

}  // namespace

SdfScope::SdfScope(const ConfigurationNode& element, World& world, int* open_frames)
    : WorldReader(world, true), element_(element), open_frames_(open_frames == nullptr ? &own_count_ : open_frames)
{
  for (const auto& child : element.children)
  {
    const std::string& kind = child->name;
    if (kind != "link" && kind != "frame" && kind != "model" && kind != "joint") continue;
    std::string default_frame;
    if (kind == "frame") default_frame = TextOf(*child, "attached_to");
    if (const ConfigurationNode* link = kind == "joint" ? Child(*child, "child") : nullptr) default_frame = link->text;
    const std::string name = TextOf(*child, "name");
    if (name.empty())
      Mistake(child->location, fmt::format("a <{}> needs a name", kind));
    else if (const auto [there, is_new] = frames_.insert({name, {child.get(), default_frame, false, {}}});
             !is_new && there->second.element->name == kind)  // SDF 1.6 allows a link and a joint of one name
      Mistake(child->location, fmt::format("the name {} is there twice in <{}>", Quoted(name), element.name));
  }
}

Pose SdfScope::RawPose(const ConfigurationNode& element)
{
  const ConfigurationNode* pose = Child(element, "pose");
  if (pose == nullptr || pose->text.empty()) return {};
  NoteOthers(*pose, {"relative_to", "degrees", "rotation_format", "frame"});
  const std::string format = TextOf(*pose, "rotation_format");
  const std::string what = fmt::format("<pose> of <{}>", element.name);
  if (format == "quat_xyzw")
  {
    const auto n = Numbers(pose->location, pose->text, what, {0, 0, 0, 0, 0, 0, 1});
    const Quaternion turn(n[6], n[3], n[4], n[5]);
    if (!(turn.norm() > 1e-6))
    {
      Mistake(pose->location, what + " has a rotation of length 0");
      return {};
    }
    return {Near(pose->location, {n[0], n[1], n[2]}, what), turn.normalized()};
  }
  if (!format.empty() && format != "euler_rpy")
    Mistake(pose->location, fmt::format("'rotation_format' is {}; it must be euler_rpy or quat_xyzw", Quoted(format)));
  const auto n = Numbers(pose->location, pose->text, what, {0, 0, 0, 0, 0, 0});
  const std::string degrees = TextOf(*pose, "degrees");
  const double unit = degrees == "true" || degrees == "1" ? DegreesToRadians(1) : 1;
  const Vector3 angles = unit * Vector3(n[3], n[4], n[5]);
  if (angles.cwiseAbs().maxCoeff() > kMostRadians)
    Mistake(pose->location, fmt::format("{} has an angle of more than {:g} rad", what, kMostRadians));
  return {Near(pose->location, {n[0], n[1], n[2]}, what),
          QuaternionFromEuler({WrapAngle(angles.x()), WrapAngle(angles.y()), WrapAngle(angles.z())})};
}

void SdfScope::MissingFrame(const std::string& name, const SourceLocation& asked_at)
{
  std::vector<std::string> names;
  for (const auto& [known, frame] : frames_)
    if (names.push_back(known); names.size() == kMostListed) break;
  Mistake(asked_at, fmt::format("<{}> has no frame {}; it has: {}{}", element_.name, Quoted(name), Listed(names),
                                DidYouMean(name, names)));
}

std::optional<Pose> SdfScope::Find(const std::string& name, const SourceLocation& asked_at)
{
  if (name.empty() || name == (element_.name == "world" ? "world" : "__model__")) return Pose();
  const std::size_t colons = name.find("::");
  const auto found = frames_.find(name.substr(0, colons));
  if (found == frames_.end())
  {
    MissingFrame(name, asked_at);
    return std::nullopt;
  }
  Frame& frame = found->second;
  if (frame.is_open)
  {
    Mistake(asked_at, fmt::format("the frame {} is relative to itself", Quoted(name)));
    return std::nullopt;
  }
  if (!frame.pose)
  {
    if (*open_frames_ >= kMostOpenFrames)
    {
      Mistake(asked_at, fmt::format("more than {} frames are relative to each other", kMostOpenFrames));
      return std::nullopt;
    }
    frame.is_open = true;
    ++*open_frames_;
    frame.pose = PoseOf(*frame.element, frame.default_frame);
    --*open_frames_;
    frame.is_open = false;
  }
  if (colons == std::string::npos) return frame.pose;
  if (frame.element->name != "model")
  {
    MissingFrame(name, asked_at);
    return std::nullopt;
  }
  const auto inner = Nested(*frame.element).Find(name.substr(colons + 2), asked_at);
  return inner ? std::optional(frame.pose->Compose(*inner)) : std::nullopt;
}

Pose SdfScope::PoseOf(const ConfigurationNode& element, const std::string& default_frame)
{
  Pose pose = RawPose(element);
  const ConfigurationNode* written = Child(element, "pose");
  const std::string named = written == nullptr ? std::string() : TextOf(*written, "relative_to");
  const SourceLocation& at = written == nullptr ? element.location : written->location;
  if (const auto frame = Find(named.empty() ? default_frame : named, at)) pose = frame->Compose(pose);
  // The pose of a model may be that of one of its frames.
  const std::string placed = element.name == "model" ? TextOf(element, "placement_frame") : std::string();
  if (!placed.empty())
    if (const auto inner = Nested(element).Find(placed, element.location)) pose = pose.Compose(inner->Inverse());
  return pose;
}

SdfScope& SdfScope::Nested(const ConfigurationNode& model)
{
  std::unique_ptr<SdfScope>& scope = nested_[&model];
  if (scope == nullptr) scope = std::make_unique<SdfScope>(model, world_, open_frames_);
  return *scope;
}

}  // namespace swarmanoid
