// The index knows only the origins of entities, and bodies extend beyond them. So a search for bodies between two
// points takes the box around the segment, widened by the largest radius of a small body. It tests exactly each body
// whose origin is in the box. Large bodies, such as walls, and articulated ones (CollisionModels) would make that box
// too wide. They and the terrains are tested one by one.
//
// Invariant: the first hit has the smallest fraction and, among equal ones, the smallest entity number. So it does not
// depend on the index.
#include "common/space/space_query.h"

#include <algorithm>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

// Bodies above this radius, such as walls, are tested one by one. Otherwise every search would be as wide as they are.
constexpr double kLargeBody = 0.75;

}  // namespace

SpaceQuery::SpaceQuery(const CSwarmanoidSpace& space) : space_(space), revision_(space.Revision() - 1), models_(space)
{
  const Experiment& experiment = space.GetExperiment();
  if (experiment.engines.size() > 64)
    throw ConfigurationError(experiment.engines[64].location, "at most 64 engines are allowed in one experiment");
  index_ = MakePositionalIndex(experiment.optimization, experiment.arena_size, experiment.entities.size());
  engines_.assign(space.Size(), 0);
  for (std::size_t e = 0; e < experiment.engines.size(); ++e)
    for (const std::uint32_t entity : experiment.engines[e].entities) engines_[entity] |= 1ULL << e;
  for (std::uint32_t i = 0; i < space.Size(); ++i)
  {
    const Shape shape = ShapeOf(experiment.entities[i]);
    const double reach = BoundingRadius(shape) + shape.centre.norm();
    if (models_.IsArticulated(i) || (shape.kind != Shape::Kind::kNone && reach > kLargeBody))
      large_.push_back(i);
    else
      search_radius_ = std::max(search_radius_, reach);
    shapes_.push_back(shape);
    if (DescriptionOf(experiment.entities[i].kind).role == EntityRole::kTerrain)
      terrains_.emplace_back(i, LoadTerrain(experiment.entities[i], experiment.folder));
  }
}

SpaceQuery::~SpaceQuery() = default;

void SpaceQuery::Refresh()
{
  if (revision_ == space_.Revision()) return;
  revision_ = space_.Revision();
  index_->Update({space_.Poses().x, space_.Poses().y, space_.Poses().z});
}

const PositionalIndex& SpaceQuery::Index()
{
  Refresh();
  return *index_;
}

const std::vector<std::uint32_t>& SpaceQuery::FindWithin(const Vector3& point, double distance)
{
  Index().FindWithin(point, distance, found_);
  DropAbsent(found_);
  return found_;
}

const std::vector<std::uint32_t>& SpaceQuery::FindWithin(const CSwarmanoidSpaceEntity& entity, double distance)
{
  Index().FindWithin(entity.GetPosition(), distance, found_);
  std::erase(found_, entity.GetIndex());
  DropAbsent(found_);
  return found_;
}

const std::vector<std::uint32_t>& SpaceQuery::FindInBox(const Vector3& low, const Vector3& high)
{
  Index().FindInBox(low, high, found_);
  DropAbsent(found_);
  return found_;
}

void SpaceQuery::DropAbsent(std::vector<std::uint32_t>& entities) const
{
  std::erase_if(entities, [this](std::uint32_t entity) { return !space_.IsPresent(entity); });
}

const CSwarmanoidSpaceEntity* SpaceQuery::FindNearest(const Vector3& point, double distance)
{
  const auto nearest = Index().FindNearest(point, distance);
  return nearest && space_.IsPresent(*nearest) ? &space_.GetEntity(*nearest) : nullptr;
}

const CSwarmanoidSpaceEntity* SpaceQuery::FindNearest(const CSwarmanoidSpaceEntity& entity, double distance)
{
  const auto nearest = Index().FindNearest(entity.GetPosition(), distance, entity.GetIndex());
  return nearest && space_.IsPresent(*nearest) ? &space_.GetEntity(*nearest) : nullptr;
}

std::optional<SpaceQuery::Hit> SpaceQuery::FindFirstHit(const Vector3& from, const Vector3& to, std::uint32_t observer,
                                                        std::span<const std::uint32_t> ignored)
{
  return FirstHit(
      from, to, [&](std::uint32_t entity) { return ShareEngine(entity, observer); }, ignored);
}

template <class Counts>
std::optional<SpaceQuery::Hit> SpaceQuery::FirstHit(const Vector3& from, const Vector3& to, const Counts& in_world,
                                                    std::span<const std::uint32_t> ignored)
{
  const Vector3 reach = Vector3::Constant(search_radius_);
  Index().FindInBox(from.cwiseMin(to) - reach, from.cwiseMax(to) + reach, candidates_);
  std::optional<Hit> first;
  const auto counts = [&](std::uint32_t entity)
  {
    return space_.IsPresent(entity) && in_world(entity) &&
           std::find(ignored.begin(), ignored.end(), entity) == ignored.end();
  };
  const auto keep = [&](std::uint32_t entity, std::optional<double> fraction)
  {
    if (fraction && (!first || *fraction < first->fraction || (*fraction == first->fraction && entity < first->entity)))
      first = Hit{entity, *fraction};
  };
  const auto test = [&](std::uint32_t entity)
  {
    if (!counts(entity)) return;
    if (!models_.IsArticulated(entity))
      return keep(entity, SegmentHit(shapes_[entity], space_.GetPose(entity), from, to));
    models_.BodiesOf(entity, bodies_);
    keep(entity, SegmentHit(bodies_, space_.GetPose(entity), from, to));
  };
  for (const std::uint32_t entity : large_) test(entity);
  for (const std::uint32_t entity : candidates_)
    if (!std::binary_search(large_.begin(), large_.end(), entity)) test(entity);
  for (const auto& [entity, terrain] : terrains_)
  {
    if (!counts(entity)) continue;
    const Pose inverse = space_.GetPose(entity).Inverse();
    keep(entity, terrain->SegmentHit(inverse.Apply(from), inverse.Apply(to)));
  }
  return first;
}

bool SpaceQuery::IsOccluded(const Vector3& from, const Vector3& to, std::uint32_t observer, std::uint32_t target)
{
  const std::array<std::uint32_t, 2> ends{observer, target};
  const auto hides = [&](std::uint32_t entity)
  {
    return ShareEngine(entity, observer) || ShareEngine(entity, target) ||
           (engines_[entity] == 0 && !space_.GetEntity(entity).IsMovable());
  };
  return FirstHit(from, to, hides, ends).has_value();
}

}  // namespace swarmanoid
