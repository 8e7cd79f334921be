// Metrics of contacts between robots.
//
// Method: bodies are circles and boxes seen from above, with a height. Circles are sorted along x, and each is compared
// with the following ones until they are too far away (sweep and prune). A contact counts when it begins: the pair is
// in the sorted list of this tick and not in that of the tick before.
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/space/space.h"
#include "studies/metrics/metric_kinds.h"

namespace swarmanoid
{
namespace
{

using Entities = std::vector<std::uint32_t>;

// Bodies are upright cylinders and boxes. Bodies at different heights do not touch.
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
    // The bodies are sorted along x, and nearly sorted from the tick before.
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
  std::vector<std::uint32_t> of_;                 // the index in entities_ of each entity
  std::vector<std::uint64_t> touching_, before_;  // pairs of entities, sorted
  std::vector<double> begun_;
};

}  // namespace

std::unique_ptr<Metric> MakeContactMetric(const MetricChoice& choice, const std::vector<std::uint32_t>& entities,
                                          const Experiment& experiment)
{
  if (choice.kind != "collisions") return nullptr;
  return std::make_unique<CollisionsMetric>(entities, choice.tree.GetNumber("gap", 0.001), experiment);
}

}  // namespace swarmanoid
