#include "space_server/event_log.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "common/configuration/output_file.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/errors/print_error.h"
#include "common/messages/control_verbs.h"
#include "common/program/csv.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30U;
constexpr std::string_view kHeader = "tick,request,entity,numbers,from,number,when,check";
constexpr std::size_t kFewestFields = 4;
constexpr std::size_t kMostFields = 8;

// Returns the last field of a line: the checksum of the text before it.
std::string CheckOf(std::string_view line) { return fmt::format("{:08x}", XXH32(line.data(), line.size(), 0)); }

// Returns true for the header. If the header has a checksum column, other lines must have that field too, possibly
// empty.
bool IsHeader(const std::string& line, int number, std::size_t& fewest)
{
  if (number != 1 || !line.starts_with("tick,")) return false;
  if (line == kHeader) fewest = kMostFields;
  return true;
}

// Returns the mistake of a line, or an empty text. The line must have at least `fewest` fields. A line that a user
// wrote has no checksum.
std::string MistakeOfLine(const std::string& line, const std::vector<std::string>& fields, std::size_t fewest)
{
  if (fields.size() < fewest || fields.size() > kMostFields)
    return fmt::format("{} is no event; a line is {}", Quoted(line), kHeader);
  if (fields.size() < kMostFields || fields.back().empty()) return {};
  if (fields.back() == CheckOf(std::string_view(line).substr(0, line.rfind(',')))) return {};
  return fmt::format(
      "{} does not fit its checksum: it was damaged, or changed by hand; correct it and empty its "
      "last field",
      Quoted(line));
}

// Returns what can be known to be wrong before the run; the pose itself is checked when the entity is moved there.
std::string EntityError(const ControlOrder& order, const Experiment& experiment)
{
  const auto* const id = order.Find<std::string>("entity");
  if (id == nullptr) return {};
  const auto entity = std::ranges::find(experiment.entities, *id, &EntityConfiguration::id);
  if (entity == experiment.entities.end())
    return fmt::format("the experiment has no entity {}; repeat the events of a run of the same file", Quoted(*id));
  const bool moves = order.verb != "select";
  return moves && !entity->movable ? fmt::format("{} cannot move", Quoted(*id)) : std::string();
}

std::string NowInUtc()
{
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32] = {};
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

// Sets the sender from the text that AskerOf makes.
void SetAsker(ControlRequestMessage& request, const std::string& asker)
{
  const std::size_t at = asker.find('@');
  request.user = at == std::string::npos ? std::string() : asker.substr(0, at);
  request.client = at == std::string::npos ? asker : asker.substr(at + 1);
}

