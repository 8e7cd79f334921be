#include <fmt/format.h>

#include "common/experiment/reference.h"
#include "common/experiment/schema_parts.h"
#include "common/space/space.h"
#include "studies/design/study.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

constexpr double kLongestStudy = 1e15;  // ticks, as for an experiment

ElementSpec Repeated(const char* tag, const char* description, std::vector<ParameterSpec> parameters)
{
  ElementSpec element;
  element.tags = {tag};
  element.description = description;
  element.parameters = std::move(parameters);
  element.repeatable = true;
  return element;
}

ElementSpec SetElement()
{
  return Repeated("set", "A fixed change of the experiment, like --set.",
                  {
                      {"path", kText, "", std::nullopt,
                       "The changed setting, as for --set: controllers.diffusion.parameters.velocity."},
                      {"value", kText, "", std::nullopt, "The value."},
                  });
}

ElementSpec FactorElement()
{
  return Repeated(
      "factor", "A setting of the experiment that varies, and its values in order.",
      {
          Id("The name of the factor in tables, pictures and conditions."),
          {"path", kText, "", std::nullopt,
           "The setting, as for --set. Several, separated by blanks, get the same value."},
          {"values", kText, "", "",
           "The values, separated by semicolons if there is one, otherwise by commas or blanks: 0.05, 0.1; or 1,2,0; "
           "3,4,0."},
          {"from", kNumber, "", "", "The first value of a range.", -1e300, 1e300},
          {"to", kNumber, "", "", "The end of a range, a value of it if the steps meet it.", -1e300, 1e300},
          {"step", kNumber, "", "", "The difference between the values of a range; or give count.", 0, 1e300},
          {"count", kInteger, "", "", "The number of values of a range.", 1, 1e6},
          OneOf({"scale", kChoice, "", "linear",
                 "Equal differences or equal ratios, in a range with a count or in a search."},
                {"linear", "logarithmic"}),
          {"start", kNumber, "", "", "The start of a search; the middle by default.", -1e300, 1e300},
      });
}

ElementSpec VariantsElement()
{
  ElementSpec variant =
      Repeated("variant", "One value of the factor: a change of the experiment, or another experiment.",
               {
                   Id("The value of the factor in tables and pictures."),
                   {"experiment", kPath, "", "", "The experiment file of this variant; empty: the study's."},
               });
  variant.children = {SetElement()};
  ElementSpec element =
      Repeated("variants", "A factor whose values are not numbers: controllers, engines, whole experiments.",
               {Id("The name of the factor in tables, pictures and conditions.")});
  element.children = {variant};
  return element;
}

ElementSpec ZipElement()
{
  ElementSpec element = Repeated(
      "zip",
      "Factors that vary together: the first value of each, then the second. All have the same number of values.", {});
  element.children = {FactorElement(), VariantsElement()};
  return element;
}

std::vector<ParameterSpec> With(std::vector<ParameterSpec> own, bool of_each)
{
  std::vector<ParameterSpec> all{
      Id("The name of the metric: its column in tables, or the start of it."),
      {"of", kText, "", "",
       "Ids or patterns of entities (* any characters, ? one), separated by blanks; empty: all robots."},
  };
  if (of_each)
    all.push_back({"aggregate", kText, "", "mean",
                   "Columns over all entities, separated by blanks: mean, deviation, min, max, sum, median, count, or "
                   "quantiles such as q25."});
  for (ParameterSpec& parameter : own) all.push_back(std::move(parameter));
  return all;
}

ParameterSpec UnitParameter() { return {"unit", kText, "", "", "The unit of the values, for pictures and tables."}; }

std::vector<ParameterSpec> RegionParameters()
{
  return {
      {"entity", kText, "", "", "The id of a body or an entity of the floor whose outline is the region; or:"},
      Place({"centre", kVector2, "m", "", "The centre of a disc, with radius; or:"}),
      {"radius", kNumber, "m", "", "The radius of the disc.", 0, kMostMetres},
      Place({"min", kVector2, "m", "", "A corner of a rectangle, with max."}),
      Place({"max", kVector2, "m", "", "The opposite corner."}),
  };
}

