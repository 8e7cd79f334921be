// What a space server needs for its session, in a domain and a folder of shared memory that no other test uses.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/bus/domain.h"
#include "common/bus/server_session.h"

namespace swarmanoid::test
{

class ServerFixture : public testing::Test
{
protected:
  explicit ServerFixture(const std::string& experiment)
      : folder_(fmt::format("/dev/shm/swarmanoid-{}-test-{}", experiment, getpid()))
  {
    setenv("SWARMANOID_SHARED_FOLDER", folder_.c_str(), 1);
    options_.domain = domain_.Id();
    options_.key.emplace().fill(7);
    world_.run = 5;
    world_.experiment = experiment;
  }
  ~ServerFixture() override
  {
    unsetenv("SWARMANOID_SHARED_FOLDER");
    std::filesystem::remove_all(folder_);
  }

  const std::string folder_;
  FreeDomain domain_;
  BusOptions options_;
  WorldMessage world_;
};

}  // namespace swarmanoid::test
