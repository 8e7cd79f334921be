// The needs of a space server's session, in a domain and a folder of shared memory that no other test uses.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/bus/membership/server_session.h"
#include "common/run/access/free_domain.h"

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
    world_.host = MachineName();
    world_.pid = static_cast<std::uint32_t>(getpid());
  }
  ~ServerFixture() override
  {
    unsetenv("SWARMANOID_SHARED_FOLDER");
    for (const std::string& folder : {folder_, of_worker_}) std::filesystem::remove_all(folder);
  }

  const std::string folder_;
  // A second folder, since a process may have only one folder of a run.
  const std::string of_worker_ = folder_ + "-worker";
  FreeDomain domain_;
  BusOptions options_;
  WorldMessage world_;
};

}  // namespace swarmanoid::test
