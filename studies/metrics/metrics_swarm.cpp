// Metrics of the arrangement of entities. They compare all pairs, since they are computed only at sampled ticks.
// Clusters are the connected components of the graph of pairs within a range; dispersion is the second moment about the
// centroid in units of the robots' diameter squared.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/space/space.h"
#include "studies/metrics/metric_kinds.h"

namespace swarmanoid
{
namespace
{

using Entities = std::vector<std::uint32_t>;

// A metric of the positions of the present entities.
class PlacesMetric : public Metric
{
public:
  explicit PlacesMetric(Entities entities) : entities_(std::move(entities)) {}

  void Measure(CSimulator& simulator, std::vector<double>& values) final
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    places_.clear();
    for (const std::uint32_t index : entities_)
      if (space.IsPresent(index)) places_.push_back(space.GetPose(index).position);
    if (!places_.empty()) Measure(places_, values);
  }

private:
  virtual void Measure(const std::vector<Vector3>& places, std::vector<double>& values) = 0;

  Entities entities_;
  std::vector<Vector3> places_;
};

class NearestNeighbourMetric final : public PlacesMetric
{
public:
  using PlacesMetric::PlacesMetric;

private:
  void Measure(const std::vector<Vector3>& places, std::vector<double>& values) override
  {
    if (places.size() < 2) return;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < places.size(); ++j)
        if (j != i) nearest = std::min(nearest, (places[i] - places[j]).squaredNorm());
      values.push_back(std::sqrt(nearest));
    }
  }
};

// Computes the order parameter of Vicsek et al. (1995), equation 3, over headings in the plane.
class PolarisationMetric : public Metric
{
public:
  explicit PolarisationMetric(Entities entities) : entities_(std::move(entities)) {}

  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    Vector2 sum = Vector2::Zero();
    double count = 0;
    for (const std::uint32_t index : entities_)
    {
      if (!space.IsPresent(index)) continue;
      const Vector3 front = space.GetPose(index).orientation * Vector3::UnitX();
      const double length = std::hypot(front.x(), front.y());
      if (length > 0) sum += front.head<2>() / length;
      ++count;
    }
    if (count > 0) values.push_back(sum.norm() / count);
  }

private:
  Entities entities_;
};

class DispersionMetric final : public PlacesMetric
{
public:
  DispersionMetric(Entities entities, double radius_m) : PlacesMetric(std::move(entities)), radius_m_(radius_m) {}

private:
  void Measure(const std::vector<Vector3>& places, std::vector<double>& values) override
  {
    Vector3 centroid = Vector3::Zero();
    for (const Vector3& place : places) centroid += place;
    centroid /= static_cast<double>(places.size());
    double squares = 0;
    for (const Vector3& place : places) squares += (place - centroid).squaredNorm();
    values.push_back(squares / (4 * radius_m_ * radius_m_));
  }

  double radius_m_;
};

class LargestClusterMetric final : public PlacesMetric
{
public:
  LargestClusterMetric(Entities entities, double range_m) : PlacesMetric(std::move(entities)), range_m_(range_m) {}

private:
  void Measure(const std::vector<Vector3>& places, std::vector<double>& values) override
  {
    std::vector<std::size_t> waiting(places.size()), group;
    std::iota(waiting.begin(), waiting.end(), std::size_t{0});
    std::size_t largest = 0;
    while (!waiting.empty())
    {
      group.assign(1, waiting.back());
      waiting.pop_back();
      for (std::size_t next = 0; next < group.size(); ++next)
        std::erase_if(waiting,
                      [&](std::size_t other)
                      {
                        const bool near = (places[other] - places[group[next]]).squaredNorm() <= range_m_ * range_m_;
                        if (near) group.push_back(other);
                        return near;
                      });
      largest = std::max(largest, group.size());
    }
    values.push_back(static_cast<double>(largest) / static_cast<double>(places.size()));
  }

  double range_m_;
};

double RadiusOf(const MetricChoice& choice, const Entities& entities, const Experiment& experiment)
{
  const double radius = experiment.entities[entities[0]].size.x();
  for (const std::uint32_t index : entities)
  {
    const EntityConfiguration& entity = experiment.entities[index];
    if (DescriptionOf(entity.kind).form != BodyForm::kCylinder || entity.size.x() != radius)
      throw ConfigurationError(
          choice.location,
          fmt::format("<dispersion> counts in radii, and '{}' is no cylinder of the radius of '{}': name "
                      "bodies of one radius by 'of'",
                      entity.id, experiment.entities[entities[0]].id));
  }
  return radius;
}

}  // namespace

std::unique_ptr<Metric> MakeSwarmMetric(const MetricChoice& choice, const std::vector<std::uint32_t>& entities,
                                        const Experiment& experiment)
{
  if (choice.kind == "nearest_neighbour") return std::make_unique<NearestNeighbourMetric>(entities);
  if (choice.kind == "polarisation") return std::make_unique<PolarisationMetric>(entities);
  if (choice.kind == "largest_cluster")
    return std::make_unique<LargestClusterMetric>(entities, choice.tree.GetNumber("range"));
  if (choice.kind == "dispersion")
    return std::make_unique<DispersionMetric>(entities, RadiusOf(choice, entities, experiment));
  return nullptr;
}

}  // namespace swarmanoid
