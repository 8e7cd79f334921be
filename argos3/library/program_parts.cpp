// Parts of ARGoS3 for users' programs beside the simulator: options, rates, measurements, libraries.
#include <argos3/core/utility/configuration/command_line_arg_parser.h>
#include <argos3/core/utility/plugins/dynamic_loading.h>
#include <argos3/core/utility/profiler/profiler.h>
#include <argos3/core/utility/rate.h>

#include <dlfcn.h>

#include <thread>

namespace argos
{
namespace
{

std::string WithQuotes(const std::string& word) { return "'" + word + "'"; }

double Seconds(const ::timeval& time)
{
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

void CCommandLineArgParser::PrintUsage(CARGoSLog& log)
{
  for (const SOption& option : options_)
    log << "-" << option.short_option << "|--" << option.long_option << (option.is_flag ? "" : " <value>") << "\t"
        << option.description << std::endl;
}

template <class Matches>
const CCommandLineArgParser::SOption& CCommandLineArgParser::Find(const std::string& word, Matches matches) const
{
  const auto found = std::find_if(options_.begin(), options_.end(), matches);
  if (found == options_.end()) THROW_ARGOSEXCEPTION("there is no option " << WithQuotes(word));
  return *found;
}

void CCommandLineArgParser::Parse(SInt32 count, char** words)
{
  for (SInt32 i = 1; i < count; ++i)
  {
    const std::string word = words[i];
    const auto set = [&](const SOption& option, bool is_last)
    {
      if (option.is_flag) return option.set("true");
      if (!is_last || i + 1 == count) THROW_ARGOSEXCEPTION("the option " << WithQuotes(word) << " needs a value");
      option.set(words[++i]);
    };
    if (word.rfind("--", 0) == 0)
      set(Find(word, [&](const SOption& option) { return option.long_option == word.substr(2); }), true);
    else if (word.size() > 1 && word[0] == '-')
      for (std::size_t letter = 1; letter < word.size(); ++letter)
        set(Find(word, [&](const SOption& option) { return option.short_option == word[letter]; }),
            letter + 1 == word.size());
    else
      THROW_ARGOSEXCEPTION(WithQuotes(word) << " is no option");
  }
}

CDynamicLoading::TDLHandle CDynamicLoading::LoadLibrary(const std::string& library)
{
  std::vector<std::string> folders{"."};
  if (const char* list = std::getenv("ARGOS_PLUGIN_PATH")) Tokenize(list, folders, ":");
  const bool is_absolute = !library.empty() && library[0] == '/';
  std::string tried;
  for (const std::string& folder : folders)
    for (const char* ending : {"", ".so"})
    {
      const std::string file = (is_absolute ? "" : folder + "/") + library + ending;
      // The library is opened as those of an experiment, so that libraries see each other's names.
      if (void* handle = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_GLOBAL)) return handle;
      tried += std::string("\n    ") + ::dlerror();
    }
  THROW_ARGOSEXCEPTION("the library " << WithQuotes(library) << " cannot be loaded:" << tried);
}

CProfiler::CProfiler(const std::string& file, bool truncates) : file_(file, truncates ? std::ios::out : std::ios::app)
{
  if (!file_) THROW_ARGOSEXCEPTION("the file " << WithQuotes(file) << " of the profiler cannot be written");
}

void CProfiler::Start()
{
  start_ = std::chrono::steady_clock::now();
  ::getrusage(RUSAGE_SELF, &usage_at_start_);
}

void CProfiler::Stop()
{
  end_ = std::chrono::steady_clock::now();
  ::getrusage(RUSAGE_SELF, &usage_at_end_);
}

void CProfiler::Flush(bool human_readable)
{
  const std::pair<const char*, double> lines[] = {
      {"wall clock, s", std::chrono::duration<double>(end_ - start_).count()},
      {"processor, user, s", Seconds(usage_at_end_.ru_utime) - Seconds(usage_at_start_.ru_utime)},
      {"processor, system, s", Seconds(usage_at_end_.ru_stime) - Seconds(usage_at_start_.ru_stime)},
      {"most memory, KiB", static_cast<double>(usage_at_end_.ru_maxrss)}};
  for (const auto& line : lines)
    if (human_readable)
      file_ << line.first << ": " << line.second << "\n";
    else
      file_ << line.second << (&line == std::end(lines) - 1 ? "\n" : "\t");
  file_.flush();
}

void CRate::SetRate(Real rate)
{
  if (!(rate > 0)) THROW_ARGOSEXCEPTION("a rate of " << rate << " Hz; it must be above 0");
  rate_ = rate;
  start_ = std::chrono::steady_clock::now();
}

UInt64 CRate::ElapsedUS() const
{
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  return static_cast<UInt64>(std::chrono::duration_cast<std::chrono::microseconds>(elapsed).count());
}

void CRate::Sleep()
{
  const auto end = start_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                std::chrono::duration<double>(1 / rate_));
  if (std::chrono::steady_clock::now() > end)
    LOGERR << "a period of " << 1 / rate_ << " s was over after " << ElapsedS() << " s" << std::endl;
  std::this_thread::sleep_until(end);
  start_ = std::chrono::steady_clock::now();
}

}  // namespace argos
