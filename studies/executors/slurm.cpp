// The study talks to Slurm through its commands, whose output differs between versions and is mixed with warnings of
// the site. So only what is certain is read: the job's number is a line of digits, perhaps with the name of the
// cluster, and each task is a line of squeue in a format that is given. A job that squeue does not know any more has
// ended; accounting is not needed. Options of the user must not replace the ones on which the study relies.
#include "studies/executors/slurm.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <sstream>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/program/file_descriptor.h"
#include "common/program/spawn.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

// The options that the study itself sets, with their short form.
constexpr std::array<std::pair<const char*, const char*>, 8> kOwnOptions{{{"--array", "-a"},
                                                                          {"--output", "-o"},
                                                                          {"--error", "-e"},
                                                                          {"--job-name", "-J"},
                                                                          {"--chdir", "-D"},
                                                                          {"--parsable", "--parsable"},
                                                                          {"--wrap", "--wrap"},
                                                                          {"--wait", "-W"}}};

std::string ReadAllOf(int file)
{
  std::string text;
  char bytes[4096];
  for (;;)
  {
    const ssize_t got = read(file, bytes, sizeof bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(bytes, static_cast<std::size_t>(got));
  }
}

// Returns the output of a command on standard output and standard error. Throws SlurmError if it failed.
std::string OutputOf(const std::vector<std::string>& words)
{
  Pipe output = MakePipe();
  fcntl(output.read.Get(), F_SETFL, 0);
  pid_t process = 0;
  try
  {
    // Ctrl-C must reach only the study, which cancels the job.
    process = Spawn({.words = words, .output = output.write.Get(), .errors = output.write.Get(), .leads_group = true});
  }
  catch (const std::runtime_error& error)
  {
    throw SlurmError(fmt::format("there is no command {} here ({}): install Slurm's client (Debian's slurm-client)",
                                 words[0], error.what()));
  }
  output.write.Reset();
  const std::string text = ReadAllOf(output.read.Get());
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return text;
  throw SlurmError(text.empty() ? fmt::format("{} failed without a word", words[0]) : std::string(TrimBlanks(text)));
}

}  // namespace

bool SlurmTask::HasEnded() const
{
  static constexpr std::array kEnds{"COMPLETED", "CANCELLED", "FAILED",   "TIMEOUT",       "NODE_FAIL",
                                    "PREEMPTED", "BOOT_FAIL", "DEADLINE", "OUT_OF_MEMORY", "REVOKED"};
  return std::any_of(kEnds.begin(), kEnds.end(), [&](const char* end) { return state == end; });
}

std::string SubmitArray(const std::string& script, const std::string& log, std::size_t tasks, unsigned at_a_time,
                        const std::vector<std::string>& options)
{
  std::vector<std::string> words{
      "sbatch",
      "--parsable",
      "--job-name=swarmanoid",
      "--open-mode=append",
      "--output=" + log,
      fmt::format("--array=0-{}{}", tasks - 1, at_a_time == 0 ? "" : fmt::format("%{}", at_a_time))};
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(script);
  // Warnings may precede the number; the name of the cluster follows it.
  std::string job;
  std::istringstream lines(OutputOf(words));
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line.find_first_not_of("0123456789") >= std::min(line.find(';'), line.size()))
      job = line.substr(0, line.find(';'));
  if (job.empty()) throw SlurmError(fmt::format("sbatch named no job: {}", Quoted(lines.str())));
  return job;
}

std::map<std::size_t, SlurmTask> TasksOf(const std::string& job)
{
  std::map<std::size_t, SlurmTask> tasks;
  std::string text;
  try
  {
    text = OutputOf({"squeue", "--noheader", "--array", "--states=all", "--jobs=" + job, "--format=%i|%T|%N|%r"});
  }
  catch (const SlurmError& error)
  {
    if (std::string_view(error.what()).find("Invalid job id") != std::string_view::npos) return tasks;
    throw;
  }
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    std::array<std::string, 4> fields;
    std::istringstream parts(line);
    for (std::string& field : fields) std::getline(parts, field, '|');
    const std::size_t mark = fields[0].find('_');
    const auto number = mark == std::string::npos ? std::nullopt : ParseInteger(fields[0].substr(mark + 1));
    if (number) tasks[static_cast<std::size_t>(*number)] = {fields[1], fields[2], fields[3]};
  }
  return tasks;
}

void CancelJob(const std::string& job) { OutputOf({"scancel", job}); }

std::vector<std::string> SlurmOptions(const std::string& text)
{
  std::vector<std::string> words;
  char quote = 0;
  bool in_word = false;
  for (const char c : text)
  {
    if (quote != 0 ? c == quote : c == '\'' || c == '"')
    {
      quote = quote != 0 ? '\0' : c;
      if (!in_word) words.emplace_back();
      in_word = true;
    }
    else if (quote == 0 && (c == ' ' || c == '\t' || c == '\n'))
    {
      in_word = false;
    }
    else
    {
      if (!in_word) words.emplace_back();
      in_word = true;
      words.back() += c;
    }
  }
  if (quote != 0) throw UsageError(fmt::format("--slurm: a quote is not closed in {}", Quoted(text)));
  for (const std::string& word : words)
    for (const auto& [name, letter] : kOwnOptions)
      if (word == name || word.starts_with(std::string(name) + "=") ||
          (letter[1] != '-' && word.starts_with(letter) && !word.starts_with("--")))
        throw UsageError(
            fmt::format("--slurm: {} is given by the study itself; leave it out{}", Quoted(word),
                        std::string_view(name) == "--array" ? " (--jobs N is the number of tasks at a time)" : ""));
  return words;
}

}  // namespace swarmanoid
