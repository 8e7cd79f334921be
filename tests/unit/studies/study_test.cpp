// Study files: their content, the refused ones, and the runs that they make.
#include "studies/design/study.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "launcher/system/scratch_folder.h"
#include "studies/design/conflicts.h"
#include "studies/design/design.h"
#include "test_folders.h"
#include "tests/world/experiment_text.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

std::unique_ptr<Study> Read(const std::string& inside, const std::string& attributes = "")
{
  LoadedStudy loaded =
      LoadStudyText("<study experiment='e.xml' " + attributes + ">\n" + inside + "</study>", "s.xml", "/x");
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  return std::move(loaded.study);
}

std::string Complaints(const std::string& inside, const std::string& attributes = "")
{
  const LoadedStudy loaded =
      LoadStudyText("<study experiment='e.xml' " + attributes + ">\n" + inside + "</study>", "s.xml", "/x");
  std::string all;
  for (const Diagnostic& error : loaded.errors) all += error.Text() + "\n";
  if (!loaded.study) return all;
  return all + test::MessageOf<ConfigurationError>([&] { const Design design(*loaded.study); });
}

std::vector<std::string> Points(const Study& study)
{
  const Design design(study);
  std::vector<std::string> texts;
  for (std::size_t p = 0; p < design.Points(); ++p) texts.push_back(design.Text(p));
  return texts;
}

std::vector<std::string> ValuesOf(const std::string& attributes)
{
  const auto study = Read("<factor id='f' path='a.b' " + attributes + "/>");
  std::vector<std::string> values;
  for (const FactorLevel& level : study->dimensions.at(0).factors.at(0).levels) values.push_back(level.value);
  return values;
}

TEST(StudyFile, HasAllCombinationsTheLastFactorFastest)
{
  const auto study = Read(
      "<factor id='robots' path='arena.distribute.quantity' values='5, 10'/>"
      "<factor id='speed' path='a.b  c.d' values='0.1 0.2'/>",
      "seeds='1-3, 9' ticks='50'");
  EXPECT_THAT(Points(*study),
              ElementsAre("robots=5 speed=0.1", "robots=5 speed=0.2", "robots=10 speed=0.1", "robots=10 speed=0.2"));
  EXPECT_THAT(study->seeds, ElementsAre(1, 2, 3, 9));
  const Design design(*study);
  EXPECT_EQ(design.SettingsOf(2),
            (StudySettings{
                {"arena.distribute.quantity", "10"}, {"a.b", "0.1"}, {"c.d", "0.1"}, {"framework.maxclock", "50"}}));
}

TEST(StudyFile, ZipsAndVariantsVaryTogether)
{
  const auto study = Read(
      "<set path='p' value='1'/><zip><factor id='n' path='q' values='1 2'/><variants id='engine'>"
      "<variant id='flat'/><variant id='full' experiment='sub/d.xml'><set path='r' value='x "
      "y'/></variant></variants></zip>");
  EXPECT_THAT(Points(*study), ElementsAre("n=1 engine=flat", "n=2 engine=full"));
  const Design design(*study);
  EXPECT_EQ(design.ExperimentOf(0), "/x/e.xml");
  EXPECT_EQ(design.ExperimentOf(1), "/x/sub/d.xml");
  EXPECT_EQ(design.SettingsOf(1), (StudySettings{{"p", "1"}, {"q", "2"}, {"r", "x y"}}));
}

TEST(StudyFile, RangesMeetTheirEnds)
{
  EXPECT_THAT(ValuesOf("from='0' to='0.3' step='0.1'"), ElementsAre("0", "0.1", "0.2", "0.3"));
  EXPECT_THAT(ValuesOf("from='0' to='0.35' step='0.1'"), ElementsAre("0", "0.1", "0.2", "0.3"));
  EXPECT_THAT(ValuesOf("from='1' to='2' count='5'"), ElementsAre("1", "1.25", "1.5", "1.75", "2"));
  EXPECT_THAT(ValuesOf("from='1' to='1000' count='4' scale='logarithmic'"), ElementsAre("1", "10", "100", "1000"));
  EXPECT_THAT(ValuesOf("values='1,2,0; 3,4,0'"), ElementsAre("1,2,0", "3,4,0"));
}

