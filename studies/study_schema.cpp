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

constexpr double kLongestStudy = 1e15;  // ticks, as of an experiment

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
      "set", "A fixed change of the experiment, as by --set.",
      {
          Required(kText, "path", "", "What is changed, as for --set: controllers.diffusion.parameters.velocity."),
          Required(kText, "value", "", "The value."),
      });
}

ElementSpec FactorElement()
{
  return Repeated(
      "factor", "What varies: a path of the experiment, and the values that it has, one after the other.",
      {
          Id("The name of the factor in tables, pictures and conditions."),
          Required(kText, "path", "", "As for --set; several, separated by blanks, get the same value."),
          Optional(kText, "values", "", "",
                   "The values, separated by semicolons if there is one, else by commas or blanks: 0.05, 0.1; or "
                   "1,2,0; 3,4,0."),
          InRange(Optional(kNumber, "from", "", "", "The first value of a range."), -1e300, 1e300),
          InRange(
              Optional(kNumber, "to", "", "", "The last value of a range, which is one of it if the steps meet it."),
              -1e300, 1e300),
          InRange(Optional(kNumber, "step", "", "", "From one value of a range to the next; or give count."), 0, 1e300),
          InRange(Optional(kInteger, "count", "", "", "How many values a range has."), 1, 1e6),
          OneOf(Optional(kChoice, "scale", "", "linear",
                         "Of a range with a count, or one of a search: equal differences, or equal ratios."),
                {"linear", "logarithmic"}),
          InRange(Optional(kNumber, "start", "", "", "Where a search begins; otherwise in the middle."), -1e300, 1e300),
      });
}

ElementSpec VariantsElement()
{
  ElementSpec variant = Repeated(
      "variant", "One of them: a change of the experiment, or an experiment of its own.",
      {
          Id("Its name, the value of the factor in tables and pictures."),
          Optional(kPath, "experiment", "", "", "The experiment file of this variant; empty: that of the study."),
      });
  variant.children = {SetElement()};
  ElementSpec element =
      Repeated("variants", "A factor whose values are no numbers: controllers, engines, whole experiments.",
               {Id("The name of the factor in tables, pictures and conditions.")});
  element.children = {variant};
  return element;
}

ElementSpec ZipElement()
{
  ElementSpec element = Repeated(
      "zip", "Factors that vary together: their first values, then their second ones. All have equally many.", {});
  element.children = {FactorElement(), VariantsElement()};
  return element;
}

std::vector<ParameterSpec> With(std::vector<ParameterSpec> own, bool of_each)
{
  std::vector<ParameterSpec> all{
      Id("The name of the metric: its column in tables, or the beginning of it."),
      Optional(kText, "of", "", "",
               "Which entities: ids or patterns (* any characters, ? one), separated by blanks; empty: all robots."),
  };
  if (of_each)
    all.push_back(
        Optional(kText, "aggregate", "", "mean",
                 "What of the values of all entities becomes a column: mean, deviation, min, max, sum, median, "
                 "count, or a quantile such as q25; several, separated by blanks."));
  for (ParameterSpec& parameter : own) all.push_back(std::move(parameter));
  return all;
}

std::vector<ParameterSpec> RegionParameters()
{
  return {
      Optional(kText, "entity", "", "", "The id of an entity of the floor or a body, whose outline is the region; or:"),
      Place(Optional(kVector2, "centre", "m", "", "The centre of a disc, with radius; or:")),
      InRange(Optional(kNumber, "radius", "m", "", "Of the disc."), 0, kMostMetres),
      Place(Optional(kVector2, "min", "m", "", "A corner of a rectangle, with max.")),
      Place(Optional(kVector2, "max", "m", "", "The opposite corner.")),
  };
}

ElementSpec MetricsElement()
{
  ElementSpec element;
  element.tags = {"metrics"};
  element.description = "What is measured, without code. Absent entities are left out.";
  element.parameters = {
      InRange(Optional(kInteger, "every", "ticks", "0",
                       "The period of the rows of a run in the table; the last tick always has one. 0: it alone."),
              0, kLongestStudy),
  };
  element.children = {
      Repeated("distance", "How far each entity has come so far, along its way, in metres.", With({}, true)),
      Repeated("displacement", "How far each entity is from where it was first seen, in metres.", With({}, true)),
      Repeated(
          "energy",
          "What each robot with wheels has spent so far, in joules: what it takes while it stands, and the work of "
          "its drive against a resistance and to make it faster. Braking gives nothing back.",
          With({InRange(Optional(kNumber, "idle", "W", "0", "Taken all the time: computer, sensors, radio."), 0, 1e6),
                InRange(Optional(kNumber, "resistance", "N", "0",
                                 "Against the rolling of both wheels together; so many joules a metre."),
                        0, 1e6),
                InRange(Optional(kNumber, "mass", "kg", "0", "That is made faster."), 0, 1e6),
                InRange(Optional(kNumber, "efficiency", "", "1",
                                 "How much of what the drive takes becomes work: motors, gears."),
                        0.001, 1)},
               true)),
      Repeated("nearest_neighbour", "The distance from each entity to the nearest other one of them, in metres.",
               With({}, true)),
      Repeated("time_to_region",
               "When each entity first was in a region, in seconds; those that were not yet have no value.",
               With(RegionParameters(), true)),
      Repeated(
          "collisions",
          "How many contacts each robot has begun so far, with other robots, objects and walls. Robots and cylinders "
          "are upright cylinders in this count, a robot with a box for a body one of its half diagonal.",
          With({InRange(Optional(kNumber, "gap", "m", "0.001", "Bodies closer than this touch."), 0, 1)}, true)),
      Repeated("attribute", "An attribute of each entity: a number that its kind has beside the pose.",
               With({Required(kText, "name", "",
                              "The attribute, as list plugins and the reference name it: battery, radio …"),
                     InRange(Optional(kInteger, "element", "", "0", "Which number of it."), 0, 1000)},
                    true)),
      Repeated(
          "published",
          "What controllers or experiment functions publish: Publish(*GetRobot(), {{\"name\", value}}) with a value "
          "for "
          "each "
          "robot, or Publish(space.GetSpace(), \"name\", value) with one.",
          With({Required(kText, "name", "", "The name in Publish."),
                OneOf(Optional(kChoice, "by", "", "functions", "Who publishes it."), {"functions", "controllers"})},
               true)),
      Repeated("polarisation",
               "The length of the mean of all headings: 1 if all look the same way, near 0 if they look anywhere.",
               With({}, false)),
      Repeated("dispersion",
               "The sum of the squared distances to the centroid, over four squared radii: the second moment by which "
               "aggregation is measured.",
               With({}, false)),
      Repeated("largest_cluster",
               "The share of all entities that are in the largest group in which each is near another one.",
               With({InRange(Required(kNumber, "range", "m", "Two whose centres are this near are connected."), 0,
                             kMostMetres)},
                    false)),
      Repeated("coverage", "The share of the arena that the centre of some entity has been in so far, in square cells.",
               With({Size(Required(kNumber, "cell", "m", "The side of a cell."))}, false)),
      Repeated("in_region", "How many entities are in a region.", With(RegionParameters(), false)),
      Repeated("trajectories", "No column: the ways of all entities, for pictures.", With({}, false)),
  };
  return element;
}

