// Draws with experiment functions: ids and headings of robots, their trails, their centre and their spread. It does not
// change the run. The key C clears the trails; a selected robot gets a ring.
//
//   <drawn_swarm id="drawing" library="drawn_swarm">
//     <robots>footbot</robots>  tag of the robots
//     <every>5</every>          ticks between two points of a trail
//   </drawn_swarm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "common/space/entities_by_kind.h"
#include "space_server/experiment_functions.h"

namespace
{

using namespace swarmanoid;

class CDrawnSwarm : public CExperimentFunctions
{
public:
  static PluginDescription Description()
  {
    PluginDescription description;
    description.label = "drawn_swarm";
    description.brief = "draws ids, headings and ways of robots, their middle and how far they are spread";
    description.parameters = {{.name = "robots",
                               .type = ParameterType::kText,
                               .default_value = "footbot",
                               .description = "Tag of the robots."},
                              {.name = "every",
                               .type = ParameterType::kInteger,
                               .unit = "ticks",
                               .default_value = "5",
                               .description = "Time between two places of a way.",
                               .minimum = 1,
                               .maximum = 1e6}};
    return description;
  }

  void Init(const TConfigurationTree t_tree, SpaceEditor& space) override
  {
    every_ = static_cast<std::uint64_t>(t_tree.GetInteger("every"));
    robots_ = GetEntitiesByKind(space.GetSpace(), t_tree.GetText("robots"));
  }

  void PreStep(SpaceEditor& space) override
  {
    if (space.GetSpace().GetTick() % every_ != 0) return;
    for (const std::uint32_t robot : robots_)
      if (space.GetSpace().IsPresent(robot)) ways_[robot].push_back(space.GetSpace().GetPose(robot).position);
  }

  void Draw(const SpaceEditor& editor, Drawing& drawing) override
  {
    const CSwarmanoidSpace& space = editor.GetSpace();
    for (const auto& [robot, way] : ways_)
    {
      std::vector<Vector3> raised = way;
      for (Vector3& place : raised) place.z() += 0.005;
      drawing.Polyline(raised, {0x2060c0, 0.8, 2});
      drawing.Point(raised.front(), {0x2060c0, 1, 8});
    }

    Vector3 middle = Vector3::Zero();
    std::vector<Vector3> places;
    for (const std::uint32_t robot : robots_)
    {
      if (!space.IsPresent(robot)) continue;
      places.push_back(space.GetPose(robot).position);
      middle += places.back();
      // Drawings in the frame of the robot move with it.
      drawing.InFrameOf(robot);
      drawing.Text({0, 0, 0.3}, space.GetEntity(robot).GetId());
      drawing.Arrow({0.1, 0, 0.02}, {0.3, 0, 0.02}, {0xd02020, 1, 2});
      if (robot == selected_) drawing.Circle({{0, 0, 0.01}, Quaternion::Identity()}, 0.2, {0xc000c0, 1, 3});
      drawing.InSpace();
    }
    if (places.empty()) return;
    middle /= static_cast<double>(places.size());
    double squares = 0;
    for (const Vector3& place : places) squares += (place - middle).squaredNorm();
    const Pose on_floor{{middle.x(), middle.y(), 0.002}, Quaternion::Identity()};
    const double spread = std::sqrt(squares / static_cast<double>(places.size()));
    drawing.Disc(on_floor, spread, {0x20a040, 0.25});
    drawing.Circle(on_floor, spread, {0x20a040, 1, 2});
    drawing.Cylinder({{middle.x(), middle.y(), 0.1}, Quaternion::Identity()}, 0.02, 0.2, {0x20a040});
  }

  void Input(const UserInput& input, SpaceEditor&) override
  {
    if (input.kind == UserInput::Kind::kKeyPressed && input.key == "C") ways_.clear();
    if (input.kind == UserInput::Kind::kSelected) selected_ = input.entity->GetIndex();
    if (input.kind == UserInput::Kind::kDeselected) selected_ = kNobody;
  }

  // The trails are only drawn, so a restored run begins new ones.
  bool HasState() const override { return true; }

private:
  static constexpr std::uint32_t kNobody = ~0U;

  std::uint64_t every_ = 1;
  std::vector<std::uint32_t> robots_;
  std::map<std::uint32_t, std::vector<Vector3>> ways_;
  std::uint32_t selected_ = kNobody;
};

REGISTER_EXPERIMENT_FUNCTIONS(CDrawnSwarm, CDrawnSwarm::Description())

}  // namespace
