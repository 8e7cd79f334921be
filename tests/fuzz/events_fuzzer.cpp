// Any text is refused as the events of a run with a reason, or is events of the experiment in the order of their ticks.
#include <cstdlib>
#include <string>

#include "space_server/event_log.h"
#include "tests/fuzz/fuzz_driver.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t count)
{
  using namespace swarmanoid;
  static const Experiment experiment = []
  {
    Experiment made;
    made.entities.resize(2);
    made.entities[0].id = "fb_1";
    made.entities[0].movable = true;
    made.entities[1].id = "wall";
    return made;
  }();
  const std::string text(reinterpret_cast<const char*>(input), count);
  try
  {
    std::uint64_t last = 0;
    for (const RecordedEvent& event : ParseEvents(text, "events.csv", experiment))
    {
      if (event.tick < last) std::abort();
      last = event.tick;
      if (event.request.Get<std::string>("entity", "fb_1") != "fb_1") std::abort();
    }
  }
  catch (const ConfigurationError& error)
  {
    if (!std::string(error.what()).starts_with("events.csv:")) std::abort();
  }
  return 0;
}
