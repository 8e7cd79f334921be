// How a writer ends while its heartbeat goes out.
#include <unistd.h>

#include <cstring>

#include "common/bus/participant.h"
#include "tests/eventually.h"
#include "tests/unit/bus/separate_processes.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

class NumberType : public dds::TopicDataType
{
public:
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
  NumberType()
  {
    setName("Number");
    m_typeSize = sizeof(int);
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, Payload* payload) override
  {
    std::memcpy(payload->data, data, sizeof(int));
    payload->length = sizeof(int);
    return true;
  }
  bool deserialize(Payload* payload, void* data) override
  {
    std::memcpy(data, payload->data, sizeof(int));
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override
  {
    return [] { return static_cast<std::uint32_t>(sizeof(int)); };
  }
  void* createData() override { return new int(0); }
  void deleteData(void* data) override { delete static_cast<int*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

class WriterEndTest : public test::ServerFixture
{
protected:
  WriterEndTest() : ServerFixture("writer_end") {}

  // Writers one after the other, whose messages nobody confirms.
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
    reader_qos.reliable_reader_qos().times.heartbeatResponseDelay = eprosima::fastrtps::Duration_t(100, 0);
    const ReaderEnd reader(of_reader, topic_of(of_reader), "writer_end", reader_qos, nullptr);
    dds::DataWriterQos writer_qos = WriterQos(topic);
    writer_qos.reliable_writer_qos().times.heartbeatPeriod = eprosima::fastrtps::Duration_t(0, 20'000);
    for (int k = 0; k < count; ++k)
    {
      const WriterEnd writer(of_writers, topic_of(of_writers), "writer_end", writer_qos);
      ASSERT_TRUE(test::Eventually([&] { return writer.Matched() == 1; }));
      for (int number = 0; number < topic.writer_depth; ++number) writer->write(&number);
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

}  // namespace
}  // namespace swarmanoid