std::optional<std::uint64_t> WholeNumber(std::string_view text)
{
  std::uint64_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

// Returns the position of an incomplete last line. Runs end each line, so only files of runs can have one. Files of
// users may lack the last line end.
std::size_t CutShortAt(std::string_view text)
{
  if (text.empty() || text.back() == '\n' || !text.starts_with("tick,")) return text.size();
  return text.rfind('\n') + 1;
}

std::string ReadEventFile(const std::string& path)
{
  try
  {
    return ReadRegularFile(path, kMostBytes);
  }
  catch (const FileError& error)
  {
    throw ConfigurationError(fmt::format("cannot read the events '{}': {}", path, error.what()));
  }
}

std::string ReadWithoutCutLine(const std::string& path)
{
  std::string text = ReadEventFile(path);
  const std::size_t end = CutShortAt(text);
  if (end != text.size())
    PrintError("{}:{}: note: the last line was cut short, and is left out: {}\n", path,
               1 + std::count(text.begin(), text.end(), '\n'), Quoted(text.substr(end)));
  text.resize(end);
  return text;
}

bool IsRepeated(const ControlVerb& verb) { return verb.IsRepeated(); }

// Lines with an unwanted verb may come from another version, so only the verb is read.
std::vector<RecordedEvent> ParseAll(const std::string& text, const std::string& path, const Experiment& experiment,
                                    bool (*wanted)(const ControlVerb&))
{
  std::istringstream file(text);
  const auto name = std::make_shared<const std::string>(path);
  std::vector<RecordedEvent> events;
  std::string line;
  std::size_t fewest = kFewestFields;
  std::uint64_t last = 0;
  for (int number = 1; std::getline(file, line); ++number)
  {
    RecordedEvent event;
    event.location = {name, number, 0};
    if (line.ends_with('\r')) line.pop_back();
    if (IsHeader(line, number, fewest) || line.empty()) continue;
    const std::vector<std::string> fields = CsvFields(line);
    if (const std::string mistake = MistakeOfLine(line, fields, fewest); !mistake.empty())
      throw ConfigurationError(event.location, mistake);

    const auto tick = WholeNumber(fields[0]);
    if (!tick) throw ConfigurationError(event.location, fmt::format("{} is no tick", Quoted(fields[0])));
    event.tick = *tick;
    if (event.tick < last)
      throw ConfigurationError(event.location,
                               fmt::format("tick {} comes after tick {}; events stand in order", event.tick, last));
    last = event.tick;
    const ControlVerb* const verb = FindControlVerb(fields[1], Asker::kNobody);
    if (verb == nullptr) throw ConfigurationError(event.location, NoVerbText(fields[1], Asker::kMember));
    if (!wanted(*verb)) continue;
    try
    {
      static_cast<ControlOrder&>(event.request) = OrderOf(*verb, {fields[2], fields[3]});
    }
    catch (const std::invalid_argument& error)
    {
      throw ConfigurationError(event.location, error.what());
    }
    if (verb->IsRepeated())
      if (const std::string error = EntityError(event.request, experiment); !error.empty())
        throw ConfigurationError(event.location, error);
    if (fields.size() > 4) SetAsker(event.request, fields[4]);
    if (fields.size() > 5 && !fields[5].empty())
    {
      const auto request_number = WholeNumber(fields[5]);
      if (!request_number || *request_number > UINT32_MAX)
        throw ConfigurationError(event.location, fmt::format("{} is no number of a request", Quoted(fields[5])));
      event.request.number = static_cast<std::uint32_t>(*request_number);
    }
    events.push_back(std::move(event));
  }
  return events;
}

std::string WholeLines(const std::string& path)
{
  std::error_code none;
  if (!std::filesystem::exists(path, none)) return {};
  std::string text = ReadEventFile(path);
  const std::size_t end = text.rfind('\n') + 1;
  if (end == text.size()) return text;
  std::filesystem::resize_file(path, end);
  text.resize(end);
  return text;
}

void AddFault(std::vector<RecordedFault>& faults, const RecordedEvent& event, const Experiment& experiment)
{
  const auto entity =
      std::ranges::find(experiment.entities, event.request.Get<std::string>("entity"), &EntityConfiguration::id);
  if (entity == experiment.entities.end()) return;
  // The text begins with the name of the controller: "controller 'c' threw an exception: the text of it".
  const std::string asker = AskerOf(event.request);
  const std::size_t id_end = asker.find("' ");
  if (id_end == std::string::npos) return;
  const std::string_view what = std::string_view(asker).substr(id_end + 2);
  for (const FaultKind kind : {FaultKind::kThrew, FaultKind::kDied, FaultKind::kTooSlow})
    if (what.starts_with(FaultText(kind)))
      faults.push_back({event.tick, static_cast<std::uint32_t>(entity - experiment.entities.begin()), kind});
}

}  // namespace

ControlRequestMessage NoteOf(const std::string& verb, const std::string& about, const std::string& from)
{
  ControlRequestMessage note{ControlOrder{verb}};
  if (!about.empty()) note.Set(FindControlVerb(verb, Asker::kNobody)->parameters.front().name, about);
  note.client = from;
  return note;
}

std::string AskerOf(const ControlRequestMessage& request)
{
  return request.user.empty() ? request.client : request.user + "@" + request.client;
}

std::vector<RecordedEvent> ReadEvents(const std::string& path, const Experiment& experiment)
{
  return ParseEvents(ReadWithoutCutLine(path), path, experiment);
}

EventLines ReadEventLines(const std::string& path)
{
  EventLines events;
  if (!std::filesystem::exists(path)) return events;
  std::istringstream file(ReadWithoutCutLine(path));
  std::string line;
  std::size_t fewest = kFewestFields;
  for (int number = 1; std::getline(file, line); ++number)
  {
    if (line.ends_with('\r')) line.pop_back();
    if (IsHeader(line, number, fewest) || line.empty()) continue;
    const std::vector<std::string> fields = CsvFields(line);
    const auto tick = WholeNumber(fields.empty() ? std::string_view() : std::string_view(fields[0]));
    std::string mistake = MistakeOfLine(line, fields, fewest);
    if (mistake.empty() && !tick) mistake = fmt::format("{} is no event; a line is {}", Quoted(line), kHeader);
    if (mistake.empty())
      events.lines.push_back({*tick, line});
    else
      events.damaged.push_back(fmt::format("{}:{}: {}", path, number, mistake));
  }
  return events;
}

