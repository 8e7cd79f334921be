// Tests the API of ARGoS3: its mathematics beside Eigen's, its texts and elements, its random numbers.
#include <argos3/core/simulator/entity/embodied_entity.h>
#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/core/utility/configuration/argos_configuration.h>
#include <argos3/core/utility/datatypes/byte_array.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/math/quaternion.h>
#include <argos3/core/utility/math/ray3.h>
#include <argos3/core/utility/math/rng.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_ground_sensor.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <sstream>
#include <utility>

#include "argos3/library/running.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/math/elementary.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace
{

using namespace argos;
namespace test = swarmanoid::test;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kTolerance = 1e-12;

TEST(Argos3Api, NamedAnglesArePartsOfPi)
{
  const std::pair<CRadians, double> angles[] = {{CRadians::PI, 1},           {CRadians::TWO_PI, 0.5},
                                                {CRadians::PI_OVER_TWO, 2},  {CRadians::PI_OVER_THREE, 3},
                                                {CRadians::PI_OVER_FOUR, 4}, {CRadians::PI_OVER_SIX, 6}};
  for (const auto& [angle, parts] : angles) EXPECT_DOUBLE_EQ(angle.GetValue() * parts, std::acos(-1.0));
}

TEST(Argos3Api, QuaternionsTurnVectorsAsEigens)
{
  CRandom::CRNG random(1);
  const CRange<Real> component(-2, 2);
  for (int i = 0; i < 200; ++i)
  {
    const CRadians angle(random.Uniform(component));
    CVector3 axis(random.Uniform(component), random.Uniform(component), random.Uniform(component));
    axis.Normalize();
    CVector3 turned(random.Uniform(component), random.Uniform(component), random.Uniform(component));
    const Vector3d expected = AngleAxisd(angle.GetValue(), Vector3d(axis.GetX(), axis.GetY(), axis.GetZ())) *
                              Vector3d(turned.GetX(), turned.GetY(), turned.GetZ());
    turned.Rotate(CQuaternion(angle, axis));
    EXPECT_NEAR(turned.GetX(), expected.x(), kTolerance);
    EXPECT_NEAR(turned.GetY(), expected.y(), kTolerance);
    EXPECT_NEAR(turned.GetZ(), expected.z(), kTolerance);
  }
}

TEST(Argos3Api, EulerAnglesAreXThenYThenZOfTheTurnedFrame)
{
  CRandom::CRNG random(2);
  const CRange<Real> half(-1.4, 1.4);
  for (int i = 0; i < 200; ++i)
  {
    const CRadians z(random.Uniform(half)), y(random.Uniform(half)), x(random.Uniform(half));
    CQuaternion turned;
    turned.FromEulerAngles(z, y, x);
    const Quaterniond expected = AngleAxisd(x.GetValue(), Vector3d::UnitX()) *
                                 AngleAxisd(y.GetValue(), Vector3d::UnitY()) *
                                 AngleAxisd(z.GetValue(), Vector3d::UnitZ());
    EXPECT_NEAR(turned.GetW(), expected.w(), kTolerance);
    EXPECT_NEAR(turned.GetX(), expected.x(), kTolerance);
    EXPECT_NEAR(turned.GetY(), expected.y(), kTolerance);
    EXPECT_NEAR(turned.GetZ(), expected.z(), kTolerance);
    CRadians z_again, y_again, x_again;
    turned.ToEulerAngles(z_again, y_again, x_again);
    EXPECT_NEAR(z_again.GetValue(), z.GetValue(), 1e-9);
    EXPECT_NEAR(y_again.GetValue(), y.GetValue(), 1e-9);
    EXPECT_NEAR(x_again.GetValue(), x.GetValue(), 1e-9);
  }
}

TEST(Argos3Api, TheRotationBetweenTwoVectorsTakesOneToTheOther)
{
  CRandom::CRNG random(3);
  const CRange<Real> component(-2, 2);
  for (int i = 0; i < 100; ++i)
  {
    const CVector3 from(random.Uniform(component), random.Uniform(component), random.Uniform(component));
    const CVector3 to = i == 0 ? -from : CVector3(random.Uniform(component), random.Uniform(component), 1);
    CVector3 turned = from;
    turned.Rotate(CQuaternion(from, to)).Normalize();
    EXPECT_LT(Distance(turned, CVector3(to).Normalize()), 1e-9);
  }
}

TEST(Argos3Api, VectorsHaveElements)
{
  CVector3 vector(1, 2, 3);
  vector[0] = 4;
  EXPECT_EQ(vector, CVector3(4, 2, 3));
  const CVector3& same = vector;
  EXPECT_EQ(same[1] + same[2], 5);
  EXPECT_THROW(static_cast<void>(same[3]), CARGoSException);
  CRange<CVector3> box;
  box.Set(CVector3(-1, -1, 0), CVector3(1, 1, 0));
  EXPECT_TRUE(box.WithinMinBoundIncludedMaxBoundIncluded(CVector3(0, 1, 0)));
  EXPECT_FALSE(box.WithinMinBoundIncludedMaxBoundIncluded(CVector3(0, 2, 0)));
  // Vectors are equal if all of their elements are.
  EXPECT_TRUE(CVector2(1, 2) == CVector2(1, 2));
  for (const CVector2& other : {CVector2(1, 3), CVector2(3, 2)}) EXPECT_TRUE(CVector2(1, 2) != other) << other;
  for (const CVector3& other : {CVector3(1, 2, 4), CVector3(1, 4, 3), CVector3(4, 2, 3)})
    EXPECT_TRUE(CVector3(1, 2, 3) != other) << other;
}

TEST(Argos3Api, PolarVectorsAreTheProductsOfTheirLengthToTheLastBit)
{
  // The angles of rings of sensors, others, and the ends of the quarters of a turn.
  std::vector<Real> angles{0, -0.0, 1e-300, 4, -4, 1e4, std::numeric_limits<Real>::quiet_NaN()};
  for (unsigned sensor = 0; sensor < swarmanoid::CCI_FootBotProximitySensor::NUM_SENSORS; ++sensor)
    angles.push_back(CRadians(swarmanoid::CCI_FootBotProximitySensor::AngleOf(sensor)).SignedNormalize().GetValue());
  for (const Real end : {ARGOS_PI / 2, ARGOS_PI})
    for (const Real sign : {1, -1})
      for (const Real to : {0.0, 5.0}) angles.insert(angles.end(), {sign * end, sign * std::nextafter(end, to)});
  CRandom::CRNG random(3);
  for (int i = 0; i < 500; ++i) angles.push_back(random.Uniform(CRange<Real>(-ARGOS_PI, ARGOS_PI)));
  const auto bits = [](Real number) { return std::bit_cast<UInt64>(number); };
  for (const Real angle : angles)
  {
    const swarmanoid::SinCos both = swarmanoid::SinCosOf(angle);
    for (const Real length : {0.0, -0.0, 0.7, -2.0, std::numeric_limits<Real>::infinity()})
    {
      const CVector2 vector(length, CRadians(angle));
      const Real x = both.cos * length, y = both.sin * length;
      EXPECT_TRUE(bits(vector.GetX()) == bits(x) || (std::isnan(vector.GetX()) && std::isnan(x))) << angle;
      EXPECT_TRUE(bits(vector.GetY()) == bits(y) || (std::isnan(vector.GetY()) && std::isnan(y))) << angle;
    }
  }
}

TEST(Argos3Api, AnglesWrapIntoTheirRanges)
{
  for (double degrees = -1000; degrees <= 1000; degrees += 7)
  {
    CRadians signed_angle = ToRadians(CDegrees(degrees));
    signed_angle.SignedNormalize();
    EXPECT_LE(std::abs(signed_angle.GetValue()), std::numbers::pi + 1e-9);
    EXPECT_NEAR(std::sin(signed_angle.GetValue()), std::sin(degrees * std::numbers::pi / 180), 1e-9);
    CDegrees unsigned_angle(degrees);
    unsigned_angle.UnsignedNormalize();
    EXPECT_GE(unsigned_angle.GetValue(), 0);
    EXPECT_LE(unsigned_angle.GetValue(), 360);
  }
  EXPECT_NEAR(NormalizedDifference(CRadians(3), CRadians(-3)).GetValue(), 6 - 2 * std::numbers::pi, kTolerance);
  CRadians endless(1e300);
  EXPECT_EQ(endless.SignedNormalize().GetValue(), 1e300) << "a number that no turn changes ends the wrapping";
}

TEST(Argos3Api, RandomNumbersHaveTheirMomentsAndRepeat)
{
  CRandom::CRNG random(5);
  constexpr int kDraws = 20000;
  double sum = 0, squares = 0, waits = 0, lengths = 0;
  int counts[3] = {};
  for (int i = 0; i < kDraws; ++i)
  {
    const double normal = random.Gaussian(2, 1);
    sum += normal;
    squares += (normal - 1) * (normal - 1);
    waits += random.Exponential(3);
    lengths += random.Rayleigh(2);
    ++counts[random.Uniform(CRange<SInt32>(-1, 2)) + 1];
  }
  // The limit is four standard errors.
  EXPECT_NEAR(sum / kDraws, 1, 4 * 2 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 4, 4 * 4 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(waits / kDraws, 3, 4 * 3 / std::sqrt(kDraws));
  EXPECT_NEAR(lengths / kDraws, 2 * std::sqrt(std::numbers::pi / 2), 4 * 1.31 / std::sqrt(kDraws));
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 3.0, 4 * std::sqrt(kDraws * 2 / 9.0));

  const Real next = random.Uniform(CRange<Real>(0, 1));
  random.Reset();
  CRandom::CRNG twin(5);
  EXPECT_EQ(random.Gaussian(2, 1), twin.Gaussian(2, 1));
  EXPECT_NE(random.Uniform(CRange<Real>(0, 1)), next);
  EXPECT_THROW(CRandom::CreateRNG("argos"), CARGoSException) << "no controller runs whose numbers they would be";
  EXPECT_THROW(CRandom::CreateRNG("mine"), CARGoSException);
  // Draws numbers as a program with this seed does.
  const auto drawn = [](UInt32 seed)
  {
    CRandom::CreateCategory("mine", seed);
    const Real first = CRandom::CreateRNG("mine")->Gaussian(1);
    const Real second = CRandom::CreateRNG("mine")->Gaussian(1);
    CRandom::RemoveCategory("mine");
    return std::pair(first, second);
  };
  EXPECT_EQ(drawn(7), drawn(7));
  EXPECT_NE(drawn(7), drawn(8));
  EXPECT_NE(drawn(7).first, drawn(7).second);
}

TEST(Argos3Api, PoissonNumbersHaveTheirMomentsAndShufflesKeepAllValues)
{
  CRandom::CRNG random(6);
  constexpr int kDraws = 20000;
  for (const double mean : {0.5, 4.0, 200.0})
  {
    double sum = 0, squares = 0;
    for (int i = 0; i < kDraws; ++i)
    {
      const double count = random.Poisson(mean);
      sum += count;
      squares += (count - mean) * (count - mean);
    }
    EXPECT_NEAR(sum / kDraws, mean, 4 * std::sqrt(mean / kDraws));
    EXPECT_NEAR(squares / kDraws, mean, 4 * std::sqrt((2 * mean * mean + mean) / kDraws));
  }
  EXPECT_EQ(random.Poisson(0), 0U);
  EXPECT_THROW(random.Poisson(-1), CARGoSException);

  std::array<int, 3> first{};
  for (int i = 0; i < kDraws; ++i)
  {
    std::vector<int> order{0, 1, 2};
    random.Shuffle(order);
    ++first[static_cast<std::size_t>(order.front())];
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order, (std::vector<int>{0, 1, 2}));
  }
  for (const int count : first) EXPECT_NEAR(count, kDraws / 3.0, 4 * std::sqrt(kDraws * 2 / 9.0));
  std::vector<int> none;
  random.Shuffle(none);
  EXPECT_TRUE(none.empty());
}

