// Searches: the values of their ranges, and an algorithm that starts again and continues as if it was never
// interrupted.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "studies/design/design.h"
#include "studies/search/optimiser.h"
#include "studies/search/search.h"
#include "studies/search/search_space.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::DoubleNear;
using testing::HasSubstr;

constexpr const char* kTwo = "<factor id='a' path='p.a' from='0' to='1'/><factor id='b' path='p.b' from='0' to='1'/>";

LoadedStudy LoadSearch(const std::string& factors, const std::string& search)
{
  return LoadStudyText("<study experiment='e.xml' seeds='1-2'>\n" + factors +
                           "\n<metrics><polarisation id='order'/></metrics>\n<search metric='order' " + search +
                           "/>\n</study>",
                       "s.xml", "/x");
}

std::unique_ptr<Study> SearchStudy(const std::string& factors, const std::string& search = "runs='100'")
{
  LoadedStudy loaded = LoadSearch(factors, search);
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  return std::move(loaded.study);
}

std::string Refusals(const std::string& factors, const std::string& search = "runs='100'")
{
  const LoadedStudy loaded = LoadSearch(factors, search);
  std::string all;
  for (const Diagnostic& error : loaded.errors) all += error.Text() + "\n";
  if (!loaded.study) return all;
  return all + test::MessageOf<ConfigurationError>([&] { CheckSearch(*loaded.study); });
}

std::string TextAt(const Study& study, const std::vector<double>& place)
{
  const SearchSpace space(study);
  return space.Text(space.Values(place));
}

TEST(SearchSpace, HasTheEndsAndTheMiddleOfItsRanges)
{
  const auto study = SearchStudy(
      "<factor id='fixed' path='p.f' values='7.5'/><factor id='line' path='p.l q.l' from='-1' to='3'/>"
      "<factor id='ratio' path='p.r' from='0.01' to='100' scale='logarithmic'/>"
      "<factor id='whole' path='p.w' from='1' to='4' step='1'/>");
  EXPECT_EQ(TextAt(*study, {0, 0, 0}), "fixed=7.5 line=-1 ratio=0.01 whole=1");
  EXPECT_EQ(TextAt(*study, {0.5, 0.5, 0.6}), "fixed=7.5 line=1 ratio=1 whole=3");
  EXPECT_EQ(TextAt(*study, {1, 1, 1}), "fixed=7.5 line=3 ratio=100 whole=4");
  const SearchSpace space(*study);
  EXPECT_EQ(space.Settings(space.Values(std::vector{0.75, 0.25, 0.1})),
            (StudySettings{{"p.f", "7.5"}, {"p.l", "2"}, {"q.l", "2"}, {"p.r", "0.1"}, {"p.w", "1"}}));
}

TEST(SearchSpace, WholeNumbersHaveEqualShares)
{
  const auto study = SearchStudy("<factor id='n' path='p.n' from='2' to='6' step='2'/>");
  std::map<std::string, int> counts;
  for (int i = 0; i < 300; ++i) ++counts[TextAt(*study, {(i + 0.5) / 300})];
  EXPECT_EQ(counts, (std::map<std::string, int>{{"n=2", 100}, {"n=4", 100}, {"n=6", 100}}));
}

TEST(SearchSpace, BeginsWhereItIsTold)
{
  const auto study = SearchStudy(
      "<factor id='line' path='p.l' from='-1' to='3' start='0'/>"
      "<factor id='ratio' path='p.r' from='0.01' to='100' scale='logarithmic' start='10'/>"
      "<factor id='whole' path='p.w' from='1' to='4' step='1' start='4'/><factor id='middle' path='p.m' from='0' "
      "to='1'/>");
  EXPECT_EQ(TextAt(*study, SearchSpace(*study).Start()), "line=0 ratio=10 whole=4 middle=0.5");
}

