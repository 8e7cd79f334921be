// Any payload of any topic is refused with the name of a field, or is a message whose own bytes give it again. The
// first byte of an input chooses the topic.
#include <algorithm>
#include <cstdlib>

#include "tests/fuzz/fuzz_driver.h"
#include "tests/world/random_message.h"

namespace swarmanoid
{
namespace
{

template <class... Parts>
std::string BytesOf(const Parts&... parts)
{
  std::string bytes(PayloadSize(parts...), '\0');
  WritePayload(bytes.data(), parts...);
  return bytes;
}

// The bytes need not be equal: padding may hold any bytes, and an empty text may come without its zero.
template <class Message>
void TryOther(std::span<const char> payload)
{
  Message message;
  ReadPayload(payload, message);
  if constexpr (requires { message.protocol; })
    if (message.protocol != kProtocolVersion) return;
  const std::string bytes = BytesOf(message);
  Message again;
  ReadPayload(bytes, again);
  if (BytesOf(again) != bytes) std::abort();
}

template <class Message>
void TryOfTick(std::span<const char> payload)
{
  const auto read = [](std::span<const char> from, MessageHeader& header, Message& message)
  {
    ReadTickPayload<Message>(
        from, header, [&](const MessageHeader&) { return &message; }, [](const MessageHeader&, const Message&) {});
  };
  MessageHeader header;
  Message message;
  read(payload, header, message);
  const std::string bytes = BytesOf(header, message);
  MessageHeader header_again;
  Message again;
  read(bytes, header_again, again);
  if (BytesOf(header_again, again) != bytes || bytes.size() > payload.size()) std::abort();
}

template <class Message>
std::string AnyOther(RandomMessage& random)
{
  Message message;
  random.Fill(message);
  return BytesOf(message);
}

template <class Message>
std::string AnyOfTick(RandomMessage& random)
{
  MessageHeader header;
  Message message;
  random.Fill(header, message);
  return BytesOf(header, message);
}

struct Topic
{
  void (*attempt)(std::span<const char>);
  std::string (*any)(RandomMessage&);
};

#define TOPIC_OF_TICK(MESSAGE, TOPIC) {TryOfTick<MESSAGE>, AnyOfTick<MESSAGE>},
#define OTHER_TOPIC(MESSAGE, TOPIC) {TryOther<MESSAGE>, AnyOther<MESSAGE>},
constexpr Topic kFuzzed[] = {SWARMANOID_HOT_MESSAGES(TOPIC_OF_TICK) SWARMANOID_COLD_MESSAGES(OTHER_TOPIC)};

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  RandomMessage random(1);
  std::vector<fuzz::Input> inputs;
  for (std::size_t topic = 0; topic < std::size(kFuzzed); ++topic)
    for (int k = 0; k < 3; ++k)
    {
      const std::string payload = kFuzzed[topic].any(random);
      fuzz::Input& input = inputs.emplace_back(payload.size() + 1, static_cast<std::uint8_t>(topic));
      std::copy(payload.begin(), payload.end(), input.begin() + 1);
    }
  return inputs;
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count)
{
  using namespace swarmanoid;
  if (count == 0) return 0;
  try
  {
    kFuzzed[bytes[0] % std::size(kFuzzed)].attempt({reinterpret_cast<const char*>(bytes) + 1, count - 1});
  }
  catch (const BadMessage& error)
  {
    if (error.what()[0] == '\0') std::abort();
  }
  return 0;
}
