// The kinds of metrics. docs/studies.md describes them.
#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>

#include "common/configuration/wording.h"
#include "common/control_interface/ci_publish.h"
#include "common/math/elementary.h"
#include "common/space/attributes.h"
#include "common/space/packet_attribute.h"
#include "common/space/publish.h"
#include "studies/metric.h"

namespace swarmanoid
{
namespace
{

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

using Entities = std::vector<std::uint32_t>;

double TextNumber(const TConfigurationTree& tree, const char* name) { return tree.GetNumber(name, 0); }

class DistanceMetric : public Metric
{
public:
  explicit DistanceMetric(Entities entities)
      : entities_(std::move(entities)), last_(entities_.size(), Vector3::Constant(kNoValue)), way_(entities_.size(), 0)
  {
  }

  void Look(CSimulator& simulator) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (std::size_t i = 0; i < entities_.size(); ++i)
    {
      if (!space.IsPresent(entities_[i]))
      {
        last_[i] = Vector3::Constant(kNoValue);  // where it comes back is no way
        continue;
      }
      const Vector3 now = space.GetPose(entities_[i]).position;
      if (!std::isnan(last_[i].x())) way_[i] += (now - last_[i]).norm();
      last_[i] = now;
    }
  }
  void Measure(CSimulator&, std::vector<double>& values) override { values = way_; }

private:
  Entities entities_;
  std::vector<Vector3> last_;
  std::vector<double> way_;
};

class DisplacementMetric : public Metric
{
public:
  explicit DisplacementMetric(Entities entities)
      : entities_(std::move(entities)), first_(entities_.size(), Vector3::Constant(kNoValue))
  {
  }

  void Look(CSimulator& simulator) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (std::size_t i = 0; i < entities_.size(); ++i)
      if (std::isnan(first_[i].x()) && space.IsPresent(entities_[i])) first_[i] = space.GetPose(entities_[i]).position;
  }
  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (std::size_t i = 0; i < entities_.size(); ++i)
      if (space.IsPresent(entities_[i])) values.push_back((space.GetPose(entities_[i]).position - first_[i]).norm());
  }

private:
  Entities entities_;
  std::vector<Vector3> first_;
};

std::vector<Vector3> PlacesOf(const CSwarmanoidSpace& space, const Entities& entities)
{
  std::vector<Vector3> places;
  for (const std::uint32_t index : entities)
    if (space.IsPresent(index)) places.push_back(space.GetPose(index).position);
  return places;
}

class NearestNeighbourMetric : public Metric
{
public:
  explicit NearestNeighbourMetric(Entities entities) : entities_(std::move(entities)) {}

  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const std::vector<Vector3> places = PlacesOf(simulator.GetSpace(), entities_);
    if (places.size() < 2) return;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < places.size(); ++j)
        if (j != i) nearest = std::min(nearest, (places[i] - places[j]).squaredNorm());
      values.push_back(std::sqrt(nearest));
    }
  }

private:
  Entities entities_;
};

// The order parameter of Vicsek et al. (1995), equation 3, over headings in the plane.
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

class DispersionMetric : public Metric
{
public:
  DispersionMetric(Entities entities, double radius_m) : entities_(std::move(entities)), radius_m_(radius_m) {}

  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const std::vector<Vector3> places = PlacesOf(simulator.GetSpace(), entities_);
    if (places.empty()) return;
    Vector3 centroid = Vector3::Zero();
    for (const Vector3& place : places) centroid += place;
    centroid /= static_cast<double>(places.size());
    double squares = 0;
    for (const Vector3& place : places) squares += (place - centroid).squaredNorm();
    values.push_back(squares / (4 * radius_m_ * radius_m_));
  }

private:
  Entities entities_;
  double radius_m_;
};

class LargestClusterMetric : public Metric
{
public:
  LargestClusterMetric(Entities entities, double range_m) : entities_(std::move(entities)), range_m_(range_m) {}

  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const std::vector<Vector3> places = PlacesOf(simulator.GetSpace(), entities_);
    if (places.empty()) return;
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

private:
  Entities entities_;
  double range_m_;
};

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
      radius_ = TextNumber(tree, "radius");
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
    // Discs and cylinders have their radius twice and a height, or none; y is 0 of a disc of the floor.
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

