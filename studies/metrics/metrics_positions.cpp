// Metrics of positions, present and past.
//
// Method: coverage counts visits of cells of a grid over the arena in each tick. A region is a disc or rectangle on the
// floor, or the outline of an entity, in whose frame positions are tested, so that it moves with the entity.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/configuration/wording.h"
#include "common/space/space.h"
#include "studies/metrics/metric_kinds.h"

namespace swarmanoid
{
namespace
{

using Entities = std::vector<std::uint32_t>;

class CoverageMetric : public Metric
{
public:
  CoverageMetric(Entities entities, const MetricChoice& choice, const Experiment& experiment)
      : entities_(std::move(entities))
  {
    constexpr double kMostCells = 1e7;
    grid_.metric = choice.id;
    grid_.cell_m = choice.tree.GetNumber("cell");
    const double columns = std::ceil(experiment.arena_size.x() / grid_.cell_m - 1e-9);
    const double rows = std::ceil(experiment.arena_size.y() / grid_.cell_m - 1e-9);
    if (columns * rows > kMostCells)
      throw ConfigurationError(choice.tree.ValueLocation("cell"),
                               fmt::format("cells of {} m divide the arena into {:g}; at most {:g} are allowed",
                                           grid_.cell_m, columns * rows, kMostCells));
    grid_.columns = static_cast<std::uint32_t>(columns);
    grid_.rows = static_cast<std::uint32_t>(rows);
    grid_.visits.assign(std::size_t{grid_.columns} * grid_.rows, 0);
  }

  void Look(CSimulator& simulator) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    const PoseArrays& poses = space.Poses();
    for (const std::uint32_t index : entities_)
    {
      const double column = std::floor(poses.x[index] / grid_.cell_m);
      const double row = std::floor(poses.y[index] / grid_.cell_m);
      if (!space.IsPresent(index) || column < 0 || row < 0 || column >= grid_.columns || row >= grid_.rows) continue;
      std::uint32_t& visits =
          grid_.visits[static_cast<std::size_t>(row) * grid_.columns + static_cast<std::size_t>(column)];
      if (visits++ == 0) ++visited_;
    }
  }
  void Measure(CSimulator&, std::vector<double>& values) override
  {
    values.push_back(static_cast<double>(visited_) / static_cast<double>(grid_.visits.size()));
  }
  void AddGrid(RunSamples& samples) const override { samples.grids.push_back(grid_); }

private:
  Entities entities_;
  RunSamples::Grid grid_;
  std::size_t visited_ = 0;
};

// A disc or an upright rectangle on the floor, which may follow an entity.
class Region
{
public:
  Region(const MetricChoice& choice, const Experiment& experiment)
  {
    const TConfigurationTree& tree = choice.tree;
    if (tree.Value("centre"))
    {
      centre_ = tree.GetVector2("centre");
      radius_ = tree.GetNumber("radius", 0);
      return;
    }
    if (tree.Value("min"))
    {
      const Vector2 low = tree.GetVector2("min");
      const Vector2 high = tree.GetVector2("max");
      centre_ = (low + high) / 2;
      half_ = (high - low) / 2;
      if (half_.minCoeff() < 0)
        throw ConfigurationError(tree.ValueLocation("max"), "'max' of a region is not above its 'min'");
      return;
    }
    const std::string id = *tree.Value("entity");
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < experiment.entities.size(); ++i)
    {
      const EntityConfiguration& entity = experiment.entities[i];
      ids.push_back(entity.id);
      if (entity.id == id) entity_ = static_cast<std::uint32_t>(i);
    }
    if (!entity_)
      throw ConfigurationError(tree.ValueLocation("entity"),
                               fmt::format("the experiment has no entity {}{}", Quoted(id), DidYouMean(id, ids)));
    const Vector3& size = experiment.entities[*entity_].size;
    // Discs and cylinders have their radius twice and a height. A disc of the floor has y = 0.
    const bool is_disc = size.y() == 0 || DescriptionOf(experiment.entities[*entity_].kind).form == BodyForm::kCylinder;
    if (is_disc)
      radius_ = size.x();
    else
      half_ = size.head<2>() / 2;
  }

  bool Holds(const CSwarmanoidSpace& space, std::uint32_t index) const
  {
    Vector2 away = space.GetPose(index).position.head<2>() - centre_;
    if (entity_)
    {
      const Pose pose = space.GetPose(*entity_);
      away = (pose.orientation.conjugate() * (space.GetPose(index).position - pose.position)).head<2>();
    }
    if (radius_) return away.norm() <= *radius_;
    return std::abs(away.x()) <= half_.x() && std::abs(away.y()) <= half_.y();
  }

private:
  std::optional<std::uint32_t> entity_;
  Vector2 centre_ = Vector2::Zero();
  std::optional<double> radius_;
  Vector2 half_ = Vector2::Zero();
};

class InRegionMetric : public Metric
{
public:
  InRegionMetric(Entities entities, Region region) : entities_(std::move(entities)), region_(region) {}

  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    values.push_back(static_cast<double>(
        std::count_if(entities_.begin(), entities_.end(),
                      [&](std::uint32_t index) { return space.IsPresent(index) && region_.Holds(space, index); })));
  }

private:
  Entities entities_;
  Region region_;
};

class TimeToRegionMetric : public Metric
{
public:
  TimeToRegionMetric(Entities entities, Region region)
      : entities_(std::move(entities)), region_(region), arrived_(entities_.size(), kNoValue)
  {
  }

  void Look(CSimulator& simulator) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (std::size_t i = 0; i < entities_.size(); ++i)
      if (std::isnan(arrived_[i]) && space.IsPresent(entities_[i]) && region_.Holds(space, entities_[i]))
        arrived_[i] = space.GetTime();
  }
  void Measure(CSimulator&, std::vector<double>& values) override { values = arrived_; }

private:
  Entities entities_;
  Region region_;
  std::vector<double> arrived_;
};

}  // namespace

std::unique_ptr<Metric> MakePlaceMetric(const MetricChoice& choice, const std::vector<std::uint32_t>& entities,
                                        const Experiment& experiment)
{
  if (choice.kind == "coverage") return std::make_unique<CoverageMetric>(entities, choice, experiment);
  if (choice.kind == "in_region") return std::make_unique<InRegionMetric>(entities, Region(choice, experiment));
  if (choice.kind == "time_to_region")
    return std::make_unique<TimeToRegionMetric>(entities, Region(choice, experiment));
  return nullptr;
}

}  // namespace swarmanoid
