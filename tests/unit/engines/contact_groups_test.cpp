// Groups of bodies that can touch each other are those that a search from body to body over all pairs finds.
#include "engine_worker/engines/rigid_bodies/contact_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

constexpr double kMargin = 0.01;
constexpr double kBand = 0.005;
constexpr double kPushed = 0.02;
constexpr std::uint32_t kAlone = ContactGroups::kAlone;

struct Scene
{
  std::vector<std::uint8_t> is_pushable;
  std::vector<std::uint32_t> before;
  std::vector<GapPair> pairs;
  std::vector<BodyLink> links;

  explicit Scene(std::size_t bodies) : is_pushable(bodies, 1), before(bodies, kAlone) {}
  ContactGroups Found() const
  {
    ContactGroups groups;
    groups.Find({kMargin, kBand, kPushed, pairs, links, is_pushable, before});
    return groups;
  }
};

std::vector<std::uint32_t> List(std::span<const std::uint32_t> numbers) { return {numbers.begin(), numbers.end()}; }
using Numbers = std::vector<std::uint32_t>;

TEST(ContactGroups, NoBodyAndBodiesThatMeetNothingAreInNoGroup)
{
  EXPECT_EQ(ContactGroups().Count(), 0U);
  EXPECT_EQ(Scene(0).Found().Count(), 0U);
  const ContactGroups two = Scene(2).Found();
  EXPECT_EQ(two.Count(), 0U);
  EXPECT_EQ(two.GroupOf(0), kAlone);
}

TEST(ContactGroups, ABodyNearAWallIsAGroupAndAMirrorNearOneIsNot)
{
  Scene scene(2);
  scene.is_pushable[1] = 0;
  scene.pairs = {{0, 2 + 5, 0.009}, {0, 2 + 3, 0.019}, {0, 2 + 4, 0.021}, {1, 2 + 5, 0}};
  const ContactGroups groups = scene.Found();
  ASSERT_EQ(groups.Count(), 1U);
  EXPECT_EQ(List(groups.Bodies(0)), Numbers{0});
  EXPECT_EQ(List(groups.Fixed(0)), (Numbers{3, 5}));
  EXPECT_EQ(groups.GroupOf(1), kAlone);
}

TEST(ContactGroups, AWallJoinsNoBodies)
{
  Scene scene(2);
  scene.pairs = {{0, 2, 0}, {1, 2, 0}};
  const ContactGroups groups = scene.Found();
  ASSERT_EQ(groups.Count(), 2U);
  EXPECT_EQ(List(groups.Fixed(0)), Numbers{0});
  EXPECT_EQ(List(groups.Fixed(1)), Numbers{0});
}

TEST(ContactGroups, MirrorsJoinTheBodiesThatTheyCanPushAndNoOtherMirror)
{
  Scene scene(4);
  scene.is_pushable[1] = scene.is_pushable[3] = 0;
  scene.pairs = {{0, 1, 0}, {1, 2, 0}, {1, 3, 0}};
  const ContactGroups groups = scene.Found();
  ASSERT_EQ(groups.Count(), 1U);
  EXPECT_EQ(List(groups.Bodies(0)), (Numbers{0, 1, 2}));
  EXPECT_EQ(groups.GroupOf(3), kAlone);
}

TEST(ContactGroups, BodiesThatHoldEachOtherAreTogetherAtAnyDistance)
{
  Scene scene(5);
  scene.links = {{4, 1}, {1, 3}};
  const ContactGroups groups = scene.Found();
  ASSERT_EQ(groups.Count(), 1U);
  EXPECT_EQ(List(groups.Bodies(0)), (Numbers{1, 3, 4}));
}

TEST(ContactGroups, PairsStayTogetherUpToALargerGapThanThatAtWhichTheyJoin)
{
  Scene scene(4);
  scene.pairs = {{0, 1, 0.014}, {2, 3, 0.014}};
  scene.before = {7, 7, kAlone, kAlone};
  const ContactGroups groups = scene.Found();
  ASSERT_EQ(groups.Count(), 1U);
  EXPECT_EQ(List(groups.Bodies(0)), (Numbers{0, 1}));
  scene.before = {7, 8, kAlone, kAlone};
  EXPECT_EQ(scene.Found().Count(), 0U);
}

