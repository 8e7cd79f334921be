// Places the entities of <distribute>. Each entity tries positions of its method until one is free of other bodies, in
// the arena and outside rock, at most max_trials times. It draws from its own random stream. So its position depends
// only on the seed, its id, the bodies that are placed already, and the terrain. If the element asks for it, the
// entities are at last sorted along a Z-order curve. Then neighbours in space are mostly neighbours in memory.
//
// Invariants: the volumes that must stay free do not depend on the engine, so that each engine starts from the same
// positions. Engines whose grippers stop no body are the exception, as in experiments of ARGoS3. If an entity finds no
// place, that is reported, and no later check uses the poses of its <distribute>.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "common/configuration/wording.h"
#include "common/experiment/body.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/placement/placement_ground.h"
#include "common/experiment/sections.h"
#include "common/math/elementary.h"
#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kPlacement = StreamName("placement");

Vector3 DrawUniform(RandomStream& random, const Vector3& low, const Vector3& high)
{
  const double x = random.Uniform(low.x(), high.x());
  const double y = random.Uniform(low.y(), high.y());
  const double z = random.Uniform(low.z(), high.z());
  return {x, y, z};
}

Vector3 DrawGaussian(RandomStream& random, const Vector3& mean, const Vector3& deviation)
{
  const double x = random.Gaussian(mean.x(), deviation.x());
  const double y = random.Gaussian(mean.y(), deviation.y());
  const double z = random.Gaussian(mean.z(), deviation.z());
  return {x, y, z};
}

// A grid of points, or of orientations.
class PointGrid
{
public:
  using Layout = Eigen::Matrix<std::int64_t, 3, 1>;

  void Set(const Vector3& centre, const Vector3& spacing, const Vector3& layout)
  {
    layout_ = {std::llround(layout.x()), std::llround(layout.y()), std::llround(layout.z())};
    spacing_ = spacing;
    first_ = centre - 0.5 * (layout - Vector3::Ones()).cwiseProduct(spacing);
  }
  const Layout& Size() const { return layout_; }
  // Returns point i; after the last one, the first one comes again.
  Vector3 At(std::size_t i) const
  {
    const auto number = static_cast<std::int64_t>(i);
    const Vector3 step(static_cast<double>(number % layout_.x()),
                       static_cast<double>(number / layout_.x() % layout_.y()),
                       static_cast<double>(number / layout_.x() / layout_.y() % layout_.z()));
    return first_ + step.cwiseProduct(spacing_);
  }

private:
  Layout layout_ = Layout::Ones();
  Vector3 spacing_ = Vector3::Zero(), first_ = Vector3::Zero();
};

// Chooses the positions of one <distribute>.
class Positions
{
public:
  Positions(const TConfigurationTree& tree, const ElementSpec& spec, std::size_t count,
            const EntityConfiguration& entity, Reading& reading)
      : tree_(tree), reader_(tree_, spec, reading.diagnostics), method_(reader_.Text("method"))
  {
    const Vector3& arena = reading.experiment.arena_size;
    const auto body = placement::BodyOf(entity);
    // The margin is the least distance from the edges of the floor that holds at every heading. The height is that of a
    // body on the floor.
    const double margin = body ? body->half.head<2>().norm() * (body->cylinder ? std::sqrt(0.5) : 1.0) : 0.0;
    const double height = body ? body->half.z() - body->centre.z() : 0.0;
    const Vector3 middle(arena.x() / 2, arena.y() / 2, height);

    low_ = Given("min", {margin, margin, height});
    high_ = Given("max", {arena.x() - margin, arena.y() - margin, low_.z()});
    mean_ = Given("mean", middle);
    deviation_ = reader_.Vector("deviation");

    const double columns = std::ceil(std::sqrt(static_cast<double>(count)));
    const Vector3 layout = Given("layout", {columns, std::ceil(static_cast<double>(count) / columns), 1});
    const Vector3 spacing = Given("spacing", {arena.x() / layout.x(), arena.y() / layout.y(), 0});
    const Vector3 centre = Given("centre", middle);
    grid_.Set(centre, spacing, layout);
    Check(count, arena, reading);
  }

  // Returns the height from which the entities are let down onto the terrain; nullopt: they stay where they are drawn.
  std::optional<double> DropsFrom() const
  {
    return reader_.IsGood("drop_from") && reader_.IsGiven("drop_from") ? std::optional(reader_.Number("drop_from"))
                                                                       : std::nullopt;
  }

