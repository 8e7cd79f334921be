// Counts the passages of robots over two bridges, and wipes the trails if the experiment asks for it. Publishes the
// share of the shorter bridge.
//
//   <two_bridges id="count" library="two_bridges">
//     <field>trail</field>        the field of the trails
//     <border>2.5</border>        y (m) below which a robot is on the shorter bridge
//     <line>4</line>              x (m) that a robot passes in the middle of either bridge
//     <count_from>0</count_from>  tick from which passages count
//     <wipe_at>0</wipe_at>        tick at which the trails vanish; 0: never
//   </two_bridges>
#include <istream>
#include <ostream>
#include <vector>

#include "common/space/entities_by_kind.h"
#include "common/space/publish.h"
#include "space_server/experiment_functions.h"

namespace
{

using namespace swarmanoid;

ParameterSpec Metres(const char* name, const char* value, const char* description)
{
  return {
      .name = name, .unit = "m", .default_value = value, .description = description, .minimum = -1e6, .maximum = 1e6};
}

class CTwoBridges : public CExperimentFunctions
{
public:
  static PluginDescription Description()
  {
    PluginDescription description;
    description.label = "two_bridges";
    description.brief = "counts the passages of robots over two bridges, and may wipe the trails";
    description.parameters = {{.name = "field",
                               .type = ParameterType::kText,
                               .default_value = "trail",
                               .description = "Id of the floor field that is wiped."},
                              Metres("border", "2.5", "y below which a robot is on the shorter bridge."),
                              Metres("line", "4", "x that a robot passes in the middle of either bridge."),
                              {.name = "count_from",
                               .type = ParameterType::kInteger,
                               .unit = "ticks",
                               .default_value = "0",
                               .description = "Tick from which on passages are counted.",
                               .minimum = 0,
                               .maximum = 1e12},
                              {.name = "wipe_at",
                               .type = ParameterType::kInteger,
                               .unit = "ticks",
                               .default_value = "0",
                               .description = "Tick at which the field becomes 0; 0: never.",
                               .minimum = 0,
                               .maximum = 1e12}};
    return description;
  }

  void Init(const TConfigurationTree t_tree, SpaceEditor& space) override
  {
    field_ = t_tree.GetText("field");
    border_m_ = t_tree.GetNumber("border");
    line_m_ = t_tree.GetNumber("line");
    count_from_ = static_cast<std::uint64_t>(t_tree.GetInteger("count_from"));
    wipe_at_ = static_cast<std::uint64_t>(t_tree.GetInteger("wipe_at"));
    robots_ = GetEntitiesByKind(space.GetSpace(), "footbot");
    if (wipe_at_ > 0) space.GetSpace().Fields().NumberOf(field_);
    for (const std::uint32_t robot : robots_) is_beyond_.push_back(IsBeyond(space.GetSpace(), robot));
  }

  void PostStep(SpaceEditor& editor) override
  {
    const CSwarmanoidSpace& space = editor.GetSpace();
    if (wipe_at_ > 0 && space.GetTick() == wipe_at_) Wipe(editor);
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      const bool is_beyond = IsBeyond(space, robots_[k]);
      if (is_beyond == is_beyond_[k]) continue;
      is_beyond_[k] = is_beyond;
      if (space.GetTick() >= count_from_)
        ++(space.GetPose(robots_[k]).position.y() < border_m_ ? over_shorter_ : over_longer_);
    }
    const auto all = static_cast<double>(over_shorter_ + over_longer_);
    Publish(space, "on_shorter", all > 0 ? static_cast<double>(over_shorter_) / all : 0.5);
  }

  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override
  {
    state << over_shorter_ << ' ' << over_longer_;
    for (const bool is_beyond : is_beyond_) state << ' ' << is_beyond;
  }
  void LoadState(std::istream& state) override
  {
    state >> over_shorter_ >> over_longer_;
    for (std::size_t k = 0; k < is_beyond_.size(); ++k)
    {
      bool is_beyond = false;
      state >> is_beyond;
      is_beyond_[k] = is_beyond;
    }
  }

private:
  bool IsBeyond(const CSwarmanoidSpace& space, std::uint32_t robot) const
  {
    return space.GetPose(robot).position.x() > line_m_;
  }

  void Wipe(SpaceEditor& editor) const
  {
    std::vector<std::size_t> cells;
    editor.GetSpace().Fields().Field(field_).VisitRuns(
        [&](std::size_t first, std::span<const float> run)
        {
          for (std::size_t k = 0; k < run.size(); ++k) cells.push_back(first + k);
        });
    for (const std::size_t cell : cells) editor.SetFieldCell(field_, cell, 0);
  }

  std::string field_;
  double border_m_ = 0, line_m_ = 0;
  std::uint64_t count_from_ = 0, wipe_at_ = 0;
  std::vector<std::uint32_t> robots_;
  std::vector<bool> is_beyond_;  // the line, by robot
  std::uint64_t over_shorter_ = 0, over_longer_ = 0;
};

REGISTER_EXPERIMENT_FUNCTIONS(CTwoBridges, CTwoBridges::Description())

}  // namespace