TEST(Argos3Api, PartsOfByteArraysAreCopies)
{
  const UInt8 bytes[]{1, 2, 3, 4};
  CByteArray whole(bytes, 4);
  const auto part = [&](size_t from, ssize_t to) { return *std::unique_ptr<CByteArray>(whole(from, to)); };
  EXPECT_EQ(part(0, 4), whole);
  EXPECT_EQ(part(1, 3), CByteArray(bytes + 1, 2));
  EXPECT_EQ(part(2, -1), CByteArray(bytes + 2, 2));
  EXPECT_EQ(part(2, 99), CByteArray(bytes + 2, 2));
  EXPECT_TRUE(part(2, 2).Empty());
  EXPECT_THROW(part(4, -1), CARGoSException);
}

TEST(Argos3Api, DocumentsAreReadChangedAndWritten)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.Path() + "/a.argos";
  std::ofstream(file) << "<argos-configuration><framework><experiment length=5 name='a &amp; &lt;b&gt;'/></framework>"
                         "</argos-configuration>";
  ticpp::Document document(file);
  document.LoadFile();
  // Copies of an element share it, as in ARGoS3.
  TConfigurationNode root = *document.FirstChildElement();
  TConfigurationNode& framework = GetNode(root, "framework");
  SetNodeAttribute(GetNode(framework, "experiment"), "length", 7);
  TConfigurationNode added("system");
  framework.InsertEndChild(added);
  added.SetAttribute("threads", 2);
  EXPECT_FALSE(NodeAttributeExists(GetNode(framework, "system"), "threads")) << "what is inserted is a copy";
  document.SaveFile(folder.Path() + "/b.argos");
  ticpp::Document again;
  again.LoadFile(folder.Path() + "/b.argos");
  TConfigurationNode& experiment = GetNode(GetNode(*again.FirstChildElement(), "framework"), "experiment");
  EXPECT_EQ(experiment.GetAttribute("length"), "7");
  EXPECT_EQ(experiment.GetAttribute("name"), "a & <b>");
  EXPECT_EQ(experiment.NextSiblingElement()->Value(), "system");
  EXPECT_EQ(experiment.NextSiblingElement("none", false), nullptr);
  framework.RemoveChild(framework.FirstChildElement("experiment"));
  EXPECT_EQ(GetNode(*document.FirstChildElement(), "framework").FirstChildElement()->Value(), "system");
  EXPECT_EQ(GetNode(*document.FirstChildElement(), "framework").FirstChild()->ToElement()->Value(), "system");
  EXPECT_EQ(document.FirstChild()->FirstChild("framework")->FirstChild("system")->NextSibling(false), nullptr);
  EXPECT_THROW(again.LoadFile(folder.Path() + "/none.argos"), ticpp::Exception);
  EXPECT_THROW(again.Parse("<a>"), ticpp::Exception);
  // An element outlives its document.
  TConfigurationNode kept;
  {
    ticpp::Document brief;
    brief.Parse("<a><b x='1'/><c/></a>");
    kept = *brief.FirstChildElement()->FirstChildElement("b");
  }
  EXPECT_EQ(kept.GetAttribute("x"), "1");
  EXPECT_EQ(kept.NextSiblingElement(false), nullptr);
}