  // Returns whether another draw may give another position.
  bool IsRandom() const { return method_ != "grid"; }

  Vector3 Draw(std::size_t i, RandomStream& random) const
  {
    if (method_ == "gaussian") return DrawGaussian(random, mean_, deviation_);
    return method_ == "grid" ? grid_.At(i) : DrawUniform(random, low_, high_);
  }

private:
  Vector3 Given(const char* name, const Vector3& fallback) const
  {
    return reader_.IsGood(name) ? reader_.Vector(name) : fallback;
  }

  void Check(std::size_t count, const Vector3& arena, Reading& reading)
  {
    if (!reader_.IsGood("method") && reader_.IsGiven("method")) return;
    if (method_ == "uniform")
    {
      constexpr double kSlack = 1e-9;
      const bool inside = (low_.array() >= -kSlack).all() && ((arena - high_).array() >= -kSlack).all();
      const bool ordered = ((high_ - low_).array() >= 0).all();
      if (inside && ordered) return;
      reading.diagnostics.Add(tree_.Location(), fmt::format("the box of the positions reaches from {}, {}, {} to {}, "
                                                            "{}, {} m; it must lie within the arena of {}, {}, {} m",
                                                            low_.x(), low_.y(), low_.z(), high_.x(), high_.y(),
                                                            high_.z(), arena.x(), arena.y(), arena.z()));
    }
    else if (method_ == "grid")
    {
      const PointGrid::Layout& layout = grid_.Size();
      const std::int64_t points = layout.prod();
      if (points >= static_cast<std::int64_t>(count)) return;
      reader_.Fail("layout", fmt::format("a grid of {} x {} x {} has {} points; {} are needed", layout.x(), layout.y(),
                                         layout.z(), points, count));
    }
  }

  TConfigurationTree tree_;
  ElementReader reader_;
  std::string method_;
  Vector3 low_, high_, mean_, deviation_;
  PointGrid grid_;
};

class Orientations
{
public:
  Orientations(const TConfigurationTree& tree, const ElementSpec& spec, Diagnostics& diagnostics)
  {
    const ElementReader reader(tree, spec, diagnostics);
    method_ = reader.Text("method");
    const bool gaussian = method_ == "gaussian";
    a_ = reader.Vector(gaussian ? "mean" : method_ == "constant" ? "value" : "min");
    b_ = reader.Vector(gaussian ? "deviation" : "max");
    if (method_ == "grid") grid_.Set(reader.Vector("centre"), reader.Vector("spacing"), reader.Vector("layout"));
    is_zyx_ = reader.Text("axes") == "zyx";
  }

  Quaternion Draw(std::size_t i, RandomStream& random) const
  {
    Vector3 degrees = a_;
    if (method_ == "gaussian") degrees = DrawGaussian(random, a_, b_);
    if (method_ == "uniform") degrees = DrawUniform(random, a_, b_);
    if (method_ == "grid") degrees = grid_.At(i);
    const Vector3 angles(DegreesToRadians(degrees.x()), DegreesToRadians(degrees.y()), DegreesToRadians(degrees.z()));
    if (!is_zyx_) return QuaternionFromEuler({angles.x(), angles.y(), angles.z()});
    return QuaternionFromEuler({angles.z(), 0, 0}) * QuaternionFromEuler({0, angles.y(), 0}) *
           QuaternionFromEuler({0, 0, angles.x()});
  }

private:
  std::string method_;
  Vector3 a_, b_;
  PointGrid grid_;
  bool is_zyx_ = false;
};

class Placer
{
public:
  Placer(const Vector3& arena, Reading& reading)
      : reading_(reading), arena_(arena), grid_(arena, 0.25), ground_(reading)
  {
    const std::vector<EngineConfiguration>& engines = reading.experiment.engines;
    grippers_stop_bodies_ =
        engines.empty() || std::ranges::any_of(engines, [](const EngineConfiguration& engine)
                                               { return engine.tree.GetText("gripper", "") != "rod"; });
  }

  void AddPlaced(std::size_t first, std::size_t last)
  {
    for (std::size_t i = first; i < last; ++i)
    {
      const EntityConfiguration& entity = reading_.experiment.entities[i];
      if (!entity.reserve.empty()) continue;
      const auto body = OutlineOf(i);
      if (body && entity.size.minCoeff() > 0) grid_.Add(*body, static_cast<std::uint32_t>(i));
    }
  }

