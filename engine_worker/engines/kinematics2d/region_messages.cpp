#include "engine_worker/engines/kinematics2d/region_messages.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace swarmanoid::kinematics2d
{
namespace
{

// A model without its polygons.
struct ModelImage
{
  CollisionModel::PartValues x, y, radius;
  std::array<std::uint8_t, 8> on_turret;
  std::uint32_t parts, circles;
  double bounding_radius, core_radius;
};

}  // namespace

void RefuseRegion(const char* reason)
{
  throw std::runtime_error(std::string("the regions of a plane do not agree: ") + reason);
}

void CheckCuts(const BroadPhase& broad, std::span<const std::uint8_t> region_of_block, unsigned regions)
{
  if (region_of_block.size() != broad.BlockCount())
    throw std::runtime_error("cuts of a plane: there must be a region for each of its " +
                             std::to_string(broad.BlockCount()) + " blocks");
  for (const std::uint8_t region : region_of_block)
    if (region >= regions) throw std::runtime_error("cuts of a plane: there is no region " + std::to_string(region));
}

void PutModel(const CollisionModel& model, ByteWriter& message)
{
  ModelImage image{model.part_x,
                   model.part_y,
                   model.part_radius,
                   {},
                   static_cast<std::uint32_t>(model.parts),
                   static_cast<std::uint32_t>(model.circles),
                   model.bounding_radius,
                   model.core_radius};
  std::ranges::copy(model.on_turret, image.on_turret.begin());
  message.Put(image);
  message.PutArray(model.polygons);
}

CollisionModel GetModel(ByteReader& message)
{
  const auto image = message.Get<ModelImage>();
  CollisionModel model;
  model.part_x = image.x;
  model.part_y = image.y;
  model.part_radius = image.radius;
  for (std::size_t k = 0; k < model.on_turret.size(); ++k) model.on_turret[k] = image.on_turret[k] != 0;
  model.parts = static_cast<int>(image.parts);
  model.circles = static_cast<int>(image.circles);
  model.bounding_radius = image.bounding_radius;
  model.core_radius = image.core_radius;
  model.polygons = message.GetArray<Polygon>();
  const bool is_model = image.parts <= CollisionModel::kMaximumParts &&
                        image.circles + model.polygons.size() == image.parts &&
                        std::ranges::all_of(model.polygons, [](const Polygon& p)
                                            { return p.count >= 3 && p.count <= Polygon::kMaximumVertices; });
  if (!is_model) RefuseRegion("a model has other parts than a model may have");
  return model;
}

void PutBody(const Bodies& bodies, std::uint32_t body, std::uint32_t number, ByteWriter& message)
{
  const double rate = bodies.TurretRate(body);
  const double angle = bodies.turret_angle[body];
  const bool has_turret = rate != 0 || angle != 0;
  message.Put(BodyMessage::Fixed{number, bodies.model[body] & 0x3fffffffU, bodies.is_present[body] != 0, has_turret,
                                 bodies.now.Get(body), bodies.twists.Get(body)});
  if (has_turret) message.Put(BodyMessage::TurretState{angle, rate});
  if (bodies.keeps_travel) message.Put(BodyMessage::Travel{bodies.travel_forward[body], bodies.travel_turn[body]});
}

BodyMessage GetBody(const Bodies& bodies, ByteReader& message)
{
  BodyMessage body{};
  body.body = message.Get<BodyMessage::Fixed>();
  if (body.body.has_turret) body.turret = message.Get<BodyMessage::TurretState>();
  if (bodies.keeps_travel) body.travel = message.Get<BodyMessage::Travel>();
  if (body.body.model >= bodies.models.size()) RefuseRegion("a body of an unknown model was sent");
  return body;
}

}  // namespace swarmanoid::kinematics2d