TEST(StudyFile, ConditionsLeaveOutPoints)
{
  const auto study = Read(
      "<factor id='a' path='p' values='1 2 3'/><factor id='b' path='q' values='1 2 3'/>"
      "<require condition='a * b &lt; 4'/><require condition='a != b'/>");
  EXPECT_THAT(Points(*study), ElementsAre("a=1 b=2", "a=1 b=3", "a=2 b=1", "a=3 b=1"));
  // Each level of each factor is tried once, with whatever fulfils the conditions.
  const Design design(*study);
  EXPECT_THAT(design.PointsOfAllLevels(100), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(design.PointsOfAllLevels(2), ElementsAre(0, 3));
}

TEST(StudyFile, WhatIsWrongIsToldWithPlaceAndCure)
{
  const std::map<std::string, std::string> told{
      {"<factr id='a' path='p' values='1'/>", "s.xml:2:1: <study> has no element <factr>"},
      {"<factor id='a' path='p' valeus='1'/>", "did you mean 'values'?"},
      {"<factor id='a' path='p' values=''/>", "s.xml:2:1: <factor> 'a' has no values, so that there would be no runs"},
      {"<factor id='a' path='p' values='1' to='2'/>", "'to' is of a range"},
      {"<factor id='a' path='p'/>", "takes either 'values', or a range"},
      {"<factor id='a' path='p' from='1' to='2'/>", "either 'step' or 'count'"},
      {"<factor id='a' path='p' from='1' to='2' step='-1'/>", "'step'"},
      {"<factor id='a' path='p' from='2' to='1' step='0.5'/>", "'step' 0.5 does not lead from 2 to 1"},
      {"<factor id='a' path='p' from='0' to='1' count='3' scale='logarithmic'/>", "above 0"},
      {"<factor id='seed' path='p' values='1'/>", "the name of a column"},
      {"<factor id='a-b' path='p' values='1'/>", "letters, digits and '_'"},
      {"<factor id='a' path='p' values='1'/>\n<factor id='a' path='q' values='1'/>",
       "s.xml:3:9: the id 'a' is given a second time; the first is in line 2"},
      {"<zip></zip>", "<zip> holds no factor"},
      {"<zip><factor id='a' path='p' values='1 2'/><factor id='b' path='q' values='1'/></zip>",
       "'a' has 2 and 'b' has 1"},
      {"<variants id='v'/>", "'v' has no values"},
      {"<factor id='a' path='p' values='1'/><require condition='b &gt; 1'/>", "there is no 'b'"},
      {"<factor id='a' path='p' values='1'/><require condition='a &gt; 1'/>",
       "none of 1 combinations fulfils the conditions"},
      {"<metrics><distance id='d' aggregate='meen'/></metrics>", "did you mean 'mean'?"},
      {"<metrics><distence id='d'/></metrics>", "did you mean 'distance'?"},
      {"<metrics><in_region id='d' radius='1'/></metrics>", "a region is one of these"},
      {"<metrics><coverage id='d'/></metrics>", "lacks 'cell'"},
  };
  for (const auto& [inside, text] : told) EXPECT_THAT(Complaints(inside), HasSubstr(text)) << inside;
  EXPECT_THAT(Complaints("", "seeds='5-2'"), HasSubstr("ends before it begins"));
  EXPECT_THAT(Complaints("", "seeds='1-3, 2'"), HasSubstr("2 a second time"));
  EXPECT_THAT(Complaints("", "seeds='one'"), HasSubstr("'one'"));
}

TEST(StudyFile, EqualValuesOfAFactorAreRefused)
{
  const auto of_factor = [](const std::string& attributes)
  { return Complaints("<factor id='a' path='p' " + attributes + "/>"); };
  EXPECT_EQ(
      of_factor("values='2,2'"),
      "s.xml:2:25: value 2 is 'a=2', as is value 1 at s.xml:2:25: their runs would be counted twice; leave one of "
      "the two out\n");
  EXPECT_THAT(of_factor("values='1 2.0 3 2'"), HasSubstr("value 4 is 'a=2', as is value 2"));
  EXPECT_THAT(of_factor("values='1,2,0; 1, 2, 0'"), HasSubstr("value 2 is 'a=1, 2, 0', as is value 1"));
  EXPECT_THAT(of_factor("from='1' to='1' count='3'"), HasSubstr("value 2 is 'a=1', as is value 1"));
  EXPECT_EQ(of_factor("values='1,2,0; 1,2,1'"), "");
  EXPECT_EQ(of_factor("values='walk Walk'"), "");
  // Factors of a <zip> may repeat a value, but not all of them in the same place.
  EXPECT_EQ(Complaints("<zip><factor id='a' path='p' values='1 1'/><factor id='b' path='q' values='1 2'/></zip>"), "");
  EXPECT_THAT(Complaints("<zip><factor id='a' path='p' values='1 1'/><factor id='b' path='q' values='2 2'/></zip>"),
              HasSubstr("value 2 is 'a=1 b=2', as is value 1"));
  EXPECT_THAT(Complaints("<variants id='v'><variant id='x'/>\n<variant id='x'/></variants>"),
              HasSubstr("s.xml:3:10: the variant 'x' is given a second time; the first is at s.xml:2:18"));
  EXPECT_THAT(Complaints("<metrics><distance id='d' aggregate='mean max mean'/></metrics>"),
              HasSubstr("'aggregate' names 'mean' a second time"));
}

// Two statements about one value of an experiment with ten distributed robots and two engines.
class StudyConflicts : public testing::Test
{
protected:
  std::string Told(const std::string& inside, const std::string& attributes = "")
  {
    const std::string file = folder_.Path() + "/e.xml";
    folder_.Write("e.xml", test::ExperimentText{.framework = "<maxclock>9</maxclock>",
                                                .arena = "<distribute id='some' quantity='10'/>",
                                                .engines = "<dummy_engine id='one'/><dummy_engine id='two'/>",
                                                .physics = ""}
                               .Text());
    folder_.Write("other.xml", test::ExperimentText().Text());
    const LoadedStudy loaded = LoadStudyText(
        "<study experiment='" + file + "' " + attributes + ">\n" + inside + "</study>", "s.xml", folder_.Path());
    for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
    if (!loaded.study) return "";
    std::string all;
    for (const std::string& conflict : ConflictsIn(*loaded.study, Design(*loaded.study))) all += conflict + "\n";
    return all;
  }

private:
  test::TemporaryFolder folder_;
};

TEST_F(StudyConflicts, TwoFactorsOfOneValueAreToldWithBothPlaces)
{
  EXPECT_EQ(
      Told("<factor id='a' path='arena.some.quantity' values='1 2'/>\n"
           "<factor id='b' path='arena.distribute[0].quantity' values='3 4'/>"),
      "s.xml:3:1: the factor 'b' sets 'arena.distribute[0].quantity', which the factor 'a' at s.xml:2:1 sets, too "
      "(as 'arena.some.quantity'); leave one of the two out\n");
  EXPECT_EQ(Told("<set path='engines.two.distance' value='1'/>\n<factor id='b' path='engines.dummy_engine[1].distance' "
                 "values='3 4'/>"),
            "s.xml:3:1: the factor 'b' sets 'engines.dummy_engine[1].distance', which <set> at s.xml:2:1 sets, too (as "
            "'engines.two.distance'); leave one of the two out\n");
  EXPECT_THAT(Told("<set path='arena.size' value='1,1,1'/>\n<set path='arena.size' value='2,2,1'/>"),
              HasSubstr("s.xml:3:1: <set> sets 'arena.size', which <set> at s.xml:2:1 sets, too;"));
  EXPECT_THAT(Told("<factor id='a' path='arena.size arena.size' values='1,1,1; 2,2,1'/>"),
              HasSubstr("which the factor 'a' at s.xml:2:1 sets, too"));
  EXPECT_THAT(Told("<set path='framework.maxclock' value='7'/>", "ticks='8'"), HasSubstr("s.xml:1:"));
  EXPECT_THAT(Told("<factor id='s' path='framework.seed' values='1 2'/>"), HasSubstr("'seeds' of <study>"));
  EXPECT_EQ(Told("<factor id='a' path='engines.one.distance' values='1 2'/>"
                 "<factor id='b' path='engines.two.distance' values='3 4'/>",
                 "ticks='8' seeds='1-3'"),
            "");
}

TEST_F(StudyConflicts, VariantsConflictOnlyInRunsThatHaveBoth)
{
  const std::string engine =
      "<variants id='v'><variant id='x'/>\n<variant id='y'><set path='arena.size' value='1,1,1'/></variant>"
      "<variant id='z'><set path='arena.size' value='2,2,1'/></variant></variants>";
  EXPECT_EQ(Told(engine), "") << "no run has two variants of one factor";
  const std::string factor = "\n<factor id='a' path='arena.size' values='3,3,1; 4,4,1'/>";
  EXPECT_THAT(Told(engine + factor),
              HasSubstr("s.xml:4:1: the factor 'a' sets 'arena.size', which <set> of the variant "
                        "'y' of 'v' at s.xml:3:17 sets, too"));
  EXPECT_EQ(Told(engine + factor + "<require condition=\"v == 'x'\"/>"), "") << "these runs are left out";
  const auto experiments = [](const std::string& id)
  { return "<variants id='" + id + "'><variant id='x'/><variant id='y' experiment='other.xml'/></variants>\n"; };
  EXPECT_THAT(Told(experiments("v") + experiments("w")),
              HasSubstr("the variant 'y' of 'w' chooses the experiment of runs whose experiment the variant 'y' of 'v' "
                        "at s.xml:2:35 chooses, too"));
  // <distribute> is in one of the experiments only.
  EXPECT_THAT(Told(experiments("v") + "<set path='arena.some.quantity' value='1'/><set path='arena.some.quantity' "
                                      "value='2'/>"),
              HasSubstr("leave one of the two out"));
}

TEST(StudyFile, MoreThanAMillionRunsAreRefused)
{
  const std::string thousand = "<factor id='a' path='p' from='1' to='1000' step='1'/>";
  EXPECT_EQ(Complaints(thousand, "seeds='1-1000'"), "");
  EXPECT_THAT(Complaints(thousand, "seeds='1-1001'"), HasSubstr("it may have 1e+06"));
  EXPECT_THAT(Complaints("", "seeds='1-2000000'"), HasSubstr("the most runs of a study"));
  const std::string four = thousand + "<factor id='b' path='q' from='1' to='1000' step='1'/>";
  EXPECT_THAT(Complaints(four + "<require condition='a &gt; 0'/>", "seeds='1-2'"), HasSubstr("more than 1000000 runs"));
  EXPECT_EQ(Complaints(four + "<require condition='a == b'/>", "seeds='1-1000'"), "");
}

TEST(StudyReference, IsThatOfTheTables)
{
  const std::filesystem::path page = std::filesystem::path(SWARMANOID_SOURCE_FOLDER) / "docs/study_reference.md";
  if (std::getenv("SWARMANOID_WRITE_REFERENCE") != nullptr) std::ofstream(page) << StudyReference();
  EXPECT_EQ(test::TextOf(page), StudyReference())
      << "write it again: SWARMANOID_WRITE_REFERENCE=1 unit_studies --gtest_filter='StudyReference.*'";
}

}  // namespace
}  // namespace swarmanoid