  // Places all entities of a <distribute>. Returns false, after a report, if they do not fit.
  bool Place(const Distribution& distribution)
  {
    if (distribution.count == 0) return true;
    const ElementSpec& spec = ExperimentSchema().Child("arena").Child("distribute");
    auto& entities = reading_.experiment.entities;
    const TConfigurationTree position = distribution.tree.Child("position");
    const TConfigurationTree orientation = distribution.tree.Child("orientation");
    EntityConfiguration sample = entities[distribution.first];
    sample.pose = {};
    const std::size_t mistakes = reading_.diagnostics.Count();
    const Positions positions(position, spec.Child("position"), distribution.count, sample, reading_);
    const Orientations orientations(orientation, spec.Child("orientation"), reading_.diagnostics);
    if (reading_.diagnostics.Count() != mistakes) return false;
    for (std::size_t i = 0; i < distribution.count; ++i)
    {
      if (PlaceOne(distribution, i, positions, orientations)) continue;
      Report(distribution, i, positions.IsRandom());
      return false;
    }
    return true;
  }

private:
  bool PlaceOne(const Distribution& distribution, std::size_t i, const Positions& positions,
                const Orientations& orientations)
  {
    const std::size_t index = distribution.first + i;
    EntityConfiguration& entity = reading_.experiment.entities[index];
    RandomStream random(reading_.experiment.seed, StreamName(entity.id), kPlacement, 0);
    const long long trials = positions.IsRandom() ? distribution.max_trials : 1;
    for (long long trial = 0; trial < trials; ++trial)
    {
      entity.pose.orientation = orientations.Draw(i, random);
      entity.pose.position = positions.Draw(i, random);
      if (positions.DropsFrom() && !LetDown(index, *positions.DropsFrom())) continue;
      const auto body = placement::BodyOf(entity);
      // The user chooses the points of a grid, as for single robots, so only the bodies must not overlap.
      const auto outline = positions.IsRandom() ? OutlineOf(index) : body;
      if (!Inside(entity.pose.position, body) || (outline && grid_.Find(*outline))) continue;
      if (body && ground_.IsInRock(index, *body)) continue;
      if (outline) grid_.Add(*outline, static_cast<std::uint32_t>(index));
      return true;
    }
    return false;
  }

  // Lets an entity down onto the terrain. Returns false if no ground is under it.
  bool LetDown(std::size_t index, double from)
  {
    EntityConfiguration& entity = reading_.experiment.entities[index];
    const auto body = placement::BodyOf(entity);
    if (!body) return true;
    const auto ground = ground_.HighestUnder(index, *body, from);
    if (!ground) return false;
    entity.pose.position.z() += *ground - (body->centre.z() - body->HalfExtent().z());
    return true;
  }

  // Returns the volume that must stay free: the body, and the gripper of the kinematic engine at any angle of the
  // turret (figure 3.9 of the documentation). The volume is the same for all engines, so that robots start at the same
  // positions in each.
  std::optional<placement::Body> OutlineOf(std::size_t index) const
  {
    constexpr double kGripperReach = 0.102;  // m: a little beyond its corners
    const EntityConfiguration& entity = reading_.experiment.entities[index];
    auto body = placement::BodyOf(entity);
    if (body && grippers_stop_bodies_ && DescriptionOf(entity.kind).mechanism == Mechanism::kTurretGripper)
      body->half.head<2>().setConstant(std::max(kGripperReach, body->half.x()));
    return body;
  }

  // Returns whether the position is in the arena and no part of the body is over the edge of the floor.
  bool Inside(const Vector3& position, const std::optional<placement::Body>& body) const
  {
    constexpr double kSlack = 1e-9;
    if ((position.array() < -kSlack).any() || ((arena_ - position).array() < -kSlack).any()) return false;
    if (!body) return true;
    const Vector3 half = body->HalfExtent();
    for (Eigen::Index axis = 0; axis < 2; ++axis)
    {
      if (body->centre[axis] - half[axis] < -kSlack || body->centre[axis] + half[axis] > arena_[axis] + kSlack)
        return false;
    }
    return true;
  }

  void Report(const Distribution& distribution, std::size_t i, bool random)
  {
    const EntityConfiguration& entity = reading_.experiment.entities[distribution.first + i];
    const std::string tried =
        random ? fmt::format("no place free of others and of rock in {} trials", distribution.max_trials)
               : fmt::format("its point of the grid at {}, {}, {} is taken or outside the arena",
                             entity.pose.position.x(), entity.pose.position.y(), entity.pose.position.z());
    const char* cure =
        random ? "lower the quantity, enlarge the region or raise max_trials" : "widen the spacing or move the centre";
    reading_.diagnostics.Add(distribution.tree.Location(),
                             fmt::format("the {} '{}' does not fit after {} of {} were placed: {}; {}",
                                         TagName(entity.kind), entity.id, i, distribution.count, tried, cure));
  }

