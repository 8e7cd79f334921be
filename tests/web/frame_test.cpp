#include "visualiser/web/frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/web/four_entities.h"

namespace swarmanoid
{
namespace
{

template <class Value>
Value At(const std::string& bytes, std::size_t place)
{
  Value value;
  EXPECT_LE(place + sizeof value, bytes.size());
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

std::uint8_t ByteAt(const std::string& bytes, std::size_t place) { return At<std::uint8_t>(bytes, place); }

// Where the parts of a frame of n entities start.
std::size_t QuaternionsOf(std::size_t n) { return sizeof(FrameHeader) + 12 * n; }
std::size_t ColoursOf(std::size_t n) { return sizeof(FrameHeader) + 20 * n; }
std::size_t EndOf(std::size_t n) { return sizeof(FrameHeader) + 24 * n; }

TEST(WebFrame, ARobotTakesTwentyFourBytes)
{
  Experiment experiment;
  experiment.arena_size = {100, 100, 1};
  for (int i = 0; i < 1000; ++i)
    experiment.entities.push_back(FourEntities::Entity(EntityKind::kFootbot, "fb_" + std::to_string(i), {i * 0.1, 1, 0},
                                                       {0.085, 0.085, 0.147}, true));
  CSwarmanoidSpace space(experiment);
  EXPECT_EQ(FrameWriter(space).Write().size(), sizeof(FrameHeader) + 24 * 1000);
}

TEST(WebFrame, WhoIsNotInTheArenaIsMarked)
{
  FourEntities world;
  FrameWriter writer(world.space);
  const auto flags = [&] { return writer.Write()[EndOf(3) - 4 * 3 + 4 * 1 + 3] & kAbsent; };
  const std::uint32_t entity = world.space.Movable()[1];
  EXPECT_EQ(flags(), 0);
  world.space.SetAttribute(world.space.PresenceSlot(entity), 0);
  EXPECT_EQ(flags(), kAbsent);
  world.space.SetAttribute(world.space.PresenceSlot(entity), 1);
  EXPECT_EQ(flags(), 0);
}

TEST(WebFrame, PosesAreThoseOfTheMovableEntities)
{
  FourEntities world;
  world.space.SetTick(7);
  const Quaternion turned = QuaternionFromYaw(2.5);
  world.space.SetPose(2, {{3.25, 0.5, 0.125}, turned});
  const std::string bytes = FrameWriter(world.space).Write();
  const auto header = At<FrameHeader>(bytes, 0);
  EXPECT_EQ(header.magic, 0x314d5753u);
  EXPECT_EQ(header.entities, 3u);
  EXPECT_EQ(header.tick, 7u);
  EXPECT_DOUBLE_EQ(header.time_s, 0.7);
  EXPECT_EQ(At<float>(bytes, sizeof(FrameHeader) + 24), 3.25f);
  EXPECT_EQ(At<float>(bytes, sizeof(FrameHeader) + 28), 0.5f);
  EXPECT_EQ(At<float>(bytes, sizeof(FrameHeader) + 32), 0.125f);
  const double z = At<std::int16_t>(bytes, QuaternionsOf(3) + 2 * 8 + 4) / 32767.0;
  const double w = At<std::int16_t>(bytes, QuaternionsOf(3) + 2 * 8 + 6) / 32767.0;
  EXPECT_NEAR(2 * std::atan2(z, w), 2.5, 1e-4);
}

TEST(WebFrame, LedsThatAreAlikeAreOneColour)
{
  FourEntities world;
  FrameWriter writer(world.space);
  EXPECT_EQ(ByteAt(writer.Write(), ColoursOf(3) + 3), 0);
  for (int led = 0; led < 12; ++led) world.space.GetEntity(0).SetAttribute("led", 0x0080ff, led);
  const std::string bytes = writer.Write();
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3)), 0x00);
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3) + 1), 0x80);
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3) + 2), 0xff);
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3) + 3), kLit);
  EXPECT_EQ(bytes.size(), EndOf(3));
}

TEST(WebFrame, LedsOfSeveralColoursFollowOneByOne)
{
  FourEntities world;
  world.space.GetEntity(0).SetAttribute("led", 0xff0000, 3);
  world.space.GetEntity(0).SetAttribute("led", 0x0000ff, 4);
  const std::string bytes = FrameWriter(world.space).Write();
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3) + 3), kLit | kUnevenRing);
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3)), 0x7f);  // the mean of those that shine
  ASSERT_EQ(At<FrameHeader>(bytes, 0).rings, 1u);
  const auto ring = At<FrameRing>(bytes, EndOf(3));
  EXPECT_EQ(ring.entity, 0u);
  EXPECT_EQ(ring.colours[3][0], 0xff);
  EXPECT_EQ(ring.colours[4][2], 0xff);
  EXPECT_EQ(ring.colours[5][0], 0);
}

TEST(WebFrame, GripsNameBothEntities)
{
  FourEntities world;
  world.space.GetEntity(0).SetAttribute("gripped", 3);  // entity 2
  const std::string bytes = FrameWriter(world.space).Write();
  ASSERT_EQ(At<FrameHeader>(bytes, 0).grips, 1u);
  const auto grip = At<FrameGrip>(bytes, EndOf(3));
  EXPECT_EQ(grip.robot, 0u);
  EXPECT_EQ(grip.held, 2u);
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3) + 3), kGripping);
}

TEST(WebFrame, ABeamEndsOnTheFloorOrOnTheFirstBody)
{
  FourEntities world;
  CSwarmanoidSpaceEntity& eyebot = world.space.GetEntity(1);
  eyebot.SetAttribute("laser", 1);
  eyebot.SetAttribute("laser_colour", 0x00ff00);
  FrameWriter writer(world.space);
  std::string bytes = writer.Write();
  ASSERT_EQ(At<FrameHeader>(bytes, 0).beams, 1u);
  auto beam = At<FrameBeam>(bytes, EndOf(3));
  EXPECT_EQ(beam.entity, 1u);
  EXPECT_EQ(beam.colour, 0x00ff00u);
  EXPECT_NEAR(beam.x, 2, 1e-6);
  EXPECT_NEAR(beam.z, 0, 1e-6);

  // Tilted towards the prey, 1 m to the side and 0.2 m high: the beam meets its top.
  eyebot.SetAttribute("laser_tilt", std::atan2(1.0, 1.3));
  bytes = writer.Write();
  beam = At<FrameBeam>(bytes, EndOf(3));
  EXPECT_NEAR(beam.x, 3, 1e-5);
  EXPECT_NEAR(beam.z, 0.2, 1e-5);
}

}  // namespace
}  // namespace swarmanoid
