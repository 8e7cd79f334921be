#include <fmt/format.h>

#include "common/experiment/reference.h"
#include "common/experiment/schema_parts.h"
#include "common/space/space.h"
#include "studies/optimiser.h"
#include "studies/study.h"

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
  return Repeated(
      "set", "A fixed change of the experiment, like --set.",
      {
          Required(kText, "path", "", "The changed setting, as for --set: controllers.diffusion.parameters.velocity."),
          Required(kText, "value", "", "The value."),
      });
}

ElementSpec FactorElement()
{
  return Repeated(
      "factor", "A setting of the experiment that varies, and its values in order.",
      {
          Id("The name of the factor in tables, pictures and conditions."),
          Required(kText, "path", "", "The setting, as for --set. Several, separated by blanks, get the same value."),
          Optional(kText, "values", "", "",
                   "The values, separated by semicolons if there is one, otherwise by commas or blanks: 0.05, 0.1; or "
                   "1,2,0; 3,4,0."),
          InRange(Optional(kNumber, "from", "", "", "The first value of a range."), -1e300, 1e300),
          InRange(Optional(kNumber, "to", "", "", "The end of a range, a value of it if the steps meet it."), -1e300,
                  1e300),
          InRange(Optional(kNumber, "step", "", "", "The difference between the values of a range; or give count."), 0,
                  1e300),
          InRange(Optional(kInteger, "count", "", "", "The number of values of a range."), 1, 1e6),
          OneOf(Optional(kChoice, "scale", "", "linear",
                         "Equal differences or equal ratios, in a range with a count or in a search."),
                {"linear", "logarithmic"}),
          InRange(Optional(kNumber, "start", "", "", "The start of a search; the middle by default."), -1e300, 1e300),
      });
}