  Reading& reading_;
  Vector3 arena_;
  placement::BodyGrid grid_;
  placement::Ground ground_;
  bool grippers_stop_bodies_ = true;
};

// Marks the poses as unknown, so that no later check uses them.
void Unplace(const Distribution& distribution, std::vector<EntityConfiguration>& entities)
{
  for (std::size_t i = 0; i < distribution.count; ++i)
  {
    entities[distribution.first + i].pose.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

// Interleaves the bits of x and y. Positions near each other on the plane are mostly near in this order (Morton, "A
// computer oriented geodetic data base", IBM, 1966).
std::uint32_t MortonOrder(std::uint16_t x, std::uint16_t y)
{
  const auto spread = [](std::uint32_t bits)
  {
    bits = (bits | bits << 8U) & 0x00ff00ffU;
    bits = (bits | bits << 4U) & 0x0f0f0f0fU;
    bits = (bits | bits << 2U) & 0x33333333U;
    return (bits | bits << 1U) & 0x55555555U;
  };
  return spread(x) | spread(y) << 1U;
}

void SortByPlace(const Distribution& distribution, Experiment& experiment)
{
  struct Place
  {
    std::uint32_t order, index;
    bool operator<(const Place& other) const { return std::tie(order, index) < std::tie(other.order, other.index); }
  };
  const auto first = static_cast<std::uint32_t>(distribution.first);
  const auto behind = static_cast<std::uint32_t>(distribution.first + distribution.count);
  const double widest = experiment.arena_size.head<2>().maxCoeff();
  const auto step = [&](double metres)
  { return static_cast<std::uint16_t>(std::clamp(metres / widest, 0.0, 1.0) * 0xffff); };
  std::vector<Place> places;
  places.reserve(distribution.count);
  for (std::uint32_t i = first; i < behind; ++i)
  {
    const Vector3& position = experiment.entities[i].pose.position;
    places.push_back({MortonOrder(step(position.x()), step(position.y())), i});
  }
  std::sort(places.begin(), places.end());

  std::vector<std::uint32_t> new_index(distribution.count);
  for (std::uint32_t k = 0; k < places.size(); ++k) new_index[places[k].index - first] = first + k;
  // They change places one by one, since a second list of them would take much memory.
  for (std::uint32_t k = 0; k < places.size(); ++k)
  {
    std::uint32_t from = places[k].index - first;
    while (from < k) from = places[from].index - first;  // an earlier change has put it there
    if (from != k) std::swap(experiment.entities[first + k], experiment.entities[first + from]);
  }
  for (EngineConfiguration& engine : experiment.engines)
  {
    for (std::uint32_t& entity : engine.entities)
      if (entity >= first && entity < behind) entity = new_index[entity - first];
    std::sort(engine.entities.begin(), engine.entities.end());
  }
}

// Places the entities of all distributions. Returns false, after a report, if they do not fit.
bool PlaceAll(Reading& reading)
{
  const std::vector<Distribution>& distributions = reading.distributions;
  Placer placer(reading.experiment.arena_size, reading);
  std::size_t next = 0;
  for (const Distribution& distribution : distributions)
  {
    placer.AddPlaced(next, distribution.first);
    next = distribution.first + distribution.count;
  }
  placer.AddPlaced(next, reading.experiment.entities.size());
  const std::size_t mistakes = reading.diagnostics.Count();
  const bool has_no_ground = reading.diagnostics.IsLost(kTerrainMap);
  for (const Distribution& distribution : distributions)
  {
    if (has_no_ground || !placer.Place(distribution)) Unplace(distribution, reading.experiment.entities);
  }
  return !has_no_ground && reading.diagnostics.Count() == mistakes;
}

}  // namespace

void PlaceDistributed(Reading& reading)
{
  if (reading.distributions.empty() || !(reading.experiment.arena_size.minCoeff() > 0) || !PlaceAll(reading)) return;
  for (const Distribution& distribution : reading.distributions)
    if (distribution.by_place) SortByPlace(distribution, reading.experiment);
}

}  // namespace swarmanoid
