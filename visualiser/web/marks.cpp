// Marks cost time for each robot, so they are made only for requested entities and only when poses or attributes have
// changed. Links follow the rules of the receivers of range and bearing, with the same lines of sight.
#include "visualiser/web/marks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "common/mesh/convex_hull.h"
#include "common/plugins/catalogue.h"
#include "common/space/attributes.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::ordered_json;

double Rounded(double value) { return std::round(value * 1e4) / 1e4; }

bool Knows(const PluginDescription& plugin, std::string_view parameter)
{
  return std::ranges::find(plugin.parameters, parameter, &ParameterSpec::name) != plugin.parameters.end();
}

// Returns 2, then both ends of each edge.
Json EdgesOf(const ConvexHull& hull)
{
  Json edges = Json::array({2});
  for (const ConvexHull::Edge& edge : hull.edges)
    for (const std::uint32_t corner : edge.corners)
      for (const double value : hull.corners[corner]) edges.push_back(Rounded(value));
  return edges;
}

}  // namespace

MarksWriter::MarksWriter(const CSwarmanoidSpace& space)
    : space_(space), query_(space), models_(space), antennas_(space.Size()), scanner_rays_(space)
{
  for (std::size_t e = 0; e < space.Size(); ++e)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    if (!IsRobot(entity.GetKind()) || AttributeOffset(entity.GetKind(), "message") < 0) continue;
    Antenna& antenna = antennas_[e].emplace();
    antenna.message = entity.SlotOf("message");
    SetReceiver(entity.GetConfiguration(), antenna);
    longest_reach_ = std::max(longest_reach_, antenna.range + 2 * antenna.height);
  }
}

bool MarksWriter::IsPresent(std::uint32_t entity) const { return entity < space_.Size() && space_.IsPresent(entity); }

void MarksWriter::SetReceiver(const EntityConfiguration& robot, Antenna& antenna) const
{
  const ControllerConfiguration* controller = space_.GetExperiment().FindController(robot.controller);
  if (controller == nullptr) return;
  for (const DeviceConfiguration& sensor : controller->sensors)
  {
    if (sensor.type != "range_and_bearing") continue;
    const PluginDescription* description =
        PluginCatalogue::Instance().Find(PluginKind::kSensor, sensor.type, sensor.implementation);
    if (description == nullptr || !Knows(*description, "range")) continue;
    const Parameters parameters(sensor.tree, description->parameters);
    antenna.range = parameters.Number("range");
    // Sensors of users may lack the other two.
    if (Knows(*description, "antenna")) antenna.height = parameters.Number("antenna");
    if (Knows(*description, "line_of_sight")) antenna.needs_sight = parameters.Boolean("line_of_sight");
    return;
  }
}

Vector3 MarksWriter::PlaceOf(std::uint32_t robot, double height) const
{
  return space_.GetPose(robot).Apply({0, 0, height});
}

bool MarksWriter::IsInRange(std::uint32_t receiver, std::uint32_t sender) const
{
  const Antenna& own = *antennas_[receiver];
  if (own.range <= 0 || space_.Attributes()[antennas_[sender]->message] == 0) return false;
  return (PlaceOf(sender, own.height) - PlaceOf(receiver, own.height)).norm() <= own.range;
}

bool MarksWriter::IsInSight(std::uint32_t receiver, std::uint32_t sender)
{
  const Antenna& own = *antennas_[receiver];
  return !own.needs_sight ||
         !query_.IsOccluded(PlaceOf(receiver, own.height), PlaceOf(sender, own.height), receiver, sender);
}

