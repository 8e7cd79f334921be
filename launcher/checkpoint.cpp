#include "launcher/checkpoint.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

constexpr std::array<char, 8> kMagic{'S', 'W', 'A', 'R', 'M', 'C', 'P', '1'};

std::uint64_t Fingerprint(const Experiment& experiment)
{
  return XXH3_64bits(experiment.effective_xml.data(), experiment.effective_xml.size());
}

}  // namespace

void SaveCheckpoint(const std::string& path, const Experiment& experiment, const CSwarmanoidSpace& space,
                    const std::vector<std::unique_ptr<EngineWorker>>& engines, const ControllerHost& host)
{
  ByteWriter state;
  state.Put(kMagic);
  state.Put(Fingerprint(experiment));
  state.Put(space.GetTick());
  std::vector<double> poses;
  space.WritePoses(poses);
  state.PutArray(poses);
  state.PutArray(space.Attributes());
  for (const auto& engine : engines) engine->SaveState(state);
  host.SaveState(state);

  const std::string unfinished = path + ".part";
  std::ofstream file(unfinished, std::ios::binary);
  file.write(state.Bytes().data(), static_cast<std::streamsize>(state.Bytes().size()));
  file.close();
  if (!file)
  {
    const int error = errno;
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw std::runtime_error("cannot write the checkpoint '" + path + "': " + std::strerror(error));
  }
  std::filesystem::rename(unfinished, path);
}

void LoadCheckpoint(const std::string& path, const Experiment& experiment, CSwarmanoidSpace& space,
                    const std::vector<std::unique_ptr<EngineWorker>>& engines, ControllerHost& host)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read the checkpoint '" + path + "': " + std::strerror(errno));
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  try
  {
    ByteReader state(bytes);
    if (state.Get<std::array<char, 8>>() != kMagic) throw std::runtime_error("it is not a checkpoint");
    if (state.Get<std::uint64_t>() != Fingerprint(experiment)) throw std::runtime_error("it is of another experiment");
    SpaceSnapshot snapshot;
    snapshot.tick = state.Get<std::uint64_t>();
    snapshot.poses = state.GetArray<double>();
    snapshot.attributes = state.GetArray<double>();
    if (snapshot.poses.size() != 7 * space.Movable().size() || snapshot.attributes.size() != space.Attributes().size())
      throw std::runtime_error("it has other entities");
    space.Apply(snapshot);
    for (const auto& engine : engines) engine->LoadState(state);
    host.LoadState(state);
    if (!state.AtEnd()) throw std::runtime_error("it is longer than its content");
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("checkpoint '" + path + "': " + error.what());
  }
}

}  // namespace swarmanoid