// Bodies are upright cylinders and boxes; those that are apart by height do not touch.
class CollisionsMetric : public Metric
{
public:
  CollisionsMetric(Entities entities, double gap_m, const Experiment& experiment)
      : entities_(std::move(entities)), gap_m_(gap_m), begun_(entities_.size(), 0)
  {
    for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
    {
      const EntityConfiguration& entity = experiment.entities[i];
      const EntityKindDescription& kind = DescriptionOf(entity.kind);
      if (kind.form == BodyForm::kNone || entity.size.x() <= 0) continue;
      const bool round = kind.form == BodyForm::kCylinder;
      const double base = kind.origin == BodyOrigin::kCentre ? -entity.size.z() / 2 : 0;
      if (round || kind.role == EntityRole::kRobot)
        rounds_.push_back(
            {i, round ? entity.size.x() : entity.size.head<2>().norm() / 2, base, base + entity.size.z()});
      else
        boxes_.push_back({i, entity.size.head<2>() / 2, base, base + entity.size.z()});
    }
    for (const Round& round : rounds_) largest_m_ = std::max(largest_m_, round.radius_m);
    of_.assign(experiment.entities.size(), kNobody);
    for (std::uint32_t i = 0; i < entities_.size(); ++i) of_[entities_[i]] = i;
  }

  void Look(CSimulator& simulator) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    const PoseArrays& poses = space.Poses();
    touching_.clear();
    // Along x; nearly sorted from the tick before.
    std::sort(rounds_.begin(), rounds_.end(),
              [&](const Round& a, const Round& b)
              { return std::pair(poses.x[a.entity], a.entity) < std::pair(poses.x[b.entity], b.entity); });
    for (std::size_t i = 0; i < rounds_.size(); ++i)
    {
      const Round& a = rounds_[i];
      if (!space.IsPresent(a.entity)) continue;
      const double reach = a.radius_m + largest_m_ + gap_m_;
      for (std::size_t j = i + 1; j < rounds_.size() && poses.x[rounds_[j].entity] - poses.x[a.entity] <= reach; ++j)
        if (const Round& b = rounds_[j]; Counts(space, a.entity, b.entity) && Touch(poses, a, b))
          Add(a.entity, b.entity);
      if (of_[a.entity] == kNobody) continue;
      for (const Box& box : boxes_)
        if (space.IsPresent(box.entity) && Touches(space, a, box)) Add(a.entity, box.entity);
    }
    std::sort(touching_.begin(), touching_.end());
    for (const std::uint64_t pair : touching_)
    {
      if (std::binary_search(before_.begin(), before_.end(), pair)) continue;
      for (const auto entity : {static_cast<std::uint32_t>(pair >> 32U), static_cast<std::uint32_t>(pair)})
        if (of_[entity] != kNobody) ++begun_[of_[entity]];
    }
    std::swap(before_, touching_);
  }
  void Measure(CSimulator&, std::vector<double>& values) override { values = begun_; }

private:
  static constexpr std::uint32_t kNobody = 0xffffffff;

  struct Round
  {
    std::uint32_t entity;
    double radius_m, base_m, top_m;
  };
  struct Box
  {
    std::uint32_t entity;
    Vector2 half;
    double base_m, top_m;
  };

  bool Counts(const CSwarmanoidSpace& space, std::uint32_t a, std::uint32_t b) const
  {
    return space.IsPresent(b) && (of_[a] != kNobody || of_[b] != kNobody);
  }
  bool Touch(const PoseArrays& poses, const Round& a, const Round& b) const
  {
    const double x = poses.x[a.entity] - poses.x[b.entity];
    const double y = poses.y[a.entity] - poses.y[b.entity];
    const double reach = a.radius_m + b.radius_m + gap_m_;
    const double z = poses.z[b.entity] - poses.z[a.entity];
    return x * x + y * y <= reach * reach && z + b.base_m <= a.top_m + gap_m_ && z + b.top_m >= a.base_m - gap_m_;
  }
  bool Touches(const CSwarmanoidSpace& space, const Round& round, const Box& box) const
  {
    const Pose pose = space.GetPose(box.entity);
    const Vector3 place = space.GetPose(round.entity).position;
    const double z = place.z() - pose.position.z();
    if (z + round.base_m > box.top_m + gap_m_ || z + round.top_m < box.base_m - gap_m_) return false;
    const Vector2 away = (pose.orientation.conjugate() * (place - pose.position)).head<2>();
    const Vector2 outside = (away.cwiseAbs() - box.half).cwiseMax(0.0);
    return outside.norm() <= round.radius_m + gap_m_;
  }
  void Add(std::uint32_t a, std::uint32_t b)
  {
    touching_.push_back(std::uint64_t{std::min(a, b)} << 32U | std::max(a, b));
  }

  Entities entities_;
  double gap_m_;
  double largest_m_ = 0;
  std::vector<Round> rounds_;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> of_;                 // the place in entities_ of each entity
  std::vector<std::uint64_t> touching_, before_;  // pairs of entities, sorted
  std::vector<double> begun_;
};

