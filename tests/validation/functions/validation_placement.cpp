// Puts entities elsewhere at given ticks, also into others, so that a script can measure how engines part them.
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "space_server/experiment_functions.h"

namespace
{

using namespace swarmanoid;

class CValidationPlacement : public CExperimentFunctions
{
public:
  static PluginDescription Description()
  {
    PluginDescription description;
    description.label = "validation_placement";
    description.brief = "puts entities elsewhere at given ticks";
    description.parameters = {
        {.name = "moves",
         .type = ParameterType::kText,
         .default_value = "",
         .description = "Tick, entity, x, y and heading (m, degrees) of each move, with semicolons between them."}};
    return description;
  }

  void Init(const TConfigurationTree t_tree, SpaceEditor&) override
  {
    std::istringstream moves(t_tree.GetText("moves"));
    for (std::string line; std::getline(moves, line, ';');)
    {
      std::istringstream words(line);
      Move move;
      if (words >> move.tick >> move.entity >> move.x >> move.y >> move.heading) moves_.push_back(move);
    }
  }

  void PreStep(SpaceEditor& space) override
  {
    for (const Move& move : moves_)
    {
      if (move.tick != space.GetSpace().GetTick()) continue;
      const double heading = move.heading * std::numbers::pi / 180;
      space.MoveEntity(move.entity,
                       {Vector3(move.x, move.y, 0), Quaternion(Eigen::AngleAxisd(heading, Vector3::UnitZ()))},
                       EOccupied::kOverlap);
    }
  }

private:
  struct Move
  {
    std::uint64_t tick = 0;
    std::string entity;
    double x = 0, y = 0, heading = 0;
  };
  std::vector<Move> moves_;
};

REGISTER_EXPERIMENT_FUNCTIONS(CValidationPlacement, CValidationPlacement::Description())

}  // namespace
