#include "visualiser/web/kept_address.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include "tests/world/temporary_folder.h"
#include "visualiser/web/access.h"

namespace swarmanoid
{
namespace
{

class KeptAddressTest : public testing::Test
{
protected:
  std::filesystem::path File() const { return std::filesystem::directory_iterator(folder_)->path(); }

  test::TemporaryFolder parent_;
  std::filesystem::path folder_ = parent_ / "state";
};

TEST_F(KeptAddressTest, TheNextStartOfAnExperimentHasPortAndTokenOfTheLast)
{
  const std::string token = MakeToken();
  {
    KeptAddress first(folder_, "one/foraging");
    EXPECT_EQ(first.Port(), 0);
    EXPECT_EQ(first.Token(), "");
    EXPECT_TRUE(first.Keep(40123, token));
  }
  KeptAddress second(folder_, "one/foraging");
  EXPECT_EQ(second.Port(), 40123);
  EXPECT_EQ(second.Token(), token);
  EXPECT_EQ(KeptAddress(folder_, "another/foraging").Port(), 0);
}

TEST_F(KeptAddressTest, OfTwoRunsAtTheSameTimeTheSecondKeepsNothing)
{
  KeptAddress first(folder_, "foraging");
  EXPECT_TRUE(first.Keep(40123, ""));
  KeptAddress second(folder_, "foraging");
  EXPECT_EQ(second.Port(), 0);
  EXPECT_FALSE(second.Keep(40124, ""));
  EXPECT_NE(second.Trouble(), "");
}

TEST_F(KeptAddressTest, OnlyTheUserMayReadTheFile)
{
  {
    KeptAddress kept(folder_, "foraging");
    kept.Keep(40123, MakeToken());
    struct stat status
    {
    };
    ASSERT_EQ(stat(File().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U);
  }
  // One that others could have read or written is not believed.
  chmod(File().c_str(), 0644);
  KeptAddress kept(folder_, "foraging");
  EXPECT_EQ(kept.Port(), 0);
  EXPECT_EQ(kept.Token(), "");
  EXPECT_FALSE(kept.Keep(40124, MakeToken()));
}

TEST_F(KeptAddressTest, WhatIsNoAddressIsAsGoodAsNothing)
{
  {
    KeptAddress(folder_, "foraging").Keep(40123, MakeToken());
  }
  const std::filesystem::path file = File();
  for (const char* text :
       {"", "\n", "x 0123", "70000", "40123 short\n", "40123 0123456789ABCDEF0123456789ABCDEF", "-1"})
  {
    std::ofstream(file, std::ios::trunc) << text;
    EXPECT_EQ(KeptAddress(folder_, "foraging").Port(), 0) << text;
    EXPECT_EQ(KeptAddress(folder_, "foraging").Token(), "") << text;
  }
}

TEST_F(KeptAddressTest, LinksAreNotFollowed)
{
  {
    KeptAddress(folder_, "foraging").Keep(40123, "");
  }
  const std::filesystem::path file = File();
  std::filesystem::rename(file, folder_ / "elsewhere");
  std::filesystem::create_symlink(folder_ / "elsewhere", file);
  KeptAddress kept(folder_, "foraging");
  EXPECT_EQ(kept.Port(), 0);
  EXPECT_NE(kept.Trouble(), "");
}

TEST(StateFolder, IsInTheFolderForStatesOrInTheHomeIfTheirPathsAreAbsolute)
{
  const std::array<std::string, 2> names{"XDG_STATE_HOME", "HOME"};
  std::array<std::optional<std::string>, 2> before;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (const char* value = std::getenv(names[k].c_str())) before[k] = value;
  const auto folder = [&](const char* state, const char* home)
  {
    setenv("XDG_STATE_HOME", state, 1);
    setenv("HOME", home, 1);
    return StateFolder().string();
  };
  EXPECT_EQ(folder("/states", "/houses/one"), "/states/swarmanoid/web");
  EXPECT_EQ(folder("", "/houses/one"), "/houses/one/.local/state/swarmanoid/web");
  EXPECT_EQ(folder("states", "/houses/one"), "/houses/one/.local/state/swarmanoid/web");
  EXPECT_EQ(folder("", "one"), "");
  for (std::size_t k = 0; k < names.size(); ++k)
    before[k] ? setenv(names[k].c_str(), before[k]->c_str(), 1) : unsetenv(names[k].c_str());
}

}  // namespace
}  // namespace swarmanoid
