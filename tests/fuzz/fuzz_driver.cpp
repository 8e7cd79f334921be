// The driver of the fuzzers in the normal build, as a test: the fixed corpus, then a fixed number of inputs changed at
// random from a fixed seed. The Clang build links libFuzzer instead.
//
//   topic_fuzzer [--inputs N] [--seed S] [CORPUS_FILE_OR_FOLDER]...
//   topic_fuzzer --write-corpus FOLDER
//
// The input that makes the program end is kept as <program>.failed in the current folder; give it as the corpus, with
// --inputs 0, to see it again.
#include "tests/fuzz/fuzz_driver.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>

namespace
{

namespace fs = std::filesystem;
using swarmanoid::fuzz::Input;

constexpr std::size_t kLongestInput = std::size_t{1} << 18U;
constexpr unsigned kMostSeconds = 60;  // limit for one input

// SplitMix64: its numbers are the same everywhere.
class Random
{
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t Next()
  {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  std::size_t Below(std::size_t end) { return end == 0 ? 0 : static_cast<std::size_t>(Next() % end); }

private:
  std::uint64_t state_;
};

// The handler of signals needs it.
Input current;
std::array<char, 4096> kept_path{};

void KeepInput(int signal)
{
  const int file = open(kept_path.data(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0644);
  const bool kept = file >= 0 && write(file, current.data(), current.size()) == static_cast<ssize_t>(current.size());
  constexpr char kSaid[] = "the input that fails is kept as *.failed in this folder\n";
  if (kept && write(STDERR_FILENO, kSaid, sizeof kSaid - 1) < 0) _exit(1);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void CatchFailures(const std::string& program)
{
  const std::string path = fs::path(program).filename().string() + ".failed";
  path.copy(kept_path.data(), kept_path.size() - 1);
  // A stack that has run over cannot hold a handler's frame.
  static std::array<char, 65536> stack;
  stack_t other{};
  other.ss_sp = stack.data();
  other.ss_size = stack.size();
  sigaltstack(&other, nullptr);
  struct sigaction action
  {
  };
  action.sa_handler = KeepInput;
  action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM}) sigaction(signal, &action, nullptr);
}

void Try(const Input& input)
{
  current = input;
  alarm(kMostSeconds);
  // A copy of exactly its length, so that tools see a byte read too many.
  const auto exact = std::make_unique<std::uint8_t[]>(std::max<std::size_t>(input.size(), 1));
  std::copy(input.begin(), input.end(), exact.get());
  LLVMFuzzerTestOneInput(exact.get(), input.size());
  alarm(0);
}

void Insert(Input& input, std::size_t at, const Input& part)
{
  input.insert(input.begin() + static_cast<std::ptrdiff_t>(at), part.begin(), part.end());
}

Input PartOf(const Input& input, Random& random)
{
  const std::size_t start = random.Below(input.size());
  const std::size_t count = std::min(input.size() - start, 1 + random.Below(random.Below(4) == 0 ? 512 : 16));
  const auto first = input.begin() + static_cast<std::ptrdiff_t>(start);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

// Numbers at which lengths, counts and indices go wrong, and patterns of doubles, little and big endian.
void WriteNumber(Input& input, Random& random)
{
  constexpr std::array<std::uint64_t, 16> kNumbers{
      0,          1,           0x7f,       0x80,        0xff,  0x7fff,    0xffff,           0x7fffffff,
      0x80000000, 0xffffffffU, ~0ULL >> 1, 1ULL << 63U, ~0ULL, ~0ULL - 7, 0x7ff8ULL << 48U, 0x7ff0ULL << 48U};
  const std::uint64_t number = kNumbers[random.Below(kNumbers.size())] + (random.Below(4) == 0 ? random.Below(16) : 0);
  const std::size_t width = std::size_t{1} << random.Below(4);
  if (input.size() < width) return;
  const std::size_t at = random.Below(input.size() - width + 1);
  const bool reversed = random.Below(4) == 0;
  for (std::size_t k = 0; k < width; ++k)
    input[at + (reversed ? width - 1 - k : k)] = static_cast<std::uint8_t>(number >> (8 * k));
}

void Change(Input& input, const std::vector<Input>& others, const std::vector<Input>& words, Random& random)
{
  const std::size_t at = random.Below(input.size() + 1);
  const std::size_t within = std::min(at, input.empty() ? 0 : input.size() - 1);
  switch (random.Below(9))
  {
    case 0:
      if (!input.empty()) input[within] ^= static_cast<std::uint8_t>(1U << random.Below(8));
      return;
    case 1:
      if (!input.empty()) input[within] = static_cast<std::uint8_t>(random.Next());
      return;
    case 2:
      WriteNumber(input, random);
      return;
    case 3:  // take out
    {
      const std::size_t count = std::min(input.size() - at, 1 + random.Below(random.Below(4) == 0 ? 256 : 8));
      const auto first = input.begin() + static_cast<std::ptrdiff_t>(at);
      input.erase(first, first + static_cast<std::ptrdiff_t>(count));
      return;
    }
    case 4:  // cut off
      if (random.Below(4) == 0) input.resize(at);
      return;
    case 5:  // repeat a part
      if (!input.empty()) Insert(input, at, PartOf(input, random));
      return;
    case 6:  // a part of another
    {
      const Input& other = others[random.Below(others.size())];
      if (!other.empty()) Insert(input, at, PartOf(other, random));
      return;
    }
    case 7:
      if (!words.empty()) Insert(input, at, words[random.Below(words.size())]);
      return;
    default:  // a run of one byte
      Insert(input, at, Input(1 + random.Below(64), static_cast<std::uint8_t>(random.Next())));
      return;
  }
}

Input ReadFile(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read '" + path.string() + "'");
  return {std::istreambuf_iterator<char>(file), {}};
}

void AddCorpus(const fs::path& path, std::vector<Input>& corpus)
{
  if (!fs::is_directory(path)) return corpus.push_back(ReadFile(path));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) corpus.push_back(ReadFile(file));
}

void WriteCorpus(const std::string& folder, const std::vector<Input>& corpus)
{
  fs::create_directories(folder);
  for (std::size_t k = 0; k < corpus.size(); ++k)
  {
    std::ofstream file(fs::path(folder) / std::to_string(k), std::ios::binary);
    file.write(reinterpret_cast<const char*>(corpus[k].data()), static_cast<std::streamsize>(corpus[k].size()));
  }
}

struct Settings
{
  std::size_t inputs = 2000;
  std::uint64_t seed = 1;
  std::string write_corpus;
  std::vector<std::string> corpus;
};

Settings SettingsOf(int count, char** arguments)
{
  Settings settings;
  for (int k = 1; k < count; ++k)
  {
    const std::string word = arguments[k];
    if (!word.starts_with("--"))
    {
      settings.corpus.push_back(word);
      continue;
    }
    if (++k == count) throw std::runtime_error(word + " needs a value");
    if (word == "--inputs")
      settings.inputs = std::stoul(arguments[k]);
    else if (word == "--seed")
      settings.seed = std::stoul(arguments[k]);
    else if (word == "--write-corpus")
      settings.write_corpus = arguments[k];
    else
      throw std::runtime_error("there is no option " + word);
  }
  return settings;
}

int Run(int count, char** arguments)
{
  const Settings settings = SettingsOf(count, arguments);
  std::vector<Input> corpus;
  if (swarmanoid::fuzz::FirstInputs != nullptr) corpus = swarmanoid::fuzz::FirstInputs();
  if (!settings.write_corpus.empty())
  {
    WriteCorpus(settings.write_corpus, corpus);
    return 0;
  }
  for (const std::string& path : settings.corpus) AddCorpus(path, corpus);
  if (corpus.empty()) throw std::runtime_error("there is no corpus to start from");
  const std::vector<Input> words =
      swarmanoid::fuzz::Words != nullptr ? swarmanoid::fuzz::Words() : std::vector<Input>();

  CatchFailures(arguments[0]);
  Try({});
  for (const Input& input : corpus) Try(input);
  Random random(settings.seed);
  for (std::size_t k = 0; k < settings.inputs; ++k)
  {
    Input input = corpus[random.Below(corpus.size())];
    for (std::size_t changes = 1 + random.Below(8); changes > 0; --changes) Change(input, corpus, words, random);
    if (input.size() > kLongestInput) input.resize(kLongestInput);
    Try(input);
  }
  std::printf("%zu inputs of the corpus, %zu changed from them\n", corpus.size(), settings.inputs);
  return 0;
}

}  // namespace

int main(int count, char** arguments)
{
  try
  {
    return Run(count, arguments);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s: %s\n", arguments[0], error.what());
    return 2;
  }
}