std::vector<RecordedEvent> ParseEvents(const std::string& text, const std::string& path, const Experiment& experiment)
{
  return ParseAll(text, path, experiment, IsRepeated);
}

EarlierRequests ReadEarlierRequests(const std::string& path, const Experiment& experiment,
                                    std::optional<std::uint64_t> pause_at)
{
  EarlierRequests earlier;
  earlier.pause_at = pause_at;
  std::vector<RecordedEvent> events = ParseAll(WholeLines(path), path, experiment, [](const auto&) { return true; });
  for (RecordedEvent& event : events)
  {
    const ControlRequestMessage& request = event.request;
    const Effect effect = FindControlVerb(request.verb, Asker::kNobody)->effect;
    earlier.until = event.tick;
    if (request.verb == kFailedController) AddFault(earlier.failed, event, experiment);
    if (request.verb == "share") earlier.grants.push_back(request);
    if (request.verb == "revoke")
      std::erase_if(earlier.grants, [&](const ControlOrder& grant)
                    { return grant.Get<std::string>("grant") == request.Get<std::string>("grant"); });
    if (effect == Effect::kNote || effect == Effect::kAccess) continue;
    event.logged = true;
    earlier.answered.push_back(request);
    if (request.verb == "speed") earlier.speed = request.Get<double>("factor");
    if (request.verb == "pause" || request.verb == "resume" || request.verb == "step") earlier.step.reset();
    if (request.verb == "resume") earlier.pause_at.reset();
    if (request.verb == "pause") earlier.pause_at = event.tick;
    if (request.verb != "step") continue;
    earlier.step = request;
    earlier.pause_at = event.tick + static_cast<std::uint64_t>(request.Get<std::int64_t>("ticks", 1));
  }
  std::erase_if(events, [](const RecordedEvent& event)
                { return !FindControlVerb(event.request.verb, Asker::kNobody)->IsRepeated(); });
  earlier.changes = std::move(events);
  return earlier;
}

void AddUndone(std::vector<RecordedEvent>& done, const std::vector<RecordedEvent>& repeated)
{
  std::size_t next = 0;
  for (const RecordedEvent& event : repeated)
  {
    const auto same = std::find_if(done.begin() + static_cast<std::ptrdiff_t>(next), done.end(),
                                   [&](const RecordedEvent& other)
                                   {
                                     return other.logged && other.tick == event.tick &&
                                            static_cast<const ControlOrder&>(other.request) == event.request;
                                   });
    if (same == done.end())
      done.push_back(event);
    else
      next = static_cast<std::size_t>(same - done.begin()) + 1;
  }
  std::stable_sort(done.begin(), done.end(),
                   [](const RecordedEvent& a, const RecordedEvent& b) { return a.tick < b.tick; });
}

EventLog::~EventLog()
{
  if (file_ != nullptr) std::fclose(file_);
}

void EventLog::Write(std::uint64_t tick, const ControlRequestMessage& request)
{
  if (path_.empty()) return;
  if (file_ == nullptr)
  {
    goes_on_ = goes_on_ && std::filesystem::exists(path_);
    file_ = OpenOutputFile(path_, goes_on_);
    if (file_ != nullptr && !goes_on_) fmt::print(file_, "{}\n", kHeader);
  }
  bool good = file_ != nullptr;
  if (good)
  {
    const OrderColumns columns = ColumnsOf(request);
    const std::string line =
        fmt::format("{},{},{},{},{},{},{}", tick, request.verb, CsvField(columns.entity), CsvField(columns.numbers),
                    CsvField(AskerOf(request)), request.number,
                    request.user.empty() && request.verb != kRefusedMessage ? std::string() : NowInUtc());
    fmt::print(file_, "{},{}\n", line, CheckOf(line));
    good = std::fflush(file_) == 0;
  }
  if (!good) throw std::runtime_error(fmt::format("cannot write the events to '{}': {}", path_, std::strerror(errno)));
}

}  // namespace swarmanoid
