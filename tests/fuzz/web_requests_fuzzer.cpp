// Any text that a page sends is a request within its bounds, or is refused with a text for the user.
#include <cstdlib>
#include <stdexcept>

#include "common/bus/topics/message_bytes.h"
#include "common/messages/control_verbs.h"
#include "tests/fuzz/fuzz_driver.h"
#include "visualiser/web/page_messages.h"

namespace swarmanoid
{
namespace
{

void Promise(bool kept)
{
  if (!kept) std::abort();
}

struct Check
{
  void operator()(const WatchRequest& request) const { Promise(request.entities.size() <= kMostWatched); }
  void operator()(const MarksRequest& request) const
  {
    for (const auto* entities : {&request.rays, &request.bodies, &request.links})
      Promise(entities->size() <= kMostMarked);
  }
  void operator()(const FrameRateRequest& request) const { Promise(request.period_ms <= 60000); }
  // An order can be sent, and is read as it was sent.
  void operator()(const ControlOrder& order) const
  {
    Promise(OrderError(order, Asker::kMember).empty());
    const ControlRequestMessage request{order};
    std::vector<char> payload(PayloadSize(request));
    WritePayload(payload.data(), request);
    ControlRequestMessage read;
    ReadPayload(payload, read);
    Promise(static_cast<const ControlOrder&>(read) == order);
  }
  template <class Other>
  void operator()(const Other&) const
  {
  }
};

fuzz::Input InputOf(std::string_view text) { return {text.begin(), text.end()}; }

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  return {InputOf(R"({"do":"watch","entities":[0,3,4294967295]})"),
          InputOf(R"({"do":"frame_period","ms":40})"),
          InputOf(R"({"do":"marks","rays":[0,7],"bodies":[],"links":[3]})"),
          InputOf(R"({"do":"prove","proof":"5bdcc146bf60754e"})"),
          InputOf(R"({"do":"pause"})"),
          InputOf(R"({"do":"resume"})"),
          InputOf(R"({"do":"step","ticks":10})"),
          InputOf(R"({"do":"speed","factor":1.5})"),
          InputOf(R"({"do":"move","entity":"fb_0","position":[1,2.5,0],"angles":[0,0,90]})"),
          InputOf(R"({"do":"add","entity":"reserve","position":[-1e3,2,0],"angles":[1,2,3]})"),
          InputOf(R"({"do":"remove","entity":"\u00fcber \ud834\udd1e"})"),
          InputOf(R"({"do":"press","key":"Up"})"),
          InputOf(R"({"do":"release","key":"\u0000"})"),
          InputOf(R"({"do":"select","entity":"fb_0"})"),
          InputOf(R"({"do":"select","entity":")" + std::string(3000, 'x') + "\"}"),
          InputOf(R"({"do":"reset"})"),
          InputOf(R"({"do":"stop"})")};
}

std::vector<fuzz::Input> fuzz::Words()
{
  return {InputOf("\"entities\":["),
          InputOf("\"position\":[1e308,1e308,1e308]"),
          InputOf("-1"),
          InputOf("1e999"),
          InputOf("18446744073709551616"),
          InputOf("null"),
          InputOf("\\u0000"),
          InputOf("\\n"),
          InputOf("\\u0085"),
          InputOf(std::string(1025, 'n')),
          InputOf("\\ud800"),
          InputOf("[[[[[[[[[[[[[[[["),
          InputOf("{\"do\":{\"do\":"),
          InputOf("\"ticks\":4294967296"),
          InputOf("0.5")};
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count)
{
  using namespace swarmanoid;
  const std::string_view text(reinterpret_cast<const char*>(bytes), count);
  try
  {
    const PageRequest request = ParseRequest(text);
    std::visit(Check(), request);
  }
  catch (const std::invalid_argument& error)
  {
    if (error.what()[0] == '\0') std::abort();
    RefusalText(error.what());
  }
  return 0;
}
