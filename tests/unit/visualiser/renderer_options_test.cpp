// The options of renderers on command lines.
#include "visualiser/renderer_options.h"

#include <CLI/CLI.hpp>

#include <gmock/gmock.h>

#include "common/plugin_descriptions/describe_builtins.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;
using testing::Not;

TEST(RendererOptions, TellChoicesAndDefaultsWhereThereAreSome)
{
  DescribeBuiltins();
  CLI::App app;
  std::vector<std::string> parameters;
  AddParametersOf("text", app, parameters);
  const std::string help = app.help();
  EXPECT_THAT(help, HasSubstr("Options of text_render"));
  EXPECT_THAT(help, HasSubstr("One of "));
  EXPECT_THAT(help, HasSubstr("Default: 1."));
  EXPECT_THAT(help, Not(HasSubstr("Default: ."))) << "an empty text is no default that one could give";
}

TEST(RendererOptions, BecomeWordsOfNameAndValue)
{
  DescribeBuiltins();
  CLI::App app;
  std::vector<std::string> parameters;
  AddParametersOf("text", app, parameters);
  app.parse("--every 5 file=t.txt --csv");
  EXPECT_THAT(parameters, testing::UnorderedElementsAre("every=5", "file=t.txt", "format=csv"));
  CLI::App without;
  AddParametersOf("", without, parameters);
  EXPECT_THAT(without.help(), Not(HasSubstr("Options of")));
}

}  // namespace
}  // namespace swarmanoid