ElementSpec MetricsElement()
{
  ElementSpec element;
  element.tags = {"metrics"};
  element.description = "Measured quantities, without code. Absent entities are left out.";
  element.parameters = {
      {"every", kInteger, "ticks", "0",
       "The period of the rows of a run in the table. The last tick always has a row; 0: only that.", 0, kLongestStudy},
  };
  element.children = {
      Repeated("distance", "The way that each entity has covered so far, in metres.", With({}, true)),
      Repeated("displacement", "The distance of each entity from the position where it was first seen, in metres.",
               With({}, true)),
      Repeated("energy",
               "The energy that each robot with wheels has used so far, in joules: idle power, and work of the drive "
               "against resistance and for acceleration. Braking returns nothing.",
               With({{"idle", kNumber, "W", "0", "Power that is always used: computer, sensors, radio.", 0, 1e6},
                     {"resistance", kNumber, "N", "0", "Rolling resistance of both wheels together, in joules a metre.",
                      0, 1e6},
                     {"mass", kNumber, "kg", "0", "The accelerated mass.", 0, 1e6},
                     {"efficiency", kNumber, "", "1",
                      "The share of the drive's energy that becomes work: motors, gears.", 0.001, 1}},
                    true)),
      Repeated("battery", "The energy_battery of each robot.",
               With({OneOf({"value", kChoice, "", "charge",
                            "charge: its energy (J); used: energy that the robot used so far (J); charged: energy that "
                            "it got so far (J); power: what it used in the last tick (W); empty: 1 if it is empty or "
                            "has switched the robot off, otherwise 0."},
                           {"charge", "used", "charged", "power", "empty"})},
                    true)),
      Repeated("nearest_neighbour", "The distance from each entity to the nearest other one, in metres.",
               With({}, true)),
      Repeated("time_to_region",
               "The time at which each entity was first in a region, in seconds. Other entities have no value.",
               With(RegionParameters(), true)),
      Repeated("collisions",
               "Contacts that each robot has begun so far, with other robots, objects and walls. Robots and cylinders "
               "count as upright cylinders. The radius of a robot with a box for a body is its half diagonal.",
               With({{"gap", kNumber, "m", "0.001", "Bodies closer than this touch.", 0, 1}}, true)),
      Repeated("attribute", "An attribute of each entity: a number of its kind beside the pose.",
               With({{"name", kText, "", std::nullopt,
                      "The attribute, as in list plugins and the reference: battery, radio …"},
                     {"element", kInteger, "", "0", "The index of the number in the attribute.", 0, 1000},
                     UnitParameter()},
                    true)),
      Repeated("published",
               "Values that controllers or experiment functions publish: Publish(*GetRobot(), {{\"name\", value}}) "
               "with a value for each robot, or Publish(space.GetSpace(), \"name\", value) with one.",
               With({{"name", kText, "", std::nullopt, "The name in Publish."},
                     OneOf({"by", kChoice, "", "functions", "The publisher."}, {"functions", "controllers"}),
                     UnitParameter()},
                    true)),
      Repeated("polarisation", "The length of the mean of all headings: 1 if all are equal, near 0 if they are random.",
               With({}, false)),
      Repeated("dispersion",
               "The sum of the squared distances to the centroid, over four squared radii: the second moment, a "
               "measure of aggregation.",
               With({}, false)),
      Repeated("largest_cluster", "The share of all entities in the largest connected group.",
               With({{"range", kNumber, "m", std::nullopt, "Two entities whose centres are this near are connected.", 0,
                      kMostMetres}},
                    false)),
      Repeated("coverage", "The share of the arena, in square cells, that the centre of any entity has visited so far.",
               With({Size({"cell", kNumber, "m", std::nullopt, "The side of a cell."})}, false)),
      Repeated("in_region", "The number of entities in a region.", With(RegionParameters(), false)),
      Repeated("trajectories", "The ways of all entities, for pictures. It has no column.", With({}, false)),
  };
  return element;
}

ElementSpec SearchElement()
{
  ElementSpec element;
  element.tags = {"search"};
  element.description =
      "Searches for the best values of factors with from and to, instead of running all combinations. A step makes "
      "their values whole numbers, or others that far apart.";
  element.parameters = {
      {"metric", kText, "", std::nullopt, "The optimised quantity: a column of the table, at the end of the runs."},
      OneOf({"goal", kChoice, "", "max", "Whether large or small values are good."}, {"max", "min"}),
      {"aggregate", kText, "", "mean", "The statistic over the seeds of a point: mean, median, q25, min …"},
      {"runs", kInteger, "", std::nullopt, "The maximum number of runs: points, each with all seeds.", 1,
       static_cast<double>(kMostRuns)},
      OneOf(
          {"algorithm", kChoice, "", "crs",
           "Global: crs, isres, cma_es, direct. Local: sbplx, nelder_mead, bobyqa, cobyla. For noisy values and lists: "
           "race."},
          {kSearchAlgorithms.begin(), kSearchAlgorithms.end()}),
      {"population", kInteger, "", "0",
       "The population of crs, isres and cma_es, or the candidates of a race; 0: their own default.", 0, 1e5},
      {"tolerance", kNumber, "", "0.001",
       "A local search ends, and cma_es begins again, if it moves less than this share of the ranges.", 0, 1},
      {"patience", kInteger, "points", "0",
       "The search ends after this many points in a row without improvement; 0: it does not.", 0, 1e6},
      {"random_seed", kInteger, "", "1", "The seed of the algorithm's own random numbers.", 0, 4294967295.0},
      {"fresh_seeds", kInteger, "", "30",
       "The number of further seeds for the best point, which the search did not use.", 0, 1e5},
  };
  return element;
}