TEST(ContactGroups, AWallStaysWithABodyThatTheSolverHad)
{
  Scene scene(2);
  scene.pairs = {{0, 2, 0.014}, {1, 2, 0.014}};
  scene.before = {7, kAlone};
  const ContactGroups groups = scene.Found();
  ASSERT_EQ(groups.Count(), 1U);
  EXPECT_EQ(List(groups.Bodies(0)), Numbers{0});
  EXPECT_EQ(List(groups.Fixed(0)), Numbers{0});
}

// Bodies 1 and 2 are pushed by others of their groups, and meet. Body 4 could be pushed to by body 3, and so on to body
// 5. Nothing pushes body 6 or body 7.
TEST(ContactGroups, BodiesThatCanBePushedTogetherAreInOneGroup)
{
  Scene scene(8);
  scene.pairs = {{4, 5, 0.019}, {0, 1, 0}, {2, 3, 0}, {1, 2, 0.035}, {3, 4, 0.019}, {5, 6, 0.021}, {6, 7, 0.011}};
  const ContactGroups groups = scene.Found();
  ASSERT_EQ(groups.Count(), 1U);
  EXPECT_EQ(List(groups.Bodies(0)), (Numbers{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(groups.GroupOf(6), kAlone);
  EXPECT_EQ(groups.GroupOf(7), kAlone);
}

TEST(ContactGroups, AMirrorIsNotPushed)
{
  Scene scene(3);
  scene.is_pushable[1] = 0;
  scene.pairs = {{0, 1, 0}, {1, 2, 0.019}};
  EXPECT_EQ(List(scene.Found().Bodies(0)), (Numbers{0, 1}));
}

TEST(ContactGroups, OneGroupHasEveryBodyAndEveryWall)
{
  ContactGroups groups;
  groups.FindOne(std::vector<std::uint8_t>{0, 1, 0}, 2);
  ASSERT_EQ(groups.Count(), 1U);
  EXPECT_EQ(List(groups.Bodies(0)), (Numbers{0, 1, 2}));
  EXPECT_EQ(List(groups.Fixed(0)), (Numbers{0, 1}));
  groups.FindOne(std::vector<std::uint8_t>{0, 0}, 2);
  EXPECT_EQ(groups.Count(), 0U) << "mirrors alone";
  groups.FindOne({}, 2);
  EXPECT_EQ(groups.Count(), 0U);
}

TEST(ContactGroups, AreWhatASearchFromBodyToBodyFindsInAnyOrderOfPairs)
{
  std::size_t largest = 0;
  int alone = 0;
  for (std::uint32_t trial = 0; trial < 500; ++trial)
  {
    RandomStream random(5, trial, 0, 0);
    const auto bodies = static_cast<std::uint32_t>(random.Uniform(1, 40));
    const auto any = [&](std::uint32_t count) { return static_cast<std::uint32_t>(random.Uniform(0, count)); };
    Scene scene(bodies);
    for (std::uint32_t body = 0; body < bodies; ++body)
    {
      scene.is_pushable[body] = random.Uniform(0, 1) < 0.9 ? 1 : 0;
      scene.before[body] = random.Uniform(0, 1) < 0.5 ? any(4) : kAlone;
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> gaps;
    for (std::uint32_t i = 0; i < bodies; ++i)
    {
      const std::uint32_t a = any(bodies);
      const std::uint32_t b = any(bodies + 3);
      if (a < b) gaps[{a, b}] = random.Uniform(-0.02, 0.05);
    }
    for (const auto& [pair, gap] : gaps) scene.pairs.push_back({pair.first, pair.second, gap});
    const auto is_wall = [&](const GapPair& pair) { return pair.second >= bodies; };
    for (std::uint32_t i = 0; i < bodies / 10; ++i)
      if (const BodyLink link{any(bodies), any(bodies)};
          scene.is_pushable[link.first] != 0 && scene.is_pushable[link.second] != 0 && link.first != link.second)
        scene.links.push_back(link);

    // The definition, repeated until nothing changes: `together` has the pairs of bodies that meet, `grouped` the
    // bodies whose motion the solver decides.
    std::set<std::pair<std::uint32_t, std::uint32_t>> together;
    std::set<std::uint32_t> grouped;
    const auto meet = [&](std::uint32_t a, std::uint32_t b)
    {
      together.insert({a, b});
      grouped.insert({a, b});
    };
    const auto touches = [&](const GapPair& pair)
    {
      const auto before = scene.before[pair.first];
      const bool was = before != kAlone && (is_wall(pair) || before == scene.before[pair.second]);
      return pair.gap < (was ? kMargin + kBand : kMargin);
    };
    const auto pushable = [&](std::uint32_t body) { return scene.is_pushable[body] != 0; };
    for (const BodyLink& link : scene.links) meet(link.first, link.second);
    for (std::size_t size = 1; size != together.size() + grouped.size();)
    {
      size = together.size() + grouped.size();
      for (const GapPair& pair : scene.pairs)
      {
        const auto [a, b, gap] = pair;
        if (is_wall(pair))
        {
          if (touches(pair) && pushable(a)) grouped.insert(a);
          continue;
        }
        const int pushes = int{pushable(a) && grouped.contains(a)} + int{pushable(b) && grouped.contains(b)};
        if ((touches(pair) && (pushable(a) || pushable(b))) || gap < pushes * kPushed - (pushes == 0 ? 1 : 0))
          meet(a, b);
      }
    }
    const auto reached = [&](std::uint32_t start)
    {
      std::set<std::uint32_t> found{start};
      for (std::size_t size = 0; size != found.size();)
      {
        size = found.size();
        for (const auto& [a, b] : together)
        {
          if (found.contains(a)) found.insert(b);
          if (found.contains(b)) found.insert(a);
        }
      }
      return found;
    };

    const ContactGroups groups = scene.Found();
    std::uint32_t last_first = 0;
    for (std::size_t group = 0; group < groups.Count(); ++group)
    {
      const Numbers members = List(groups.Bodies(group));
      const std::set<std::uint32_t> expected = reached(members.front());
      ASSERT_EQ(members, Numbers(expected.begin(), expected.end())) << trial;
      ASSERT_TRUE(group == 0 || members.front() > last_first);
      last_first = members.front();
      std::set<std::uint32_t> walls;
      for (const GapPair& pair : scene.pairs)
        if (is_wall(pair) && pushable(pair.first) && expected.contains(pair.first) &&
            (touches(pair) || pair.gap < kPushed))
          walls.insert(pair.second - bodies);
      ASSERT_EQ(List(groups.Fixed(group)), Numbers(walls.begin(), walls.end())) << trial;
      for (const std::uint32_t body : members) ASSERT_EQ(groups.GroupOf(body), group);
      largest = std::max(largest, members.size());
    }
    for (std::uint32_t body = 0; body < bodies; ++body)
    {
      ASSERT_EQ(groups.GroupOf(body) == kAlone, !grouped.contains(body)) << trial << ", body " << body;
      alone += groups.GroupOf(body) == kAlone ? 1 : 0;
    }

    std::ranges::reverse(scene.pairs);
    std::ranges::reverse(scene.links);
    const ContactGroups again = scene.Found();
    ASSERT_EQ(again.Count(), groups.Count());
    for (std::size_t group = 0; group < groups.Count(); ++group)
    {
      ASSERT_EQ(List(again.Bodies(group)), List(groups.Bodies(group)));
      ASSERT_EQ(List(again.Fixed(group)), List(groups.Fixed(group)));
    }
  }
  EXPECT_GT(largest, 10U);
  EXPECT_GT(alone, 100);
}

}  // namespace
}  // namespace swarmanoid