class AttributeMetric : public Metric
{
public:
  AttributeMetric(Entities entities, std::string name, int element)
      : entities_(std::move(entities)), name_(std::move(name)), element_(element)
  {
  }

  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (const std::uint32_t index : entities_)
      if (space.IsPresent(index)) values.push_back(space.GetEntity(index).GetAttribute(name_, element_));
  }

private:
  Entities entities_;
  std::string name_;
  int element_;
};

class PublishedByFunctions : public Metric
{
public:
  explicit PublishedByFunctions(std::string name) : name_(std::move(name)) {}

  void Look(CSimulator& simulator) override
  {
    if (!numbers_) numbers_.emplace(simulator.GetSpace());
  }
  void Measure(CSimulator&, std::vector<double>& values) override
  {
    const auto found = numbers_->Values().find(name_);
    if (found != numbers_->Values().end()) values.push_back(found->second);
  }

private:
  std::string name_;
  std::optional<PublishedNumbers> numbers_;
};

class PublishedByControllers : public Metric
{
public:
  PublishedByControllers(Entities entities, const std::string& name) : entities_(std::move(entities)), name_(name) {}

  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (const std::uint32_t index : entities_)
    {
      if (!space.IsPresent(index)) continue;
      const CSwarmanoidSpaceEntity& entity = space.GetEntity(index);
      double slots[kPacketSlots - 1];
      for (std::size_t i = 0; i < kPacketSlots - 1; ++i)
        slots[i] = entity.GetAttribute("report", static_cast<int>(i) + 1);
      const AttributePacket packet = UnpackedPacket(slots);
      values.push_back(PublishedNumberIn(packet.Bytes(), name_).value_or(kNoValue));
    }
  }

private:
  Entities entities_;
  std::string name_;
};

void RequireAttribute(const MetricChoice& choice, const Entities& entities, const Experiment& experiment)
{
  const std::string name = *choice.tree.Value("name");
  const long long element = choice.tree.GetInteger("element", 0);
  for (const std::uint32_t index : entities)
  {
    const EntityConfiguration& entity = experiment.entities[index];
    std::vector<std::string> names;
    const AttributeSpec* found = nullptr;
    for (const AttributeSpec& attribute : AttributesOf(entity.kind))
    {
      names.emplace_back(attribute.name);
      if (attribute.name == name) found = &attribute;
    }
    if (found == nullptr)
      throw ConfigurationError(choice.tree.ValueLocation("name"),
                               fmt::format("{} '{}' has no attribute {}; it has: {}{}", TagName(entity.kind), entity.id,
                                           Quoted(name), Listed(names), DidYouMean(name, names)));
    if (element >= found->count)
      throw ConfigurationError(choice.tree.ValueLocation("element"),
                               fmt::format("the attribute {} of {} has the elements 0 to {}", Quoted(name),
                                           TagName(entity.kind), found->count - 1));
  }
}