std::string MarksWriter::Text(const MarksRequest& wanted)
{
  Json rays{{"entities", Json::array()}, {"hits", Json::array()}};
  Json scans = Json::array();
  for (const std::uint32_t robot : wanted.rays)
  {
    if (!IsPresent(robot)) continue;
    FindProximityRays(space_, query_, robot, rays_);
    if (!rays_.empty())
    {
      Json hits = Json::array();
      for (const ProximityRay& ray : rays_) hits.push_back(Rounded(ray.hit));
      rays["entities"].push_back(robot);
      rays["hits"].push_back(std::move(hits));
    }
    // The page does not know the beams of scanners, and gets the ends in the frame of the robot.
    rays_.clear();
    scanner_rays_.Find(query_, robot, rays_);
    if (rays_.empty()) continue;
    const Pose to_robot = space_.GetPose(robot).Inverse();
    Json start = Json::array(), free = Json::array(), hit = Json::array();
    const auto put = [&](const Vector3& place, Json& list)
    {
      const Vector3 local = to_robot.Apply(place);
      for (int axis = 0; axis < 3; ++axis) list.push_back(Rounded(local[axis]));
    };
    put(rays_.front().from, start);
    for (const ProximityRay& ray : rays_) put(ray.from + ray.hit * (ray.to - ray.from), ray.hit < 1 ? hit : free);
    scans.push_back({{"entity", robot}, {"from", start}, {"free", free}, {"hit", hit}});
  }

  // Robots of one kind usually have the same bodies.
  Json shapes{{"entities", Json::array()}, {"models", Json::array()}, {"bodies", Json::array()}};
  std::map<std::string, int> known;
  for (const std::uint32_t entity : wanted.bodies)
  {
    if (!IsPresent(entity)) continue;
    models_.BodiesOf(entity, bodies_);
    if (bodies_.empty()) continue;
    Json model = Json::array();
    for (const auto& [is_cylinder, pose, half, hull] : bodies_)
    {
      if (hull != nullptr)
      {
        model.push_back(EdgesOf(*hull));
        continue;
      }
      const Vector3& p = pose.position;
      const Quaternion& q = pose.orientation;
      Json body = Json::array({is_cylinder ? 1 : 0});
      for (const double value : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), half.x(), half.y(), half.z()})
        body.push_back(Rounded(value));
      model.push_back(std::move(body));
    }
    const auto [place, is_new] = known.emplace(model.dump(), static_cast<int>(known.size()));
    if (is_new) shapes["bodies"].push_back(std::move(model));
    shapes["entities"].push_back(entity);
    shapes["models"].push_back(place->second);
  }

  // A link follows the rules of the receivers of range and bearing: the sender sends, and is within range of the
  // antenna and in sight. Each pair occurs once, in one direction or in both.
  Json both = Json::array(), one = Json::array();
  std::vector<char> asked(space_.Size());
  for (const std::uint32_t robot : wanted.links)
    if (IsPresent(robot) && antennas_[robot]) asked[robot] = 1;
  for (std::uint32_t robot = 0; longest_reach_ > 0 && robot < asked.size(); ++robot)
  {
    if (!asked[robot]) continue;
    for (const std::uint32_t other : query_.FindWithin(space_.GetPose(robot).position, longest_reach_))
    {
      if (other == robot || !antennas_[other] || (asked[other] && other < robot)) continue;
      bool hears = IsInRange(robot, other), is_heard = IsInRange(other, robot);
      if (!hears && !is_heard) continue;
      if (antennas_[robot]->SeesAs(*antennas_[other]))
      {
        // One line of sight serves both directions.
        if (!IsInSight(robot, other)) continue;
      }
      else
      {
        hears = hears && IsInSight(robot, other);
        is_heard = is_heard && IsInSight(other, robot);
        if (!hears && !is_heard) continue;
      }
      Json& list = hears && is_heard ? both : one;
      list.push_back(is_heard ? robot : other);
      list.push_back(is_heard ? other : robot);
    }
  }
  return Json{{"type", "marks"},
              {"tick", space_.GetTick()},
              {"rays", std::move(rays)},
              {"scans", std::move(scans)},
              {"shapes", std::move(shapes)},
              {"links", {{"both", std::move(both)}, {"one", std::move(one)}}}}
      .dump();
}

}  // namespace swarmanoid
