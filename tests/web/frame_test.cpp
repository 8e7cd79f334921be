#include "visualiser/web/state_frame.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <random>

#include "tests/web/four_entities.h"
#include "tests/world/small_experiment.h"

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

// They stand in a row, 0.1 m apart.
Experiment AThousandFootbots()
{
  Experiment experiment;
  experiment.arena_size = {100, 100, 1};
  for (int i = 0; i < 1000; ++i)
    experiment.entities.push_back(
        test::Entity(EntityKind::kFootbot, "fb_" + std::to_string(i), {i * 0.1, 1, 0}, {0.085, 0.085, 0.147}, true));
  return experiment;
}

TEST(WebFrame, ARobotTakesTwentyFourBytes)
{
  const Experiment experiment = AThousandFootbots();
  CSwarmanoidSpace space(experiment);
  EXPECT_EQ(FrameWriter(space).WriteKey().size(), sizeof(FrameHeader) + 24 * 1000);
}

TEST(WebFrame, WhoIsNotInTheArenaIsMarked)
{
  FourEntities world;
  FrameWriter writer(world.space);
  const auto flags = [&] { return writer.WriteKey()[EndOf(3) - 4 * 3 + 4 * 1 + 3] & kAbsent; };
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
  const std::string bytes = FrameWriter(world.space).WriteKey();
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

// The state that a page has, read by the letter of docs/web_render.md.
struct PageState
{
  std::vector<float> positions;
  std::vector<std::int16_t> quaternions;
  std::string colours;
  std::uint32_t key = 0;

  explicit PageState(const std::string& bytes)
  {
    const auto header = At<FrameHeader>(bytes, 0);
    EXPECT_EQ(header.magic, 0x314d5753u);
    const std::size_t n = header.entities;
    for (std::size_t i = 0; i < 3 * n; ++i) positions.push_back(At<float>(bytes, 40 + 4 * i));
    for (std::size_t i = 0; i < 4 * n; ++i) quaternions.push_back(At<std::int16_t>(bytes, QuaternionsOf(n) + 2 * i));
    colours = bytes.substr(ColoursOf(n), 4 * n);
    key = header.key;
  }

  void Change(const std::string& bytes)
  {
    const auto header = At<FrameHeader>(bytes, 0);
    ASSERT_EQ(header.magic, 0x324d5753u);
    ASSERT_EQ(header.key, key);
    const std::size_t n = header.entities;
    ASSERT_EQ(n, positions.size() / 3);
    const std::size_t steps = bytes.size() - 6 * n;
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t k = 0; k < 2; ++k)
        positions[3 * i + k] += 1e-4F * At<std::int16_t>(bytes, steps + 6 * i + 2 * k);
      const double yaw = At<std::int16_t>(bytes, steps + 6 * i + 4) / 32767.0 * 3.14159265358979;
      quaternions[4 * i] = quaternions[4 * i + 1] = 0;
      quaternions[4 * i + 2] = static_cast<std::int16_t>(std::lround(32767 * std::sin(yaw / 2)));
      quaternions[4 * i + 3] = static_cast<std::int16_t>(std::lround(32767 * std::cos(yaw / 2)));
    }
    std::size_t place = 48;
    for (std::uint32_t i = 0; i < At<std::uint32_t>(bytes, 40); ++i, place += 24)
    {
      const std::size_t slot = At<std::uint32_t>(bytes, place);
      for (std::size_t k = 0; k < 3; ++k) positions.at(3 * slot + k) = At<float>(bytes, place + 4 + 4 * k);
      for (std::size_t k = 0; k < 4; ++k) quaternions.at(4 * slot + k) = At<std::int16_t>(bytes, place + 16 + 2 * k);
    }
    for (std::uint32_t i = 0; i < At<std::uint32_t>(bytes, 44); ++i, place += 8)
      colours.replace(4 * At<std::uint32_t>(bytes, place), 4, bytes.substr(place + 4, 4));
  }
};

