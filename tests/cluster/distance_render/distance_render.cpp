// A user's renderer prints a table of how far entities are from the origin of the arena.
#include "visualiser/text/text_render.h"

using swarmanoid::CTextRender;
using swarmanoid::PluginDescription;

namespace
{

class CDistanceRender : public CTextRender
{
protected:
  std::vector<Column> Columns() const override
  {
    return {{"Entity id", false,
             [](const swarmanoid::CSwarmanoidSpaceEntity& entity, std::string& line) { line += entity.GetId(); }},
            {"distance", true, [this](const swarmanoid::CSwarmanoidSpaceEntity& entity, std::string& line) {
               AppendNumber(entity.GetPosition().norm(), line);
             }}};
  }
};

}  // namespace

REGISTER_RENDER(CDistanceRender,
                []
                {
                  PluginDescription description = CTextRender::Description();
                  description.label = "distance_render";
                  description.brief = "a table of the distances from the origin";
                  return description;
                }())