TEST(Argos3Api, ByteArraysUnpackWhatWasPackedInNetworkOrder)
{
  CByteArray bytes;
  bytes << UInt32{0x01020304} << -2.5 << std::string("robot") << SInt8{-7};
  EXPECT_EQ(bytes.Size(), 4U + 8U + 6U + 1U);
  EXPECT_EQ(bytes[0], 1);
  EXPECT_EQ(bytes[3], 4);
  UInt32 whole = 0;
  double number = 0;
  std::string text;
  SInt8 small = 0;
  bytes >> whole >> number >> text >> small;
  EXPECT_EQ(whole, 0x01020304U);
  EXPECT_EQ(number, -2.5);
  EXPECT_EQ(text, "robot");
  EXPECT_EQ(small, -7);
  EXPECT_TRUE(bytes.Empty());
  EXPECT_THROW(bytes >> small, CARGoSException);
  EXPECT_THROW(CByteArray(3)[3], CARGoSException);
}

TEST(Argos3Api, ElementsGiveTypedAttributesAndNameTheirPlace)
{
  TConfigurationNode params("params");
  params.SetPlace("file.argos:3:5");
  params.SetAttribute("range", "-5:5");
  params.SetAttribute("place", "1.5,-2,3");
  params.SetAttribute("flag", "true");
  params.SetAttribute("byte", "65");
  params.SetAttribute("colour", "gray50");
  params.SetAttribute("word", "three");
  CRange<CDegrees> range(CDegrees(0), CDegrees(1));
  GetNodeAttribute(params, "range", range);
  EXPECT_EQ(range.GetMin(), CDegrees(-5));
  CVector3 place;
  GetNodeAttribute(params, "place", place);
  EXPECT_EQ(place, CVector3(1.5, -2, 3));
  bool flag = false;
  GetNodeAttribute(params, "flag", flag);
  EXPECT_TRUE(flag);
  UInt8 byte = 0;
  GetNodeAttribute(params, "byte", byte);
  EXPECT_EQ(byte, 65);
  CColor colour;
  GetNodeAttribute(params, "colour", colour);
  EXPECT_EQ(colour, CColor::GRAY50);
  Real number = 0;
  GetNodeAttributeOrDefault(params, "none", number, 4.5);
  EXPECT_EQ(number, 4.5);
  EXPECT_EQ(swarmanoid::test::MessageOf<CARGoSException>([&] { GetNodeAttribute(params, "word", number); }),
            "file.argos:3:5: 'word' of <params>: 'three' is not of the type that is asked for");

  for (const char* name : {"a", "b", "a"}) params.InsertEndChild(TConfigurationNode(name));
  int all = 0, some = 0;
  TConfigurationNodeIterator it;
  for (it = it.begin(&params); it != it.end(); ++it) ++all;
  TConfigurationNodeIterator named("a");
  for (named = named.begin(&params); named != named.end(); ++named) ++some;
  EXPECT_EQ(all, 3);
  EXPECT_EQ(some, 2);
  EXPECT_TRUE(NodeExists(params, "b"));
  EXPECT_THROW(GetNode(params, "c"), CARGoSException);
}

