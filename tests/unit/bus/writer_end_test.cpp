// Situations in which a writer of Fast DDS 2.9 would loop for ever: at its end, and for a reader without an address.
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <filesystem>

#include "common/bus/dds/data_type.h"
#include "common/bus/dds/for_tests.h"
#include "common/bus/topics/participant.h"
#include "common/run/access/run_directory.h"
#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

class NumberType : public DataType
{
public:
  NumberType() : DataType("Number", sizeof(int), false) {}
  std::size_t SizeOf(const void*) const override { return sizeof(int); }
  bool Write(const void* data, Payload& payload) const override
  {
    std::memcpy(payload.data, data, sizeof(int));
    payload.length = sizeof(int);
    return true;
  }
  bool Read(const Payload& payload, void* data) const override
  {
    std::memcpy(data, payload.data, sizeof(int));
    return true;
  }
  void* Make() const override { return new int(0); }
  void Delete(void* data) const override { delete static_cast<int*>(data); }
};

class WriterEndTest : public test::ServerFixture
{
protected:
  WriterEndTest() : ServerFixture("writer_end") {}

  // Makes writers one after the other, whose messages are never confirmed.
  void EndWriters(int count)
  {
    const test::SeparateProcesses separate;
    Bus of_writers(options_, "writers");
    Bus of_reader(options_, "reader");
    const auto topic_of = [](Bus& bus)
    { return bus.Internals().TopicOf("number", [] { return dds::TypeSupport(new NumberType); }); };
    TopicQos topic;
    topic.topic = "number";
    topic.writer_depth = 2000;
    topic.reader_depth = 2000;
    dds::DataReaderQos reader_qos = ReaderQos(topic, 1);
    SetHeartbeatResponseDelay(reader_qos, {100, 0});
    const ReaderEnd reader(of_reader, topic_of(of_reader), "writer_end", reader_qos, nullptr);
    dds::DataWriterQos writer_qos = WriterQos(topic, true);
    SetHeartbeatPeriod(writer_qos, {0, 20'000});
    for (int k = 0; k < count; ++k)
    {
      WriterEnd writer(of_writers, topic_of(of_writers), "writer_end", writer_qos);
      ASSERT_TRUE(test::Eventually([&] { return writer.Matched() == 1; }));
      for (int number = 0; number < topic.writer_depth; ++number) writer.Write(&number);
    }
  }
};

// Fast DDS 2.9 looks for gaps between messages that it gives back at the same time, for ever (its pull request 4076).
TEST_F(WriterEndTest, EndsWhileItsHeartbeatGoesOut)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        alarm(60);
        EndWriters(30);
        _exit(testing::Test::HasFailure() ? 1 : 0);
      },
      testing::ExitedWithCode(0), "");
}

// Removes the memory, as of a process that has just ended and is still known.
void RemoveMemory(const std::string& folder)
{
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().filename().string().starts_with("fast_datasharing")) std::filesystem::remove(entry.path());
}

// Sends messages in fragments to a reader whose shared memory cannot be opened, and to a reader that exists.
void WriteToOneWithoutMemory(BusOptions options, const std::string& folder, bool insecure)
{
  options.insecure = insecure;
  const test::SeparateProcesses separate;
  const RunDirectory directory("writer_end", 5);
  const HotScope scope{"writer_end", directory.Path(), false, 400'000, 1};
  std::atomic<std::size_t> read = 0;
  SpaceState of_lost, of_other, state;
  const auto handler = [](SpaceState& place, std::function<void(const SpaceState&)> received)
  {
    return HotSubscription<SpaceState>::Handler{[&place](const MessageHeader&) { return &place; },
                                                [received](const MessageHeader&, SpaceState& message)
                                                { received(message); }};
  };
  Bus of_lost_reader(options, "lost");
  const HotSubscription<SpaceState> lost(of_lost_reader, scope, handler(of_lost, [](const SpaceState&) { FAIL(); }));
  RemoveMemory(folder);
  Bus of_other_reader(options, "other");
  const HotSubscription<SpaceState> other(of_other_reader, scope,
                                          handler(of_other, [&](const SpaceState& s) { read = s.poses.size(); }));
  Bus of_writer(options, "writer");
  HotPublisher<SpaceState> writer(of_writer, scope);
  ASSERT_TRUE(test::Eventually([&] { return writer.Readers() == 2 && other.Writers() == 1; }));
  state.poses.assign(40'000, 1.0);
  ASSERT_TRUE(test::Eventually(
      [&]
      {
        writer.Write({1, 1, 0, false}, state);
        return read == state.poses.size();
      }));
}

class WriterToNobody : public WriterEndTest, public testing::WithParamInterface<bool>
{
};

TEST_P(WriterToNobody, IsNotHeldUpByAReaderWhoseMemoryHasGone)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        alarm(60);
        WriteToOneWithoutMemory(options_, folder_, GetParam());
        _exit(testing::Test::HasFailure() ? 1 : 0);
      },
      testing::ExitedWithCode(0), "");
}

INSTANTIATE_TEST_SUITE_P(Writers, WriterToNobody, testing::Bool(),
                         [](const auto& of) { return of.param ? "WithoutKeys" : "WithKeys"; });

}  // namespace
}  // namespace swarmanoid