ElementSpec SearchElement()
{
  ElementSpec element;
  element.tags = {"search"};
  element.description =
      "Instead of all combinations of values, those are run that lead to the best one. Factors with from and to are "
      "searched; a step makes whole numbers, or others that far apart, of their values.";
  element.parameters = {
      Required(kText, "metric", "", "What is to be the best: a column of the table, at the end of the runs."),
      OneOf(Optional(kChoice, "goal", "", "max", "Whether much of it is good, or little."), {"max", "min"}),
      Optional(kText, "aggregate", "", "mean", "What of the seeds of a point counts: mean, median, q25, min …"),
      InRange(Required(kInteger, "runs", "", "The most runs of the search: its points, each with all seeds."), 1,
              static_cast<double>(kMostRuns)),
      OneOf(Optional(kChoice, "algorithm", "", "crs",
                     "Global: crs, isres, direct. Local: sbplx, nelder_mead, bobyqa, cobyla."),
            SearchAlgorithms()),
      InRange(Optional(kInteger, "population", "", "0", "Of crs and isres; 0: their own."), 0, 1e5),
      InRange(Optional(kNumber, "tolerance", "", "0.001",
                       "A local search ends if it moves less than this share of the ranges."),
              0, 1),
      InRange(Optional(kInteger, "patience", "points", "0",
                       "The search ends if so many points in a row are no better; 0: it does not."),
              0, 1e6),
      InRange(Optional(kInteger, "random_seed", "", "1", "Of the algorithm's own chance."), 0, 4294967295.0),
      InRange(Optional(kInteger, "fresh_seeds", "", "30",
                       "The best point is run with so many seeds more, which did not choose it."),
              0, 1e5),
  };
  return element;
}

// One element of the page, with what it holds.
void Write(const ElementSpec& element, const std::string& path, std::string& page)
{
  page += fmt::format("\n## `<{}>`\n\n{}\n", element.Name(), element.description);
  if (!path.empty()) page += fmt::format("\nIn `<{}>`{}.\n", path, element.repeatable ? ", any number of times" : "");
  if (!element.parameters.empty())
  {
    page += "\n| parameter | type | unit | default | meaning |\n|---|---|---|---|---|\n";
    for (const ParameterSpec& parameter : element.parameters)
    {
      const std::string fallback = !parameter.default_value           ? "required"
                                   : parameter.default_value->empty() ? ""
                                                                      : "`" + *parameter.default_value + "`";
      page += fmt::format("| `{}` | {} | {} | {} | {} |\n", parameter.name, TypeText(parameter), parameter.unit,
                          fallback, parameter.description);
    }
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
        Required(kPath, "experiment", "", "The experiment file; relative ones start at the folder of the study."),
        InRange(
            Optional(kInteger, "ticks", "ticks", "0", "The length of each run, instead of the experiment's; 0: that."),
            0, kLongestStudy),
        Optional(
            kText, "seeds", "", "1",
            "The seeds with which each point is repeated: numbers and ranges, such as 1-30 or 1-10, 99. All points "
            "have the same ones, so that they can be compared in pairs."),
        Optional(kBoolean, "cluster", "", "false", "Each run is a cluster of processes; otherwise it is one process."),
        InRange(Optional(kInteger, "controller_hosts", "", "1", "Of a cluster."), 1, 1000),
        Optional(kBoolean, "visualisations", "", "false", "With the visualisations of the experiment."),
    };
    root.children = {
        SetElement(),
        FactorElement(),
        VariantsElement(),
        ZipElement(),
        Repeated("require", "Only points that fulfil this are run.",
                 {Required(kText, "condition", "",
                           "Over the ids of factors: numbers, 'texts', and, or, not, comparisons, + - * / %, "
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
      "# Study files: elements\n\nGenerated from the tables of the program (`StudyReference` in "
      "`studies/study_schema.cpp`); "
      "[studies](studies.md) explains them. A parameter may be written as an attribute or as an element.\n";
  Write(StudySchema(), "", page);
  return page;
}

}  // namespace swarmanoid