TEST(Argos3Api, TextsAreCutReplacedAndExpanded)
{
  std::vector<std::string> words;
  Tokenize(" one  two,three", words, " ,");
  EXPECT_EQ(words, (std::vector<std::string>{"one", "two", "three"}));
  std::string text = "a_b_c";
  Replace(text, "_", "__");
  EXPECT_EQ(text, "a__b__c");
  EXPECT_TRUE(MatchPattern("fb12", "^fb[0-9]+$"));
  EXPECT_FALSE(MatchPattern("eb12", "^fb[0-9]+$"));
  setenv("ARGOS3_TEST_FOLDER", "/tmp/x", 1);
  text = "$ARGOS3_TEST_FOLDER/lib$NOBODY_SET_THIS.so";
  EXPECT_EQ(ExpandEnvVariables(text), "/tmp/x/lib$NOBODY_SET_THIS.so");
  // A stream that was read to its end can be written and read again.
  std::stringstream stream("1,2");
  Real values[2];
  ParseValues<Real>(stream, 2, values, ',');
  EXPECT_EQ(values[0] * 10 + values[1], 12);
  EXPECT_TRUE(stream.good());
}

TEST(Argos3Api, IdsOfDistributedEntitiesTranslateBothWays)
{
  swarmanoid::argos3::Translation translation;
  translation.distributed = {{"fb", 10, "fb"}, {"fb", 20, "fb.20"}, {"f", 0, "f"}, {"", 1, "footbot"}};
  EXPECT_EQ(translation.Argos3Id("fb_3"), "fb13");
  EXPECT_EQ(translation.OurId("fb13"), "fb_3");
  EXPECT_EQ(translation.OurId("fb19"), "fb_9");
  EXPECT_EQ(translation.OurId("fb20"), "fb.20_0");
  EXPECT_EQ(translation.Argos3Id("fb.20_4"), "fb24");
  EXPECT_EQ(translation.OurId("fb9"), "fb9");
  EXPECT_EQ(translation.OurId("f0"), "f_0");
  EXPECT_EQ(translation.OurId("7"), "footbot_6");
  EXPECT_EQ(translation.Argos3Id("footbot_6"), "7");
  EXPECT_EQ(translation.Argos3Id("fb_one"), "fb_one");
  EXPECT_EQ(translation.OurId("wall_1"), "wall_1");
}

