// Words of commands for a shell.
#include "common/program/shell_word.h"

#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

TEST(ShellWord, KeepsPlainWordsAndQuotesOthers)
{
  EXPECT_EQ(ShellWord("--engine"), "--engine");
  EXPECT_EQ(ShellWord("runs/a_1@20"), "runs/a_1@20");
  EXPECT_EQ(ShellWord(""), "''");
  EXPECT_EQ(ShellWord("it's $HOME"), "'it'\\''s $HOME'");
}

}  // namespace
}  // namespace swarmanoid
