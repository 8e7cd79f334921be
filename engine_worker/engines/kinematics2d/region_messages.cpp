#include "engine_worker/engines/kinematics2d/region_messages.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace swarmanoid::kinematics2d
{
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
  message.Put<ModelParts>(model);
  message.PutArray(model.polygons);
}

CollisionModel GetModel(ByteReader& message)
{
  CollisionModel model;
  static_cast<ModelParts&>(model) = message.Get<ModelParts>();
  model.polygons = message.GetArray<Polygon>();
  const auto polygons = static_cast<int>(model.polygons.size());
  const bool is_model = model.parts >= polygons && model.parts <= CollisionModel::kMaximumParts &&
                        model.circles == model.parts - polygons &&
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