TEST(Argos3Api, BoxesMeetIfTheyOverlapInEachDirection)
{
  const SBoundingBox box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_TRUE(box.Intersects({{0.9, 1.9, 2.9}, {5, 5, 5}}));
  EXPECT_TRUE(box.Intersects({{-5, -5, -5}, {0.1, 0.1, 0.1}}));
  EXPECT_TRUE(box.Intersects({{0.2, 0.2, 0.2}, {0.3, 0.3, 0.3}})) << "one within the other";
  for (const auto& apart : {CVector3(1.1, 0, 0), CVector3(0, 2.1, 0), CVector3(0, 0, 3.1)})
    for (const Real side : {1., -1.})
    {
      const SBoundingBox other{box.MinCorner + side * apart, box.MaxCorner + side * apart};
      EXPECT_FALSE(box.Intersects(other)) << apart << side;
      EXPECT_FALSE(other.Intersects(box)) << apart << side;
    }
}

TEST(Argos3Api, DistancesAlongARayArePartsOfItsLength)
{
  const CRay3 ray(CVector3(1, 1, 1), CVector3(1, 5, 1));
  EXPECT_EQ(ray.GetLength(), 4);
  EXPECT_EQ(ray.GetDistance(0), 0);
  EXPECT_EQ(ray.GetDistance(0.25), 1);
  EXPECT_EQ(ray.GetDistance(-0.5), 2);
}

