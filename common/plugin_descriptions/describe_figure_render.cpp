#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

PluginDescription FigureRenderDescription()
{
  PluginDescription description;
  description.label = "figure_render";
  description.brief =
      "plans of the arena for papers: vector graphics (SVG, PDF) with legend and scale, one or several ticks on a page";
  description.parameters = {
      {"file", ParameterType::kText, "", "figure.svg",
       "The file, taken from the run's folder: .svg or .pdf for lines that are sharp at any size, or .png."},
      {"ticks", ParameterType::kText, "ticks", "",
       "Ticks with commas between them, each a panel of the page; without it the last state of the run."},
      {"columns", ParameterType::kInteger, "", "0", "Panels beside each other; 0: up to three.", 0, 20},
      {"width", ParameterType::kNumber, "mm", "120", "Of the page; its height follows.", 20, 2000},
      {"font", ParameterType::kNumber, "pt", "7", "Height of the letters.", 2, 100},
      {"dpi", ParameterType::kNumber, "", "300", "Pixels an inch of a PNG.", 30, 1200},
      {"region", ParameterType::kText, "m", "",
       "The part of the arena that is shown, as x0, y0, x1, y1; all of it without."},
      {"inset", ParameterType::kText, "m", "",
       "A part of the arena, as x0, y0, x1, y1, that is also shown larger in a corner of each panel."},
      {.name = "inset_corner",
       .type = ParameterType::kChoice,
       .default_value = "top_right",
       .description = "In which corner.",
       .choices = {"top_left", "top_right", "bottom_left", "bottom_right"}},
      {"show_legend", ParameterType::kBoolean, "", "true", "Whether a legend names what there is, and how many."},
      {"show_scale", ParameterType::kBoolean, "", "true", "Whether a bar tells how long a metre is."},
      {"show_axes", ParameterType::kBoolean, "", "false", "Whether each panel has axes in metres."},
      {"show_ids", ParameterType::kBoolean, "", "false", "Whether robots and what else moves have their ids."},
      {"show_trails", ParameterType::kBoolean, "", "false",
       "Whether all ways since the first tick are drawn, those of robots in their colours, of others dashed."},
      {"stop", ParameterType::kBoolean, "", "false",
       "Whether the run, or the watching where it is attached, ends after the last of the ticks."}};
  return description;
}

}  // namespace swarmanoid
