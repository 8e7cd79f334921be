// The Spiri, a quadrotor, as ARGoS3 models it: <spiri> becomes <argos3_spiri>. Sizes and mass are those of
// spiri_entity.cpp and pointmass3d_spiri_model.cpp (revision 421bd763). ARGoS3 limits neither its speed nor its thrust.
// The limits here are ours. Lengths are in metres.
#include "common/experiment/entity_kind.h"

namespace swarmanoid::argos3
{
namespace
{

EntityKindDescription Spiri()
{
  constexpr double kRadius = 0.332340187, kHeight = 0.09, kMass = 1, kGravity = 9.81;
  EntityKindDescription row;
  row.tag = "argos3_spiri";
  row.word = "Argos3Spiri";
  row.short_word = "spiri";
  row.description = "The Spiri of ARGoS3's experiments, a quadrotor. The position is the centre of its base.";
  row.form = BodyForm::kCylinder;
  row.size = {kRadius, kRadius, kHeight};
  row.mass_kg = kMass;
  row.colour = 0x4a5560;
  // The inertia is that of a cylinder of this size.
  constexpr double kAcross = kMass * (3 * kRadius * kRadius + kHeight * kHeight) / 12;
  row.propellers = Propellers{.max_thrust_n = 2.2 * kMass * kGravity,
                              .inertia_kg_m2 = {kAcross, kAcross, kMass * kRadius * kRadius / 2},
                              .centre_of_mass_m = kHeight / 2,
                              .max_speed_m_s = 10,
                              .plane_force_n = 10,
                              .plane_torque_n_m = 0.4};
  row.attributes = {{"message", 3, 0, "range and bearing: 1 while sending, then bytes 0..4 and 5..9 as one number each",
                     AttributeValue::kBytes}};
  return row;
}

}  // namespace
}  // namespace swarmanoid::argos3

REGISTER_ENTITY_KIND(argos3_spiri, swarmanoid::argos3::Spiri())
