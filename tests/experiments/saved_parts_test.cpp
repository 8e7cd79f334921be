// Each saved byte of the space server and of the controller hosts counts, for sample experiments whose devices,
// controllers and experiment functions have a state. The engines' parts are in tests/unit/*/checkpoint_test.cpp.
#include <gmock/gmock.h>
#include <unistd.h>

#include <cctype>

#include "common/checkpoint/checkpoint.h"
#include "common/messages/assignment.h"
#include "controller_host/controller_host.h"
#include "space_server/space_server.h"
#include "tests/experiments/running_experiment.h"
#include "tests/unit/engines/saved_state_bytes.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

class SavedParts : public testing::TestWithParam<std::tuple<const char*, int>>
{
protected:
  SavedParts() : name_(std::get<0>(GetParam())), tick_(std::get<1>(GetParam()))
  {
    SimulatorOptions options;
    options.output_folder = folder_.Path();
    options.checkpoint_every = 100;
    RunningExperiment run(name_ + ".xml", {}, options);
    run.Run(tick_);
    experiment_ = ReadExperiment(SWARMANOID_SOURCE_FOLDER "/configs/" + name_ + ".xml");
    checkpoint_ = ReadCheckpoint((folder_ / CheckpointName(static_cast<std::uint64_t>(tick_))).string(), *experiment_,
                                 {.hosts = 1, .any_build = false});
    assignment_ = MakeAssignment(*experiment_, 1);
    server_ = std::make_unique<SpaceServer>(*experiment_, assignment_, folder_.Path());
    checkpoint_.LoadPart(kServerPart, [&](ByteReader& state) { server_->LoadState(checkpoint_.snapshot, state); });
    host_ = std::make_unique<ControllerHost>(server_->Space(), assignment_, 0);
  }

  std::vector<char> Part(const std::string& name) const
  {
    const std::span<const char> state = checkpoint_.StateOf(name);
    return {state.begin(), state.end()};
  }

  // Saves a role again that has loaded a part, as Checkpoint::LoadPart loads it.
  template <class Role>
  static std::vector<char> WhatIsSaved(const Role& role, const ByteReader& read)
  {
    if (!read.AtEnd()) throw std::runtime_error("it is longer than its content");
    ByteWriter writer;
    role.SaveState(writer);
    return writer.Bytes();
  }

  // Returns whether the number in a text keeps its value if the lowest bit of one of its bytes changes: the last of 17
  // digits may be one of several.
  static bool IsSameNumber(const std::vector<char>& saved, std::size_t place)
  {
    const auto belongs = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.'; };
    std::size_t begin = place, end = place;
    while (begin > 0 && belongs(saved[begin - 1])) --begin;
    while (end < saved.size() && belongs(saved[end])) ++end;
    std::string number(saved.begin() + static_cast<std::ptrdiff_t>(begin),
                       saved.begin() + static_cast<std::ptrdiff_t>(end));
    if (number.size() < 17) return false;
    const double value = std::stod(number);
    number[place - begin] ^= 1;
    return belongs(number[place - begin]) && std::stod(number) == value;
  }

  // Returns the lost bytes, except those that only separate the numbers of a text.
  static std::vector<std::size_t> Lost(const std::vector<char>& saved,
                                       const std::function<std::vector<char>(const std::vector<char>&)>& saved_again)
  {
    EXPECT_EQ(saved_again(saved), saved);
    std::vector<std::size_t> lost = LostBytes(saved, saved_again);
    std::erase_if(
        lost, [&](std::size_t place)
        { return std::isspace(static_cast<unsigned char>(saved[place])) != 0 || IsSameNumber(saved, place); });
    return lost;
  }

  const std::string name_;
  const int tick_;
  const test::TemporaryFolder folder_;
  std::unique_ptr<Experiment> experiment_;
  Checkpoint checkpoint_;
  Assignment assignment_;
  std::unique_ptr<SpaceServer> server_;
  std::unique_ptr<ControllerHost> host_;
};

TEST_P(SavedParts, EachByteOfTheControllerHostCounts)
{
  const std::vector<char> saved = Part("controller host 0");
  ASSERT_FALSE(saved.empty());
  const auto saved_again = [&](const std::vector<char>& state)
  {
    ByteReader reader(state);
    host_->LoadState(reader);
    return WhatIsSaved(*host_, reader);
  };
  EXPECT_THAT(Lost(saved, saved_again), testing::IsEmpty()) << "of " << saved.size();
}

TEST_P(SavedParts, EachByteOfTheSpaceServerCounts)
{
  const std::vector<char> saved = Part(kServerPart);
  const auto saved_again = [&](const std::vector<char>& state)
  {
    ByteReader reader(state);
    server_->LoadState(checkpoint_.snapshot, reader);
    return WhatIsSaved(*server_, reader);
  };
  EXPECT_THAT(Lost(saved, saved_again), testing::IsEmpty()) << "of " << saved.size();
}

INSTANTIATE_TEST_SUITE_P(Experiments, SavedParts,
                         testing::Values(std::tuple("prey_retrieval", 2100), std::tuple("prey_supply", 300),
                                         std::tuple("gripped_chain", 100), std::tuple("handbot_shelf", 200)),
                         [](const auto& test) { return std::string(std::get<0>(test.param)); });

}  // namespace
}  // namespace swarmanoid
