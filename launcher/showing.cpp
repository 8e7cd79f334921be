#include "launcher/showing.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ranges>
#include <thread>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_writer.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/experiment/load_experiment.h"
#include "common/plugins/catalogue.h"
#include "common/program/usage_error.h"
#include "launcher/system/command_process.h"
#include "launcher/system/installation.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr double kRobotTicks = 3e5;  // the most robot ticks of a film: it takes some seconds in the slowest engine
constexpr std::uint64_t kFewestTicks = 100;
constexpr std::uint64_t kMostPictures = 100;
constexpr double kPicturesPerSecond = 20;

std::size_t Robots(const Experiment& experiment)
{
  return static_cast<std::size_t>(
      std::ranges::count_if(experiment.entities, [](const auto& entity) { return IsRobot(entity.kind); }));
}

// Returns where a helper process that draws no page writes its errors: the terminal, where it shows its progress, too;
// otherwise a file.
std::string ErrorsOf(std::vector<std::string>& words, const fs::path& folder)
{
  if (isatty(STDERR_FILENO) == 1) return "/dev/stderr";
  words.emplace_back("--quiet");
  return folder / "shown.log";
}

// Returns the ticks until the experiment ends by itself, or 0 if a film is shorter.
std::uint64_t LengthOf(const Experiment& experiment, const fs::path& folder)
{
  const fs::path file = folder / "shown.xml", output = folder / "shown";
  std::ofstream(file) << experiment.effective_xml;
  const std::string most = std::to_string(TicksOfFilm(experiment, 0));
  std::vector<std::string> words{OwnProgram(), "run",      file,  "--single-process", "--no-visualisers", "--ticks",
                                 most,         "--output", output};
  const int exit_code = CommandProcess(words, ErrorsOf(words, folder)).Wait();
  const bool ended = exit_code == kExitDone || exit_code == kExitExperimentFailed;
  const std::uint64_t ticks = ended ? ReadManifest(output).value("ticks", std::uint64_t{0}) : 0;
  fs::remove_all(output);
  return ticks;
}

}  // namespace

ShowingKind KindForSession()
{
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "BROWSER"})
    if (const char* value = std::getenv(name); value != nullptr && *value != '\0') return ShowingKind::kPage;
  return ShowingKind::kFilm;
}

bool IsAtTerminal() { return isatty(STDOUT_FILENO) == 1 && isatty(STDERR_FILENO) == 1; }

void OpenInBrowser(const std::string& url)
{
  if (!url.starts_with("http://") && !url.starts_with("https://")) return;
  try
  {
    CommandProcess({"xdg-open", url}, "/dev/null").Wait();
  }
  catch (const std::runtime_error&)
  {
  }
}

bool HasPictures(const Experiment& experiment)
{
  return std::ranges::any_of(experiment.visualisations,
                             [](const RenderConfiguration& render) { return render.tag != "text_render"; });
}

std::string ShortPath(const std::string& path)
{
  const std::string near = fs::proximate(path).string();
  return near.starts_with("..") ? path : near;
}

std::string WithVisualisation(const std::string& effective_xml, const std::string& element)
{
  const std::string start = "<visualisations", end = "</visualisations>", last = "</ahss-config>";
  const std::string section = "  <visualisations>\n    " + element + "\n  </visualisations>\n";
  std::string text = effective_xml;
  if (const std::size_t from = text.find(start); from != std::string::npos)
  {
    const std::size_t closed = text.find('>', from);
    const std::size_t to = text[closed - 1] == '/' ? closed + 1 : text.find(end, from) + end.size();
    text.erase(from, to - from);
  }
  return text.insert(text.rfind(last), section);
}

