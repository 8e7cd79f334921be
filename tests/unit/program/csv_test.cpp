// Lines of comma-separated values.
#include "common/program/csv.h"

#include <gmock/gmock.h>

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;

TEST(Csv, QuotesFieldsThatWouldBreakALine)
{
  EXPECT_EQ(CsvField(""), "");
  EXPECT_EQ(CsvField("fb_1 'x' 2.5"), "fb_1 'x' 2.5");
  EXPECT_EQ(CsvField("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvField("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(CsvField("two\nlines"), "\"two\nlines\"");
}

TEST(Csv, SplitsLines)
{
  EXPECT_THAT(CsvFields(""), ElementsAre(""));
  EXPECT_THAT(CsvFields("7,move,fb_3,1 1 0,"), ElementsAre("7", "move", "fb_3", "1 1 0", ""));
  EXPECT_THAT(CsvFields("\"a,\"\"b\"\"\",visualiser 'x',\"\""), ElementsAre("a,\"b\"", "visualiser 'x'", ""));
  EXPECT_THAT(CsvFields("1,\"never closed, "), ElementsAre("1", "never closed, "));
  EXPECT_THAT(CsvFields("5\",\""), ElementsAre("5\"", ""));
}

TEST(Csv, ReadsWhatItWrites)
{
  const std::vector<std::string> texts{"", "\"", "\"\"", ",", "a\",\"b", "\n", "x", " \"y\" ", ",\",", "\"a"};
  for (const std::string& first : texts)
    for (const std::string& second : texts)
      EXPECT_THAT(CsvFields(CsvField(first) + "," + CsvField(second)), ElementsAre(first, second));
}

}  // namespace
}  // namespace swarmanoid
