// Any bytes are refused as an archive with a reason, or are unpacked below one folder; and so is any text as its index.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "launcher/archive/run_archive.h"
#include "launcher/archive/tar_file.h"
#include "launcher/system/scratch_folder.h"
#include "tests/fuzz/fuzz_driver.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

// The index of an archive with two small members.
ArchiveIndex SmallIndex()
{
  ArchiveIndex index;
  index.experiment = "pair";
  index.version = "1.0.0";
  index.builds = {{kSwarmanoidBuild, "00ff"}};
  index.members = {{"experiment.xml", 4, std::string(64, '0')}, {"hashes.txt", 0, std::string(64, '1')}};
  return index;
}

std::string BytesOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class Read>
void Try(const Read& read)
{
  try
  {
    read();
  }
  catch (const std::runtime_error& error)
  {
    if (std::string_view(error.what()).empty()) std::abort();
  }
}

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  const ScratchFolder scratch;
  const std::string path = scratch.Path() + "/pair.tar.gz";
  const std::string text = SmallIndex().Text();
  {
    TarWriter tar("--output", path);
    for (const auto& [name, content] : {std::pair("pair/archive.json", std::string_view(text)),
                                        std::pair("pair/experiment.xml", std::string_view("<a/>"))})
    {
      tar.Begin(name, content.size());
      tar.Write(content);
      tar.End();
    }
    tar.Close();
  }
  const std::string bytes = BytesOf(path);
  return {{bytes.begin(), bytes.end()}, {text.begin(), text.end()}};
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t count)
{
  using namespace swarmanoid;
  static const ScratchFolder scratch;
  const std::string path = scratch.Path() + "/input", folder = scratch.Path() + "/folder";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(input), static_cast<std::streamsize>(count));
  fs::remove_all(folder);
  fs::create_directory(folder);
  Try([&] { UnpackArchive(path, folder); });
  Try([&] { ArchiveIndex::Parse({input, input + count}); });
  // Nothing but the two is beside the folder.
  if (std::distance(fs::directory_iterator(scratch.Path()), {}) != 2) std::abort();
  return 0;
}
