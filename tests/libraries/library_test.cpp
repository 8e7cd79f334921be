// Libraries of controllers: the folders of the search, and the errors if they are missing or wrong.
#include "common/plugins/plugin_library.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "common/control_interface/ci_controller.h"
#include "common/experiment/load_experiment.h"

namespace swarmanoid
{
namespace
{

const std::string kFolder = LIBRARY_FOLDER;

std::string ErrorsWith(const std::string& controller, const std::string& library)
{
  const std::string text = "<ahss-config>\n<framework controller_path='" + kFolder + "'/>\n<controllers>\n<" +
                           controller + " id='c' library='" + library +
                           "'/>\n</controllers>\n<arena size='1,1,1' optimization='2D'/></ahss-config>";
  std::string errors;
  for (const Diagnostic& error : LoadExperimentText(text, "f.xml", "/experiments").errors)
    errors += error.Text() + "\n";
  return errors;
}

TEST(Libraries, AreFoundInDotLibsAndRegisterTheirController)
{
  EXPECT_EQ(ErrorsWith("good_controller", "good_controller"), "");
  const auto* entry = PluginRegistry<CCI_Controller>::Instance().Find("good_controller");
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(entry->create()->Init({}), CCI_Controller::RETURN_OK);
}

TEST(Libraries, LinkedWithFastMathLeaveTinyNumbersAsTheyAre)
{
  volatile double tiny = std::numeric_limits<double>::min();
  EXPECT_EQ(ErrorsWith("fast_math_controller", "fast_math_controller"), "");
  EXPECT_GT(tiny / 2, 0);
}

TEST(Libraries, AreFoundByPathToo)
{
  EXPECT_EQ(ErrorsWith("good_controller", kFolder + "/.libs/libgood_controller.so"), "");
  EXPECT_EQ(ErrorsWith("good_controller", kFolder + "/.libs/good_controller"), "");
}

TEST(Libraries, LackingTheTagNamesThoseThatTheyHave)
{
  EXPECT_EQ(ErrorsWith("god_controller", "good_controller"),
            "f.xml:4:1: the library " + kFolder +
                "/.libs/libgood_controller.so registers no controller <god_controller>; it "
                "registers: good_controller; did you mean 'good_controller'?\n");
}

TEST(Libraries, MissingNamesThePathsSearched)
{
  const std::string errors = ErrorsWith("x", "missing");
  EXPECT_EQ(errors.find("f.xml:4:11: the library 'missing' is not found; build it, or name its folder in "
                        "<controller_path> or <plugin_path>; searched:\n    " +
                        kFolder + "/libmissing.so\n    " + kFolder + "/.libs/libmissing.so\n    " + kFolder +
                        "/missing.so\n    " + kFolder + "/.libs/missing.so\n    /experiments/libmissing.so\n"),
            0U)
      << errors;
}

TEST(Libraries, ThatCannotBeLoadedGiveTheReason)
{
  const std::string errors = ErrorsWith("x", "broken_controller");
  EXPECT_NE(errors.find("broken_controller.so cannot be loaded: "), std::string::npos) << errors;
  EXPECT_NE(errors.find("FunctionThatNobodyDefines"), std::string::npos) << errors;
}

TEST(Libraries, TakingAnotherOnesNameAreRefused)
{
  ASSERT_EQ(ErrorsWith("good_controller", "good_controller"), "");
  EXPECT_EQ(ErrorsWith("good_controller", "same_name_controller"),
            "f.xml:4:25: the library " + kFolder +
                "/same_name_controller.so: it registers the controller 'good_controller', which "
                "exists already; give one of them another name\n");
}

TEST(Libraries, NotNamedMustBeInTheProgram)
{
  EXPECT_EQ(ErrorsWith("absent_controller", ""),
            "f.xml:4:1: the program holds no controller <absent_controller>; give the library that does, as "
            "library=\"name\"\n");
}

TEST(SearchPath, JoinsContinuedLines)
{
  EXPECT_EQ(SplitSearchPath(" /a/b/\\\n   c/.libs:/d: e/../f :", "/base"),
            (std::vector<std::string>{"/a/b/c/.libs", "/d", "/base/f"}));
  EXPECT_EQ(SplitSearchPath("/a\\ b", "/base"), (std::vector<std::string>{"/a\\ b"}));
  EXPECT_TRUE(SplitSearchPath("", "/base").empty());
}

TEST(SearchPath, TakesTheEnvironmentVariable)
{
  setenv("SWARMANOID_PLUGIN_PATH", "/one:/two", 1);
  const auto folders = StandardPluginFolders();
  unsetenv("SWARMANOID_PLUGIN_PATH");
  ASSERT_GE(folders.size(), 3U);
  EXPECT_EQ(folders[0], "/one");
  EXPECT_EQ(folders[1], "/two");
}

}  // namespace
}  // namespace swarmanoid
