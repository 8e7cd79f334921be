#include "common/space/collision_models.h"

#include <algorithm>
#include <cmath>

#include "common/mesh/convex_hull.h"
#include "common/plugins/catalogue.h"
#include "common/space/attributes.h"
#include "common/space/shape.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

// Bodies that extend beyond the plain body by less are ignored by sensors: a gripper, the wheels.
constexpr double kBeyondPlainBody = 0.02;  // m

}  // namespace

double ReachOf(const CollisionBody& body)
{
  const Vector3& half = body.half_size;
  const double across = body.is_cylinder ? half.x() * half.x() : half.x() * half.x() + half.y() * half.y();
  return body.pose.position.norm() + std::sqrt(across + half.z() * half.z());
}

namespace
{

// Returns the fraction of the way at which the segment enters the hull: where the part begins that is inside all faces.
std::optional<double> SegmentHit(const ConvexHull& hull, const Pose& pose, const Vector3& from, const Vector3& to)
{
  const Quaternion inverse = pose.orientation.conjugate();
  const Vector3 start = inverse * (from - pose.position);
  const Vector3 step = inverse * (to - from);
  double enter = 0;
  double leave = 1;
  for (const ConvexHull::Face& face : hull.faces)
  {
    const double outside = face.normal.dot(start) - face.distance;
    const double approach = -face.normal.dot(step);
    if (approach == 0 && outside > 0) return std::nullopt;
    if (approach > 0) enter = std::max(enter, outside / approach);
    if (approach < 0) leave = std::min(leave, outside / approach);
  }
  if (enter > leave) return std::nullopt;
  return enter;
}

}  // namespace

std::optional<double> SegmentHit(std::span<const CollisionBody> bodies, const Pose& pose, const Vector3& from,
                                 const Vector3& to)
{
  std::optional<double> first;
  for (const CollisionBody& body : bodies)
  {
    if (body.hull != nullptr)
    {
      const std::optional<double> hit = SegmentHit(*body.hull, pose, from, to);
      if (hit && (!first || *hit < *first)) first = hit;
      continue;
    }
    const Shape shape{body.is_cylinder ? Shape::Kind::kCylinder : Shape::Kind::kBox, Vector3::Zero(), body.half_size};
    const std::optional<double> hit = SegmentHit(shape, pose.Compose(body.pose), from, to);
    if (hit && (!first || *hit < *first)) first = hit;
  }
  return first;
}

CollisionModels::CollisionModels(const CSwarmanoidSpace& space) : space_(space), engine_of_(space.Size(), -1)
{
  const std::vector<EngineConfiguration>& engines = space.GetExperiment().engines;
  for (std::size_t e = 0; e < engines.size(); ++e)
    for (const std::uint32_t entity : engines[e].entities)
      if (engine_of_[entity] < 0) engine_of_[entity] = static_cast<int>(e);

  std::vector<CollisionBody> bodies;
  for (std::uint32_t entity = 0; entity < space.Size(); ++entity)
  {
    const bool has_hull = space.GetEntity(entity).GetConfiguration().hull != nullptr;
    if (!has_hull && !space.GetEntity(entity).IsMovable()) continue;
    std::vector<CollisionBody> plain;
    AddPlainBody(space.GetEntity(entity).GetConfiguration(), plain);
    BodiesOf(entity, bodies);
    double reach = 0;
    double plain_reach = 0;
    for (const CollisionBody& body : bodies) reach = std::max(reach, ReachOf(body));
    for (const CollisionBody& body : plain) plain_reach = std::max(plain_reach, ReachOf(body));
    const bool has_links = !DescriptionOf(space.GetEntity(entity).GetKind()).links.empty();
    if (has_hull || has_links || reach > plain_reach + kBeyondPlainBody) articulated_.push_back(entity);
  }
}

void CollisionModels::BodiesOf(std::uint32_t entity, std::vector<CollisionBody>& bodies) const
{
  bodies.clear();
  const EntityConfiguration& configuration = space_.GetEntity(entity).GetConfiguration();
  const int number = space_.EngineOf(entity, engine_of_);
  const PluginDescription* engine =
      number < 0 ? nullptr
                 : PluginCatalogue::Instance().Find(
                       PluginKind::kEngine, space_.GetExperiment().engines[static_cast<std::size_t>(number)].tag);
  if (engine == nullptr || engine->collision_model == nullptr) return AddPlainBody(configuration, bodies);
  const auto slots = static_cast<std::size_t>(AttributeCount(configuration.kind));
  engine->collision_model(configuration, space_.Attributes().Part(space_.GetEntity(entity).FirstSlot(), slots), bodies);
}

bool CollisionModels::IsArticulated(std::uint32_t entity) const
{
  return std::binary_search(articulated_.begin(), articulated_.end(), entity);
}

}  // namespace swarmanoid