TEST(SearchSpace, ValuesAreWhatTheirTextsSay)
{
  const auto study = SearchStudy("<factor id='n' path='p.n' from='0.001' to='7' scale='logarithmic'/>");
  const SearchSpace space(*study);
  for (int i = 0; i <= 1000; ++i)
  {
    const auto values = space.Values(std::vector{i / 1000.0});
    EXPECT_EQ(std::get<double>(values[0]), std::stod(space.Settings(values)[0].second));
  }
}

// A search over a function of two numbers, as RunSearch does it.
struct Searched
{
  std::vector<std::vector<double>> asked;  // in this order
  std::vector<std::size_t> generations;    // sizes of what was asked for together
  std::size_t unused = 0;                  // number of requested values that were never requested again
};

using Function = std::function<KnownValue(std::span<const double>)>;

// Stops as if it was killed, after `most` of the answers in `answers`.
Searched RunOptimiser(const SearchChoice& search, const Function& function, std::size_t most,
                      std::map<std::vector<double>, KnownValue>& answers)
{
  Searched searched;
  const Optimiser optimiser(search, {0.5, 0.5}, 100'000);
  std::set<std::vector<double>> waiting;
  while (true)
  {
    const auto wanted = optimiser.Next(
        [&](std::span<const double> place)
        {
          const std::vector<double> key(place.begin(), place.end());
          waiting.erase(key);
          const auto found = answers.find(key);
          if (found != answers.end()) return found->second;
          const KnownValue value = function(place);
          return value.kind == KnownValue::Kind::kRefused ? value : KnownValue{};
        });
    searched.unused += waiting.size();
    waiting.clear();
    if (wanted.empty()) return searched;
    searched.generations.push_back(wanted.size());
    for (const std::vector<double>& place : wanted)
    {
      if (answers.size() >= most) return searched;
      answers[place] = function(place);
      searched.asked.push_back(place);
      waiting.insert(place);
    }
  }
}

SearchChoice Choice(const std::string& algorithm)
{
  return *SearchStudy(kTwo, "runs='100' algorithm='" + algorithm + "'")->search;
}

KnownValue Bowl(std::span<const double> place)
{
  const double x = place[0] - 0.3, y = place[1] - 0.8;
  return {KnownValue::Kind::kValue, 5 + x * x + 3 * y * y + x * y};
}

std::vector<double> BestOf(const std::map<std::vector<double>, KnownValue>& answers)
{
  return std::min_element(answers.begin(), answers.end(),
                          [](const auto& a, const auto& b) { return a.second.value < b.second.value; })
      ->first;
}

TEST(Optimiser, EachAlgorithmFindsTheBottomOfABowl)
{
  for (const std::string algorithm : kSearchAlgorithms)
  {
    std::map<std::vector<double>, KnownValue> answers;
    const Searched searched = RunOptimiser(Choice(algorithm), Bowl, 900, answers);
    EXPECT_EQ(searched.unused, 0) << algorithm;
    EXPECT_EQ(searched.asked.front(), (std::vector{0.5, 0.5})) << algorithm;
    EXPECT_THAT(BestOf(answers), testing::ElementsAre(DoubleNear(0.3, 0.03), DoubleNear(0.8, 0.03))) << algorithm;
  }
}

TEST(Optimiser, OneThatWasKilledAsksWhatItWouldHaveAsked)
{
  for (const std::string algorithm : kSearchAlgorithms)
  {
    std::map<std::vector<double>, KnownValue> undisturbed, killed;
    const Searched whole = RunOptimiser(Choice(algorithm), Bowl, 150, undisturbed);
    std::vector<std::vector<double>> asked;
    for (const std::size_t end : {1U, 2U, 37U, 90U, 150U})
      for (const auto& place : RunOptimiser(Choice(algorithm), Bowl, end, killed).asked) asked.push_back(place);
    EXPECT_EQ(asked, whole.asked) << algorithm;
  }
}

TEST(Optimiser, AsksForWholeGenerationsAtOnce)
{
  std::map<std::vector<double>, KnownValue> answers;
  const Searched isres = RunOptimiser(Choice("isres"), Bowl, 180, answers);
  // The start is one of the first generation.
  EXPECT_EQ(isres.generations, (std::vector<std::size_t>{1, 59, 60, 60, 60}));
  answers.clear();
  const Searched crs = RunOptimiser(Choice("crs"), Bowl, 40, answers);
  EXPECT_EQ(crs.generations[1], 29);
  EXPECT_EQ(crs.generations[2], 1);
}

TEST(Optimiser, StaysWhereConditionsAllowIt)
{
  const auto corner = [](std::span<const double> place) -> KnownValue
  {
    if (place[0] + place[1] > 1.2) return {KnownValue::Kind::kRefused};
    return {KnownValue::Kind::kValue, std::hypot(place[0] - 1, place[1] - 1)};
  };
  for (const char* algorithm : {"crs", "isres", "sbplx", "nelder_mead"})
  {
    std::map<std::vector<double>, KnownValue> answers;
    RunOptimiser(Choice(algorithm), corner, 600, answers);
    for (const auto& [place, answer] : answers) EXPECT_EQ(answer.kind, KnownValue::Kind::kValue);
    // The nearest allowed place is (0.6, 0.6); on the border the value grows slowly from there.
    EXPECT_LT(answers[BestOf(answers)].value, 1.05 * std::hypot(0.4, 0.4)) << algorithm;
  }
}

TEST(SearchFile, MistakesAreToldWithTheirPlace)
{
  EXPECT_THAT(Refusals("<factor id='a' path='p.a' values='1'/>"), HasSubstr("s.xml:4:1: <search> has no <factor>"));
  EXPECT_THAT(Refusals("<factor id='a' path='p.a' values='1 2'/>"), HasSubstr("s.xml:2:1: a search goes through"));
  EXPECT_THAT(Refusals("<factor id='a' path='p.a' from='2' to='1'/>"), HasSubstr("s.xml:2:36: the range from 2 to 1"));
  EXPECT_THAT(Refusals("<factor id='a' path='p.a' from='0' to='1' count='3'/>"), HasSubstr("it has no count"));
  EXPECT_THAT(Refusals("<factor id='a' path='p.a' from='0' to='1' scale='logarithmic'/>"), HasSubstr("begins above 0"));
  EXPECT_THAT(Refusals("<factor id='a' path='p.a' from='0' to='1' start='3'/>"), HasSubstr("'start' 3 is not in"));
  EXPECT_THAT(Refusals(std::string("<zip>") + kTwo + "</zip>"), HasSubstr("a search has no <zip>"));
  EXPECT_THAT(Refusals(kTwo, "runs='1'"), HasSubstr("1 runs are less than one point takes, which has 2 seeds"));
  EXPECT_THAT(Refusals(kTwo, "runs='9' aggregate='meen'"), HasSubstr("did you mean 'mean'?"));
  EXPECT_THAT(Refusals(kTwo, "runs='9' algorithm='sbplx' population='9'"), HasSubstr("sbplx has no population"));
  EXPECT_THAT(Refusals(kTwo, "runs='9' population='2'"), HasSubstr("take 3 or more"));
  EXPECT_THAT(Refusals(std::string(kTwo) + "<require condition='a &gt; 0.9'/>"),
              HasSubstr("the search begins at a=0.5 b=0.5, which the conditions do not allow"));
  LoadedStudy other = LoadStudyText(
      "<study experiment='e.xml'><factor id='a' path='p.a' from='0' to='1'/><metrics><polarisation id='order'/>"
      "</metrics><search metric='ordre' runs='5'/></study>",
      "s.xml", "/x");
  EXPECT_THAT(other.errors.at(0).Text(), HasSubstr("make no column 'ordre'; they make: order; did you mean 'order'?"));
}

}  // namespace
}  // namespace swarmanoid