ElementSpec VariantsElement()
{
  ElementSpec variant =
      Repeated("variant", "One value of the factor: a change of the experiment, or another experiment.",
               {
                   Id("The value of the factor in tables and pictures."),
                   Optional(kPath, "experiment", "", "", "The experiment file of this variant; empty: the study's."),
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
      Optional(kText, "of", "", "",
               "Ids or patterns of entities (* any characters, ? one), separated by blanks; empty: all robots."),
  };
  if (of_each)
    all.push_back(Optional(kText, "aggregate", "", "mean",
                           "Columns over all entities, separated by blanks: mean, deviation, min, max, sum, median, "
                           "count, or quantiles such as q25."));
  for (ParameterSpec& parameter : own) all.push_back(std::move(parameter));
  return all;
}

std::vector<ParameterSpec> RegionParameters()
{
  return {
      Optional(kText, "entity", "", "", "The id of a body or an entity of the floor whose outline is the region; or:"),
      Place(Optional(kVector2, "centre", "m", "", "The centre of a disc, with radius; or:")),
      InRange(Optional(kNumber, "radius", "m", "", "The radius of the disc."), 0, kMostMetres),
      Place(Optional(kVector2, "min", "m", "", "A corner of a rectangle, with max.")),
      Place(Optional(kVector2, "max", "m", "", "The opposite corner.")),
  };
}

ElementSpec MetricsElement()
{
  ElementSpec element;
  element.tags = {"metrics"};
  element.description = "Measured quantities, without code. Absent entities are left out.";
  element.parameters = {
      InRange(Optional(kInteger, "every", "ticks", "0",
                       "The period of the rows of a run in the table. The last tick always has a row; 0: only that."),
              0, kLongestStudy),
  };
  element.children = {
      Repeated("distance", "The way that each entity has covered so far, in metres.", With({}, true)),
      Repeated("displacement", "The distance of each entity from the position where it was first seen, in metres.",
               With({}, true)),
      Repeated(
          "energy",
          "The energy that each robot with wheels has used so far, in joules: idle power, and work of the drive "
          "against resistance and for acceleration. Braking returns nothing.",
          With({InRange(Optional(kNumber, "idle", "W", "0", "Power that is always used: computer, sensors, radio."), 0,
                        1e6),
                InRange(Optional(kNumber, "resistance", "N", "0",
                                 "Rolling resistance of both wheels together, in joules a metre."),
                        0, 1e6),
                InRange(Optional(kNumber, "mass", "kg", "0", "The accelerated mass."), 0, 1e6),
                InRange(Optional(kNumber, "efficiency", "", "1",
                                 "The share of the drive's energy that becomes work: motors, gears."),
                        0.001, 1)},
               true)),
      Repeated("nearest_neighbour", "The distance from each entity to the nearest other one, in metres.",
               With({}, true)),
      Repeated("time_to_region",
               "The time at which each entity was first in a region, in seconds. Other entities have no value.",
               With(RegionParameters(), true)),
      Repeated("collisions",
               "Contacts that each robot has begun so far, with other robots, objects and walls. Robots and cylinders "
               "count as upright cylinders. The radius of a robot with a box for a body is its half diagonal.",
               With({InRange(Optional(kNumber, "gap", "m", "0.001", "Bodies closer than this touch."), 0, 1)}, true)),
      Repeated(
          "attribute", "An attribute of each entity: a number of its kind beside the pose.",
          With({Required(kText, "name", "", "The attribute, as in list plugins and the reference: battery, radio …"),
                InRange(Optional(kInteger, "element", "", "0", "The index of the number in the attribute."), 0, 1000)},
               true)),
      Repeated("published",
               "Values that controllers or experiment functions publish: Publish(*GetRobot(), {{\"name\", value}}) "
               "with a value for each robot, or Publish(space.GetSpace(), \"name\", value) with one.",
               With({Required(kText, "name", "", "The name in Publish."),
                     OneOf(Optional(kChoice, "by", "", "functions", "The publisher."), {"functions", "controllers"})},
                    true)),
      Repeated("polarisation", "The length of the mean of all headings: 1 if all are equal, near 0 if they are random.",
               With({}, false)),
      Repeated("dispersion",
               "The sum of the squared distances to the centroid, over four squared radii: the second moment, a "
               "measure of aggregation.",
               With({}, false)),
      Repeated("largest_cluster", "The share of all entities in the largest connected group.",
               With({InRange(Required(kNumber, "range", "m", "Two entities whose centres are this near are connected."),
                             0, kMostMetres)},
                    false)),
      Repeated("coverage", "The share of the arena, in square cells, that the centre of any entity has visited so far.",
               With({Size(Required(kNumber, "cell", "m", "The side of a cell."))}, false)),
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
      Required(kText, "metric", "", "The optimised quantity: a column of the table, at the end of the runs."),
      OneOf(Optional(kChoice, "goal", "", "max", "Whether large or small values are good."), {"max", "min"}),
      Optional(kText, "aggregate", "", "mean", "The statistic over the seeds of a point: mean, median, q25, min …"),
      InRange(Required(kInteger, "runs", "", "The maximum number of runs: points, each with all seeds."), 1,
              static_cast<double>(kMostRuns)),
      OneOf(Optional(kChoice, "algorithm", "", "crs",
                     "Global: crs, isres, direct. Local: sbplx, nelder_mead, bobyqa, cobyla."),
            SearchAlgorithms()),
      InRange(Optional(kInteger, "population", "", "0", "The population of crs and isres; 0: their own default."), 0,
              1e5),
      InRange(Optional(kNumber, "tolerance", "", "0.001",
                       "A local search ends if it moves less than this share of the ranges."),
              0, 1),
      InRange(Optional(kInteger, "patience", "points", "0",
                       "The search ends after this many points in a row without improvement; 0: it does not."),
              0, 1e6),
      InRange(Optional(kInteger, "random_seed", "", "1", "The seed of the algorithm's own random numbers."), 0,
              4294967295.0),
      InRange(Optional(kInteger, "fresh_seeds", "", "30",
                       "The number of further seeds for the best point, which the search did not use."),
              0, 1e5),
  };
  return element;
}

void WriteParameters(const std::vector<ParameterSpec>& parameters, std::string& page)
{
  if (parameters.empty()) return;
  page += "\n| parameter | type | unit | default | meaning |\n|---|---|---|---|---|\n";
  for (const ParameterSpec& parameter : parameters)
  {
    const std::string fallback = !parameter.default_value           ? "required"
                                 : parameter.default_value->empty() ? ""
                                                                    : "`" + *parameter.default_value + "`";
    page += fmt::format("| `{}` | {} | {} | {} | {} |\n", parameter.name, TypeText(parameter), parameter.unit, fallback,
                        parameter.description);
  }
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
        Required(kPath, "experiment", "", "The experiment file; relative paths start at the folder of the study."),
        InRange(Optional(kInteger, "ticks", "ticks", "0", "The length of each run; 0: the experiment's."), 0,
                kLongestStudy),
        Optional(
            kText, "seeds", "", "1",
            "Numbers and ranges, such as 1-30 or 1-10, 99. All points have these seeds and can be compared in pairs."),
        Optional(kBoolean, "cluster", "", "false", "Whether each run is a cluster of processes, or one process."),
        InRange(Optional(kInteger, "controller_hosts", "", "1", "The controller hosts of a cluster."), 1, 1000),
        Optional(kBoolean, "visualisations", "", "false", "Whether the visualisations of the experiment run."),
    };
    root.children = {SetElement(),
                     FactorElement(),
                     VariantsElement(),
                     ZipElement(),
                     Repeated("require", "Runs only points that fulfil a condition.",
                              {Required(kText, "condition", "",
                                        "Ids of factors, numbers, 'texts', and, or, not, comparisons, + - * / %, "
                                        "parentheses. In XML, < is written &lt;.")}),
                     MetricsElement(),
                     SearchElement()};
    return root;
  }();
  return schema;
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
      "The page is generated from the tables of the program (`StudyReference` in `studies/study_schema.cpp`).\n";
  Write(StudySchema(), "", page);
  return page;
}

}  // namespace swarmanoid