TEST(WebFrame, AKeyAndItsChangeAreTheStateAgain)
{
  FourEntities world;
  FrameWriter writer(world.space);
  EXPECT_EQ(writer.WriteChange(), "") << "there is nothing yet that could have changed";
  std::mt19937 random(3);
  const auto number = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int round = 0; round < 500; ++round)
  {
    const PageState key(writer.WriteKey());
    for (int step = 0; step < 3; ++step)
    {
      const std::uint32_t entity = world.space.Movable()[random() % 3];
      const Pose pose = world.space.GetPose(entity);
      Vector3 place = pose.position + Vector3(number(-0.1, 0.1), number(-0.1, 0.1), 0);
      Quaternion turn = QuaternionFromYaw(number(-10, 10));
      switch (random() % 6)
      {
        case 0:
          place.z() += number(-0.1, 0.1);
          break;
        case 1:
          turn = turn * Quaternion(Eigen::AngleAxisd(number(0.1, 1), Vector3::UnitX()));
          break;
        case 2:
          place.x() = number(-50, 50);  // further than a step reaches
          break;
        case 3:
          world.space.GetEntity(0).SetAttribute("led", static_cast<double>(random() & 0xffffffU),
                                                static_cast<int>(random() % 12));
          break;
        default:
          break;
      }
      world.space.SetPose(entity, {place, turn});
      const std::string change = writer.WriteChange();
      const std::string whole = FrameWriter(world.space).WriteKey();
      const PageState expected(whole);
      if (change.empty()) continue;
      EXPECT_LT(change.size(), whole.size());
      PageState page = key;
      page.Change(change);
      for (std::size_t i = 0; i < page.positions.size(); ++i)
        EXPECT_NEAR(page.positions[i], expected.positions[i], i % 3 == 2 ? 0 : 6e-5);
      for (std::size_t slot = 0; slot < 3; ++slot)
      {
        const auto* a = &page.quaternions[4 * slot];
        const auto* b = &expected.quaternions[4 * slot];
        const double dot = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]) / (32767.0 * 32767.0);
        EXPECT_NEAR(std::abs(dot), 1, 1e-4);
      }
      EXPECT_EQ(page.colours, expected.colours);
    }
  }
}

TEST(WebFrame, ARobotThatDrivesTakesSixBytesOfAChange)
{
  const Experiment experiment = AThousandFootbots();
  CSwarmanoidSpace space(experiment);
  FrameWriter writer(space);
  writer.WriteKey();
  for (std::uint32_t e = 0; e < 1000; ++e) space.SetPose(e, {{e * 0.1 + 0.02, 1.3, 0}, QuaternionFromYaw(e)});
  EXPECT_EQ(writer.WriteChange().size(), sizeof(FrameHeader) + sizeof(ChangeCounts) + 6 * 1000);
  // If most have left the plane, all of the state is shorter.
  for (std::uint32_t e = 0; e < 600; ++e) space.SetPose(e, {{e * 0.1, 1, 0.5}, QuaternionFromYaw(0)});
  EXPECT_EQ(writer.WriteChange(), "");
}

TEST(WebFrame, LedsThatAreAlikeAreOneColour)
{
  FourEntities world;
  FrameWriter writer(world.space);
  EXPECT_EQ(ByteAt(writer.WriteKey(), ColoursOf(3) + 3), 0);
  for (int led = 0; led < 12; ++led) world.space.GetEntity(0).SetAttribute("led", 0x0080ff, led);
  const std::string bytes = writer.WriteKey();
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
  const std::string bytes = FrameWriter(world.space).WriteKey();
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3) + 3), kLit | kUnevenRing);
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3)), 0x7f);  // the mean of the lit LEDs
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
  const std::string bytes = FrameWriter(world.space).WriteKey();
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
  std::string bytes = writer.WriteKey();
  ASSERT_EQ(At<FrameHeader>(bytes, 0).beams, 1u);
  auto beam = At<FrameBeam>(bytes, EndOf(3));
  EXPECT_EQ(beam.entity, 1u);
  EXPECT_EQ(beam.colour, 0x00ff00u);
  EXPECT_NEAR(beam.x, 2, 1e-6);
  EXPECT_NEAR(beam.z, 0, 1e-6);

  // The beam is tilted towards the prey, 1 m to the side and 0.2 m high, and meets its top.
  eyebot.SetAttribute("laser_tilt", std::atan2(1.0, 1.3));
  bytes = writer.WriteKey();
  beam = At<FrameBeam>(bytes, EndOf(3));
  EXPECT_NEAR(beam.x, 3, 1e-5);
  EXPECT_NEAR(beam.z, 0.2, 1e-5);
}