std::unique_ptr<Experiment> WithShown(const Experiment& experiment, const std::vector<std::string>& kinds,
                                      bool with_own)
{
  const std::vector<std::string> known = PluginCatalogue::Instance().Labels(PluginKind::kRenderer);
  std::string text = experiment.effective_xml;
  for (std::size_t k = 0; k < kinds.size(); ++k)
  {
    const std::vector<std::string> words = SplitWords(kinds[k]);
    const std::string kind = words.empty() ? "" : words.front();
    const std::string tag = kind.ends_with("_render") ? kind : kind + "_render";
    if (std::ranges::find(known, tag) == known.end())
      throw UsageError(fmt::format("--show: there is no renderer {}; there are {}", Quoted(tag), Listed(known)));
    std::string parameters;
    for (const std::string& word : words | std::views::drop(1))
    {
      const std::size_t sign = word.find('=');
      if (sign == 0 || sign == std::string::npos)
        throw UsageError(fmt::format("--show: {} of '{}' must be NAME=VALUE, as in --show \"image video=film.webm\"",
                                     Quoted(word), kinds[k]));
      parameters += fmt::format(" {}=\"{}\"", word.substr(0, sign), EscapedAttribute(word.substr(sign + 1)));
    }
    if (tag == "web_render" && parameters.find(" allow_control=") == std::string::npos)
      parameters += " allow_control=\"true\"";
    const std::string element =
        fmt::format("<{} id=\"shown{}\"{}/>", tag, k == 0 ? "" : fmt::format("_{}", k + 1), parameters);
    const std::size_t end = text.find("</visualisations>");
    if (end != std::string::npos && (with_own || k > 0))
      text.insert(end, "  " + element + "\n  ");
    else
      text = WithVisualisation(text, element);
  }
  LoadedExperiment loaded = LoadExperimentText(text, experiment.name + ".xml", experiment.folder);
  if (loaded.experiment) return std::move(loaded.experiment);
  throw UsageError("--show: " + loaded.errors.front().Text());
}

std::uint64_t TicksOfFilm(const Experiment& experiment, std::uint64_t ran)
{
  const double robots = static_cast<double>(std::max<std::size_t>(Robots(experiment), 1));
  const std::uint64_t most = std::max(static_cast<std::uint64_t>(kRobotTicks / robots), kFewestTicks);
  const std::uint64_t length = ran > 0 ? ran : experiment.max_clock;
  return length > 0 ? std::min(length, most) : most;
}

int Show(const Experiment& experiment, ShowingKind kind, const std::string& folder, std::uint64_t ran)
{
  const fs::path file = fs::path(folder) / "shown.xml", output = fs::path(folder) / "shown";
  const fs::path complaints = fs::path(folder) / "shown.log";
  std::string element = R"(<web_render id="shown" allow_control="true"/>)";
  std::vector<std::string> words{OwnProgram(), "run", file, "--single-process", "--output", output};
  if (kind != ShowingKind::kFilm)
  {
    words.insert(words.end(), {"--quiet", "--real-time", "1"});
  }
  else
  {
    PrintError("Drawing a picture and a film …\n");
    const std::uint64_t ticks = TicksOfFilm(experiment, ran > 0 ? ran : LengthOf(experiment, folder));
    const std::uint64_t every = (ticks + kMostPictures - 1) / kMostPictures;
    const double speed = static_cast<double>(every) * experiment.TickSeconds() * kPicturesPerSecond;
    // Shadows would double the time.
    element = fmt::format(
        R"(<image_render id="film" size="640, 480" every="{}" speed="{}" video="film.mp4" use_shadows="false"/>)"
        R"(<image_render id="picture" every="{}" file="picture.png"/>)",
        every, speed, every * (kMostPictures / 10));
    words.insert(words.end(), {"--ticks", std::to_string(ticks)});
  }
  std::ofstream(file) << WithVisualisation(experiment.effective_xml, element);

  const std::string errors = kind == ShowingKind::kFilm ? ErrorsOf(words, folder) : complaints.string();
  const InterruptsLeftToHelper interrupts;
  CommandProcess child(words, errors);
  if (kind != ShowingKind::kFilm)
  {
    const fs::path url = output / "web_render.url";
    while (!child.Ended() && FirstLineOf(url).empty()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (!child.Ended())
    {
      PrintError("Watch it: {}    (Ctrl-C ends it)\n", FirstLineOf(url));
      if (kind == ShowingKind::kOpenedPage) OpenInBrowser(FirstLineOf(url));
    }
  }
  const int exit_code = child.Wait();
  std::error_code none;
  for (const char* name : {"picture.png", "film.mp4"})
    if (fs::exists(output / name, none))
    {
      fs::rename(output / name, fs::path(folder) / name);
      PrintError("{} {}\n", name[0] == 'p' ? "Picture:" : "Film:   ", ShortPath(fs::path(folder) / name));
    }
  const std::string complaint = FirstLineOf(complaints);
  const bool good = exit_code == kExitDone || exit_code == kExitExperimentFailed || exit_code == kExitInterrupted;
  if (!good) PrintError("It cannot be shown: {}\n", complaint.empty() ? "its process failed" : complaint);
  fs::remove_all(output, none);
  fs::remove(file, none);
  fs::remove(complaints, none);
  return good ? static_cast<int>(kExitDone) : exit_code;
}

}  // namespace swarmanoid
