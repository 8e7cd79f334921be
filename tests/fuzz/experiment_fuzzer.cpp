// Any text is either refused with errors that have a message, or is an experiment whose effective text gives it again.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/unit/experiment/fake_plugins.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count)
{
  using namespace swarmanoid;
  const std::string text(reinterpret_cast<const char*>(bytes), count);
  // Libraries are not looked for: a text could name any file.
  if (text.find("library") != std::string::npos) return 0;
  // Large quantities are slow, not wrong.
  if (text.find("quantity") != std::string::npos && text.find("0000") != std::string::npos) return 0;

  const LoadedExperiment loaded = test::LoadText(text);
  if ((loaded.experiment != nullptr) != loaded.errors.empty()) std::abort();
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  for (const Diagnostic& error : loaded.errors)
  {
    if (error.message.empty() || error.location.line > lines) std::abort();
  }
  if (!loaded.experiment) return 0;
  const LoadedExperiment again = test::LoadText(loaded.experiment->effective_xml);
  if (!again.experiment || again.experiment->effective_xml != loaded.experiment->effective_xml) std::abort();
  if (again.experiment->entities.size() != loaded.experiment->entities.size()) std::abort();
  return 0;
}