TEST(Argos3Api, TheRateOfEnginesIsTheInverseOfTheirTick)
{
  const Real before = CPhysicsEngine::GetSimulationClockTick();
  CPhysicsEngine::SetSimulationClockTick(0.25);
  EXPECT_EQ(CPhysicsEngine::GetInverseSimulationClockTick(), 4);
  CPhysicsEngine::SetSimulationClockTick(before);
}

TEST(Argos3Api, CategoriesOfRandomNumbersExistUntilTheyAreRemoved)
{
  EXPECT_FALSE(CRandom::ExistsCategory("of this test"));
  EXPECT_TRUE(CRandom::CreateCategory("of this test", 3));
  EXPECT_TRUE(CRandom::ExistsCategory("of this test"));
  EXPECT_FALSE(CRandom::ExistsCategory("of another test"));
  CRandom::RemoveCategory("of this test");
  EXPECT_FALSE(CRandom::ExistsCategory("of this test"));
}

TEST(Argos3Api, GroundSensorsOfAnEPuckAreNumberedFromTheLeft)
{
  CCI_EPuckGroundSensor::SReadings readings;
  readings.Left = 0.25;
  readings.Center = 0.5;
  readings.Right = 0.75;
  for (std::size_t sensor = 0; sensor < 3; ++sensor)
    EXPECT_EQ(std::as_const(readings)[sensor], 0.25 * static_cast<Real>(sensor + 1));
  EXPECT_THROW(readings[3], CARGoSException);
}

}  // namespace