// The numbers of the flags are those of docs/web_render.md.
TEST(WebFrame, EachStateOfAnEntityHasItsFlagAndColour)
{
  Experiment experiment = FourEntities::Make();
  test::Add(experiment, test::Entity(EntityKind::kHandbot, "hb_0", {1, 3, 0}));
  CSwarmanoidSpace space(experiment);
  const std::size_t n = space.Movable().size();
  ASSERT_EQ(n, 4U);
  struct Row
  {
    const char* id;
    const char* attribute;
    int element;
    double value;
    std::uint32_t colour;
    int flags;
  };
  const Row rows[] = {{"fb_0", "gripped", 0, 5, 0, 4},
                      {"fb_0", "beacon", 0, 0x804020, 0x804020, 1 + 16},
                      {"fb_0", "turret_angle", 0, 1, 0, 0},
                      {"eb_0", "led", 15, 0x102030, 0x102030, 1 + 2},
                      {"eb_0", "led", 0, 0x302010, 0x302010, 1 + 2},
                      {"eb_0", "laser", 0, 1, 0, 8},
                      {"eb_0", "attached", 0, 1, 0, 32},
                      {"hb_0", "gripped", 1, 1, 0, 4},
                      {"hb_0", "rope_attached", 0, 1, 0, 32},
                      {"prey", "colour", 0, 0x123456, 0x123456, 0}};
  for (const auto& [id, attribute, element, value, colour, flags] : rows)
  {
    CSwarmanoidSpaceEntity& entity = *space.FindEntity(id);
    const double before = entity.GetAttribute(attribute, element);
    entity.SetAttribute(attribute, value, element);
    const std::string bytes = FrameWriter(space).WriteKey();
    std::size_t slot = 0;
    while (space.Movable()[slot] != entity.GetIndex()) ++slot;
    const std::size_t place = ColoursOf(n) + 4 * slot;
    const auto byte = [&](std::size_t k) { return std::uint32_t{ByteAt(bytes, place + k)}; };
    EXPECT_EQ(byte(0) << 16U | byte(1) << 8U | byte(2), colour) << id << " " << attribute;
    EXPECT_EQ(byte(3), static_cast<std::uint32_t>(flags)) << id << " " << attribute;
    entity.SetAttribute(attribute, before, element);
  }
}

TEST(WebFrame, HandsHoldOneEntityEachAndOnlyInTheArena)
{
  Experiment experiment = FourEntities::Make();
  const std::uint32_t robot = test::Add(experiment, test::Entity(EntityKind::kHandbot, "hb_0", {1, 3, 0}));
  CSwarmanoidSpace space(experiment);
  space.GetEntity(robot).SetAttribute("gripped", 1, 0);  // entity 0
  space.GetEntity(robot).SetAttribute("gripped", 3, 1);
  FrameWriter writer(space);
  const std::string bytes = writer.WriteKey();
  ASSERT_EQ(At<FrameHeader>(bytes, 0).grips, 2u);
  for (std::size_t hand = 0; hand < 2; ++hand)
  {
    const auto grip = At<FrameGrip>(bytes, EndOf(4) + hand * sizeof(FrameGrip));
    EXPECT_EQ(grip.robot, robot);
    EXPECT_EQ(grip.held, hand == 0 ? 0u : 2u);
  }
  space.SetAttribute(space.PresenceSlot(robot), 0);
  EXPECT_EQ(At<FrameHeader>(writer.WriteKey(), 0).grips, 0u);
}

TEST(WebFrame, TheColourOfUnevenLedsIsTheMeanOfThoseThatShine)
{
  FourEntities world;
  CSwarmanoidSpaceEntity& robot = world.space.GetEntity(0);
  robot.SetAttribute("beacon", 0xffffff);  // it counts only if no LED shines
  robot.SetAttribute("led", 0x102030, 0);
  robot.SetAttribute("led", 0x305070, 6);
  robot.SetAttribute("led", 0x50a0e0, 11);
  const std::string bytes = FrameWriter(world.space).WriteKey();
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3)), 0x30);
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3) + 1), 0x5a);
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3) + 2), 0x80);
  EXPECT_EQ(ByteAt(bytes, ColoursOf(3) + 3), 1 + 2 + 16);
  const auto ring = At<FrameRing>(bytes, EndOf(3));
  EXPECT_THAT(ring.colours[11], testing::ElementsAre(0x50, 0xa0, 0xe0));
  EXPECT_THAT(ring.colours[12], testing::ElementsAre(0, 0, 0));
}