void RequireReports(const MetricChoice& choice, const Entities& entities, const Experiment& experiment)
{
  for (const std::uint32_t index : entities)
  {
    const EntityConfiguration& entity = experiment.entities[index];
    const ControllerConfiguration* controller = experiment.FindController(entity.controller);
    const auto lists = [](const DeviceConfiguration& device) { return device.type == "report"; };
    if (controller == nullptr || std::none_of(controller->actuators.begin(), controller->actuators.end(), lists))
      throw ConfigurationError(
          choice.location, fmt::format("the controller {} of '{}' publishes nothing: Publish needs the actuator "
                                       "<report><implementation>generic_report</implementation></report> in its list",
                                       Quoted(entity.controller), entity.id));
  }
}

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
                      "those that are meant by 'of'",
                      entity.id, experiment.entities[entities[0]].id));
  }
  return radius;
}

}  // namespace

std::vector<std::uint32_t> EntitiesOf(const MetricChoice& choice, const Experiment& experiment)
{
  std::vector<bool> meant(experiment.entities.size(), false);
  for (const std::string& pattern : choice.of)
  {
    bool fits = false;
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < experiment.entities.size(); ++i)
    {
      const std::string& id = experiment.entities[i].id;
      if (ids.size() < 1000) ids.push_back(id);
      if (pattern != id &&
          (pattern.find('[') != std::string::npos || fnmatch(pattern.c_str(), id.c_str(), FNM_NOESCAPE) != 0))
        continue;
      meant[i] = fits = true;
    }
    if (!fits)
      throw ConfigurationError(choice.tree.ValueLocation("of"), fmt::format("no entity of the experiment fits {}{}",
                                                                            Quoted(pattern), DidYouMean(pattern, ids)));
  }
  std::vector<std::uint32_t> entities;
  for (std::uint32_t i = 0; i < meant.size(); ++i)
    if (meant[i] || (choice.of.empty() && IsRobot(experiment.entities[i].kind))) entities.push_back(i);
  if (entities.empty())
    throw ConfigurationError(choice.location, "the experiment has no robots; name entities by 'of'");
  return entities;
}

std::unique_ptr<Metric> MakeMetric(const MetricChoice& choice, const Experiment& experiment)
{
  const std::string& kind = choice.kind;
  const TConfigurationTree& tree = choice.tree;
  if (kind == "published" && tree.Value("by").value_or("functions") == "functions")
  {
    if (!choice.of.empty())
      throw ConfigurationError(tree.ValueLocation("of"),
                               "what functions publish is one value, not of entities; leave 'of' out");
    if (experiment.functions.empty())
      throw ConfigurationError(choice.location, "the experiment has no <experiment_functions> that could publish it");
    return std::make_unique<PublishedByFunctions>(*tree.Value("name"));
  }
  Entities entities = EntitiesOf(choice, experiment);
  if (kind == "distance") return std::make_unique<DistanceMetric>(std::move(entities));
  if (kind == "displacement") return std::make_unique<DisplacementMetric>(std::move(entities));
  if (kind == "nearest_neighbour") return std::make_unique<NearestNeighbourMetric>(std::move(entities));
  if (kind == "polarisation") return std::make_unique<PolarisationMetric>(std::move(entities));
  if (kind == "coverage") return std::make_unique<CoverageMetric>(std::move(entities), choice, experiment);
  if (kind == "in_region") return std::make_unique<InRegionMetric>(std::move(entities), Region(choice, experiment));
  if (kind == "time_to_region")
    return std::make_unique<TimeToRegionMetric>(std::move(entities), Region(choice, experiment));
  if (kind == "largest_cluster")
    return std::make_unique<LargestClusterMetric>(std::move(entities), tree.GetNumber("range"));
  if (kind == "collisions")
    return std::make_unique<CollisionsMetric>(std::move(entities), tree.GetNumber("gap", 0.001), experiment);
  if (kind == "dispersion")
  {
    const double radius = RadiusOf(choice, entities, experiment);
    return std::make_unique<DispersionMetric>(std::move(entities), radius);
  }
  if (kind == "published")
  {
    RequireReports(choice, entities, experiment);
    return std::make_unique<PublishedByControllers>(std::move(entities), *tree.Value("name"));
  }
  RequireAttribute(choice, entities, experiment);
  return std::make_unique<AttributeMetric>(std::move(entities), *tree.Value("name"),
                                           static_cast<int>(tree.GetInteger("element", 0)));
}

}  // namespace swarmanoid