void WriteParameters(const std::vector<ParameterSpec>& parameters, std::string& page)
{
  if (parameters.empty()) return;
  page += "\n| parameter | type | unit | default | meaning |\n|---|---|---|---|---|\n";
  TableNotes notes;
  for (const ParameterSpec& parameter : parameters)
  {
    const std::string fallback = !parameter.default_value           ? "required"
                                 : parameter.default_value->empty() ? ""
                                                                    : "`" + *parameter.default_value + "`";
    page += fmt::format("| `{}` | {} | {} | {} | {} |\n", parameter.name, TypeText(parameter), parameter.unit, fallback,
                        notes.Cell(parameter));
  }
  page += notes.List();
}

// Returns whether the page describes a metric's parameter once, at <metrics>.
bool IsShared(const ParameterSpec& parameter)
{
  return parameter.name == "id" || parameter.name == "of" || parameter.name == "aggregate";
}

// Writes one element of the page and its child elements.
void Write(const ElementSpec& element, const std::string& parent, std::string& page)
{
  const bool is_metric = parent == "metrics";
  page += fmt::format("\n## `<{}>`\n\n{}\n", element.Name(), element.description);
  if (!parent.empty()) page += fmt::format("\nIn `<{}>`{}.", parent, element.repeatable ? ", any number of times" : "");
  if (is_metric)
    page += IsOfEachEntity(element.Name()) ? " It also has `id`, `of` and `aggregate`." : " It also has `id` and `of`.";
  if (!parent.empty()) page += "\n";

  std::vector<ParameterSpec> own;
  for (const ParameterSpec& parameter : element.parameters)
    if (!is_metric || !IsShared(parameter)) own.push_back(parameter);
  WriteParameters(own, page);

  if (element.Name() == "metrics")
  {
    page += "\nAll metrics have `id` and `of`. Metrics with a value for each entity also have `aggregate`:\n";
    WriteParameters(With({}, true), page);
  }
  for (const ElementSpec& child : element.children)
    if (page.find("## `<" + child.Name() + ">`") == std::string::npos) Write(child, element.Name(), page);
}

}  // namespace

const ElementSpec& StudySchema()
{
  static const ElementSpec schema = []
  {
    ElementSpec root;
    root.tags = {"study"};
    root.description = "A study: many runs of an experiment.";
    root.required = true;
    root.parameters = {
        {"experiment", kPath, "", std::nullopt,
         "The experiment file; relative paths start at the folder of the study."},
        {"ticks", kInteger, "ticks", "0", "The length of each run; 0: the experiment's.", 0, kLongestStudy},
        {"seeds", kText, "", "1",
         "Numbers and ranges, such as 1-30 or 1-10, 99. All points have these seeds and can be compared in pairs."},
        {"cluster", kBoolean, "", "false", "Whether each run is a cluster of processes, or one process."},
        {"controller_hosts", kInteger, "", "1", "The controller hosts of a cluster.", 1, 1000},
        {"visualisations", kBoolean, "", "false", "Whether the visualisations of the experiment run."},
    };
    root.children = {SetElement(),
                     FactorElement(),
                     VariantsElement(),
                     ZipElement(),
                     Repeated("require", "Runs only points that fulfil a condition.",
                              {{"condition", kText, "", std::nullopt,
                                "Ids of factors, numbers, 'texts', and, or, not, comparisons, + - * / %, parentheses. "
                                "In XML, < is written &lt;."}}),
                     MetricsElement(),
                     SearchElement()};
    return root;
  }();
  return schema;
}

std::string MetricUnit(const MetricChoice& choice)
{
  if (choice.kind == "distance" || choice.kind == "displacement" || choice.kind == "nearest_neighbour") return "m";
  if (choice.kind == "time_to_region") return "s";
  if (choice.kind == "energy") return "J";
  if (choice.kind == "battery")
  {
    const std::string value = choice.tree.Value("value").value_or("charge");
    if (value == "empty") return "";
    return value == "power" ? "W" : "J";
  }
  return choice.tree.Value("unit").value_or("");
}

bool IsOfEachEntity(const std::string& metric_kind)
{
  const ElementSpec& metric = StudySchema().Child("metrics").Child(metric_kind);
  for (const ParameterSpec& parameter : metric.parameters)
    if (parameter.name == "aggregate") return true;
  return false;
}

std::string StudyReference()
{
  std::string page =
      "# Study files: elements\n\nThis page lists all elements and parameters of study files. [Studies](studies.md) "
      "explains them, with examples.\nA parameter may be written as an attribute or as an element.\n\n"
      "```xml\n<study experiment=\"diffusion_10.xml\" seeds=\"1-3\">\n"
      "  <metrics><distance id=\"travelled\"/></metrics>\n</study>\n```\n\n"
      "The page is generated from the tables of the program (`StudyReference` in `studies/design/study_schema.cpp`).\n";
  Write(StudySchema(), "", page);
  return page;
}

}  // namespace swarmanoid