TEST(WebFrame, OnlyTheFirst512RobotsShowTheirLedsOneByOne)
{
  const Experiment experiment = AThousandFootbots();
  CSwarmanoidSpace space(experiment);
  for (std::uint32_t e = 0; e < 600; ++e) space.GetEntity(e).SetAttribute("led", 0xff0000);
  const std::string bytes = FrameWriter(space).WriteKey();
  ASSERT_EQ(At<FrameHeader>(bytes, 0).rings, 512u);
  EXPECT_EQ(At<FrameRing>(bytes, EndOf(1000) + 511 * sizeof(FrameRing)).entity, 511u);
  EXPECT_EQ(bytes.size(), EndOf(1000) + 512 * sizeof(FrameRing));
}

TEST(WebFrame, ABeamFollowsPanTiltAndTheRobotAndEndsAfterThirtyMetres)
{
  FourEntities world;
  world.space.SetPose(2, {{3, 1, 0}, Quaternion::Identity()});  // the prey is away from all beams
  CSwarmanoidSpaceEntity& eyebot = world.space.GetEntity(1);
  eyebot.SetAttribute("laser", 1);
  FrameWriter writer(world.space);
  const auto end = [&]
  {
    const std::string bytes = writer.WriteKey();
    EXPECT_EQ(At<FrameHeader>(bytes, 0).beams, 1u);
    const auto beam = At<FrameBeam>(bytes, EndOf(3));
    EXPECT_EQ(beam.colour, 0xff0000u);
    return Vector3(beam.x, beam.y, beam.z);
  };
  eyebot.SetAttribute("laser_tilt", std::atan2(0.5, 1.5));
  EXPECT_TRUE(end().isApprox(Vector3(2.5, 2, 0), 1e-5));
  eyebot.SetAttribute("laser_pan", kPi / 2);
  EXPECT_TRUE(end().isApprox(Vector3(2, 2.5, 0), 1e-5));
  world.space.SetPose(1, {{2, 2, 1.5}, QuaternionFromYaw(kPi / 2)});
  EXPECT_TRUE(end().isApprox(Vector3(1.5, 2, 0), 1e-5));
  world.space.SetPose(1, {{2, 2, 1.5}, Quaternion::Identity()});
  eyebot.SetAttribute("laser_tilt", kPi);  // straight up
  EXPECT_TRUE(end().isApprox(Vector3(2, 2, 31.5), 1e-5));
  world.space.SetAttribute(world.space.PresenceSlot(1), 0);
  EXPECT_EQ(At<FrameHeader>(writer.WriteKey(), 0).beams, 0u);
}

TEST(WebFrame, AStepReachesToTheLastTenthOfAMillimetre)
{
  const Experiment experiment = AThousandFootbots();
  CSwarmanoidSpace space(experiment);
  FrameWriter writer(space);
  const Pose start = space.GetPose(0);
  writer.WriteKey();
  const auto poses = [&](const Vector3& move)
  {
    space.SetPose(0, {start.position + move, start.orientation});
    const std::string bytes = writer.WriteChange();
    return bytes.empty() ? ~0U : At<std::uint32_t>(bytes, sizeof(FrameHeader));
  };
  EXPECT_EQ(poses({3.2766, -3.2765, 0}), 0u);
  EXPECT_EQ(poses({-3.2765, 3.2765, 0}), 0u);
  for (const Vector3& far :
       {Vector3(3.2769, 0, 0), Vector3(-3.2769, 0, 0), Vector3(0, 3.2769, 0), Vector3(0, 0, 0.001)})
    EXPECT_EQ(poses(far), 1u) << far.transpose();
}

TEST(WebFrame, KeysAreNumberedAndChangesNameTheirKey)
{
  FourEntities world;
  FrameWriter writer(world.space);
  for (std::uint32_t number = 1; number <= 3; ++number)
  {
    world.space.SetTick(10 * number);
    EXPECT_EQ(At<FrameHeader>(writer.WriteKey(), 0).key, number);
    const auto change = At<FrameHeader>(writer.WriteChange(), 0);
    EXPECT_EQ(change.key, number);
    EXPECT_EQ(change.tick, 10 * number);
    EXPECT_EQ(change.entities, 3u);
  }
}

}  // namespace
}  // namespace swarmanoid
