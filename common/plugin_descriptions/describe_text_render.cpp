#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

PluginDescription TextRenderDescription()
{
  PluginDescription description;
  description.label = "text_render";
  description.brief = "a table of all entities and their poses, one line an entity, to the screen or a file";
  description.parameters = {
      {"file", ParameterType::kText, "", "",
       "File to write to, taken from the run's folder; without it the table goes to the screen."},
      {"precision", ParameterType::kInteger, "", "3", "Number of decimals; trailing zeros are left out.", 0, 15},
      {"every", ParameterType::kInteger, "ticks", "1", "A table is written every so many ticks, and at the last one.",
       1, 1e15},
      {.name = "format",
       .type = ParameterType::kChoice,
       .default_value = "table",
       .description = "table: separated by tabs under a line that starts with #, an empty field after the first one; "
                      "tsv: the same without # and empty field; csv; json: one object a line.",
       .choices = {"table", "tsv", "csv", "json"}},
      {"columns", ParameterType::kText, "", "",
       "Titles of the columns to write, separated by commas; without it all but Engine, Host and State: who moves and "
       "who controls the entity, and the state of its controller as last heard."},
      {"entities", ParameterType::kText, "", "",
       "Tags of the entities to write (footbot, block), separated by commas; all without it."},
      {"status", ParameterType::kBoolean, "", "false",
       "Whether each table starts with a line on how the run goes: its pace, and which process is late."}};
  return description;
}

}  // namespace swarmanoid
