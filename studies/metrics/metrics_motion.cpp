// Metrics of motion and energy.
//
// Method: distances and energies add up from tick to tick, so that curves count and not only their ends. The energy of
// a tick is the idle power, and the work against resistance along the way of the wheels with the change of kinetic
// energy, if it is positive, divided by the efficiency (docs/studies.md, "Energy").
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/space/space.h"
#include "studies/metrics/metric_kinds.h"

namespace swarmanoid
{
namespace
{

using Entities = std::vector<std::uint32_t>;

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
        last_[i] = Vector3::Constant(kNoValue);  // a return to the arena counts as no motion
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

// The work of the drive, and the power of a standing robot. The wheels roll as the body moves: its way along its
// heading, and half the axle for each radian of turn.
class EnergyMetric : public Metric
{
public:
  EnergyMetric(Entities entities, const MetricChoice& choice, const Experiment& experiment)
      : entities_(std::move(entities)),
        idle_w_(choice.tree.GetNumber("idle", 0)),
        resistance_n_(choice.tree.GetNumber("resistance", 0)),
        mass_kg_(choice.tree.GetNumber("mass", 0)),
        efficiency_(choice.tree.GetNumber("efficiency", 1)),
        tick_s_(experiment.TickSeconds()),
        last_(entities_.size()),
        spent_j_(entities_.size(), 0)
  {
    for (const std::uint32_t index : entities_)
    {
      const EntityConfiguration& entity = experiment.entities[index];
      const auto& wheels = DescriptionOf(entity.kind).wheels;
      if (!wheels)
        throw ConfigurationError(
            choice.location,
            fmt::format("<energy> is of robots with wheels, and {} '{}' has none: name robots with wheels by 'of'",
                        TagName(entity.kind), entity.id));
      half_axles_m_.push_back(wheels->axle_m / 2);
    }
  }

  void Look(CSimulator& simulator) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (std::size_t i = 0; i < entities_.size(); ++i)
    {
      if (!space.IsPresent(entities_[i]))
      {
        last_[i] = {};  // after its return the entity starts at rest
        continue;
      }
      const Pose now = space.GetPose(entities_[i]);
      if (last_[i].is_known) spent_j_[i] += SpentInTick(now, last_[i], half_axles_m_[i]);
      last_[i].pose = now;
      last_[i].is_known = true;
    }
  }
  void Measure(CSimulator&, std::vector<double>& values) override { values = spent_j_; }

private:
  struct Last
  {
    bool is_known = false;
    Pose pose;
    double speed_m_s = 0;
  };

  double SpentInTick(const Pose& now, Last& last, double half_axle_m) const
  {
    const Vector3 before = last.pose.orientation * Vector3::UnitX();
    const Vector3 after = now.orientation * Vector3::UnitX();
    const Vector3 way = now.position - last.pose.position;
    // The heading is taken half way through the turn. A turn by half a circle has no middle, and counts as a turn on
    // the spot.
    const Vector3 middle = before + after;
    const double ahead_m = middle.norm() > 1e-9 ? way.dot(middle) / middle.norm() : 0;
    const double turned_m = half_axle_m * std::atan2(before.cross(after).z(), before.dot(after));
    const double rolled_m = (std::abs(ahead_m - turned_m) + std::abs(ahead_m + turned_m)) / 2;
    const double speed_m_s = way.norm() / tick_s_;
    const double work_j =
        resistance_n_ * rolled_m + mass_kg_ / 2 * (speed_m_s * speed_m_s - last.speed_m_s * last.speed_m_s);
    last.speed_m_s = speed_m_s;
    return idle_w_ * tick_s_ + std::max(work_j, 0.0) / efficiency_;
  }

  Entities entities_;
  double idle_w_, resistance_n_, mass_kg_, efficiency_, tick_s_;
  std::vector<double> half_axles_m_;
  std::vector<Last> last_;
  std::vector<double> spent_j_;
};

}  // namespace

std::unique_ptr<Metric> MakeMotionMetric(const MetricChoice& choice, const std::vector<std::uint32_t>& entities,
                                         const Experiment& experiment)
{
  if (choice.kind == "distance") return std::make_unique<DistanceMetric>(entities);
  if (choice.kind == "displacement") return std::make_unique<DisplacementMetric>(entities);
  if (choice.kind == "energy") return std::make_unique<EnergyMetric>(entities, choice, experiment);
  return nullptr;
}

}  // namespace swarmanoid
