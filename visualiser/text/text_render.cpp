// A table is collected as one text and written at once, so that readers never see half of it. Each cell is appended in
// place, and then mended for the format only if it has a character that needs quotes or escapes.
#include "visualiser/text/text_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/configuration/wording.h"
#include "common/math/elementary.h"
#include "common/plugin_descriptions/renderers.h"
#include "common/program/csv.h"
#include "common/program/standard_output.h"
#include "common/space/space.h"
#include "visualiser/status_line.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::ordered_json;

std::vector<std::string> SplitList(const std::string& text)
{
  std::vector<std::string> items;
  std::size_t start = 0;
  while (start <= text.size())
  {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string_view item = TrimBlanks(std::string_view(text).substr(start, end - start));
    if (!item.empty()) items.emplace_back(item);
    start = end + 1;
  }
  return items;
}

std::string TextOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// JSON has no number for infinity or NaN.
Json NumberOf(const std::string& text)
{
  Json number = Json::parse(text, nullptr, false);
  return number.is_discarded() ? Json(nullptr) : number;
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Returns whether a character needs no quotes or escapes in any format.
bool IsPlain(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\' && c != ','; }

}  // namespace

PluginDescription CTextRender::Description() { return TextRenderDescription(); }

CTextRender::~CTextRender()
{
  if (file_ != nullptr && file_ != stdout) std::fclose(file_);
}

void CTextRender::Init(const RenderSetup& setup)
{
  const Parameters& parameters = setup.parameters;
  space_ = &setup.space;
  assignment_ = &setup.assignment;
  monitor_ = setup.monitor;
  shows_status_ = parameters.Boolean("status") && monitor_ != nullptr;
  precision_ = static_cast<int>(parameters.Integer("precision"));
  every_ = static_cast<std::uint64_t>(parameters.Integer("every"));
  const std::string format = parameters.Text("format");
  format_ = format == "csv"    ? Format::kCsv
            : format == "tsv"  ? Format::kTsv
            : format == "json" ? Format::kJson
                               : Format::kTable;
  columns_ = Columns();
  ChooseColumns(parameters.Text("columns"), parameters.Tree().ValueLocation("columns"));
  ChooseEntities(parameters.Text("entities"), parameters.Tree().ValueLocation("entities"));

  WatchShownRobots();
  if (shows_status_) monitor_->Status();

  const std::string file = parameters.Text("file");
  if (file.empty())
  {
    file_ = stdout;
  }
  else
  {
    path_ = setup.MakeOutputFile("file");
    file_ = std::fopen(path_.c_str(), "w");
    if (file_ == nullptr)
      throw std::runtime_error("text_render: cannot write '" + path_ + "': " + std::strerror(errno));
  }
  AppendHeader();
}

void CTextRender::Draw()
{
  // An attached renderer does not see every tick. A table is due once a new period has begun since the last table.
  const std::uint64_t tick = space_->GetTick();
  const std::uint64_t period = tick / every_;
  const bool due = period_ ? period != *period_ : tick % every_ == 0;
  period_ = period;
  is_left_out_ = !due && tick != space_->GetExperiment().max_clock;
  if (is_left_out_) return;
  AppendTable();
  Write();
}

void CTextRender::Idle()
{
  // A paused run draws no further tables, so the status in the latest table would stay wrong.
  if (told_phase_ && monitor_->Status().phase != *told_phase_)
  {
    AppendStatus();
    Write();
  }
  if (!reader_has_gone_) std::fflush(file_);
}

void CTextRender::Finish()
{
  // A run may end before its last tick.
  if (is_left_out_) AppendTable();
  is_left_out_ = false;
  Write();
  if (!reader_has_gone_ && std::fflush(file_) != 0) FailToWrite();
}

std::vector<CTextRender::Column> CTextRender::Columns() const
{
  const auto position = [this](int axis)
  {
    return [this, axis](const CSwarmanoidSpaceEntity& e, std::string& line)
    { AppendNumber(e.GetPosition()[axis], line); };
  };
  const auto angle = [this](double EulerAngles::*member)
  {
    return [this, member](const CSwarmanoidSpaceEntity& e, std::string& line)
    { AppendNumber(RadiansToDegrees(EulerFromQuaternion(e.GetOrientation()).*member), line); };
  };
  return {{"clock", true,
           [this](const CSwarmanoidSpaceEntity&, std::string& line) { line += std::to_string(space_->GetTick()); }},
          {"Entity type", false,
           [](const CSwarmanoidSpaceEntity& e, std::string& line) { line += TableName(e.GetKind()); }},
          {"Entity id", false, [](const CSwarmanoidSpaceEntity& e, std::string& line) { line += e.GetId(); }},
          {"X", true, position(0)},
          {"Y", true, position(1)},
          {"Z", true, position(2)},
          {"Alpha", true, angle(&EulerAngles::alpha)},
          {"Beta", true, angle(&EulerAngles::beta)},
          {"Gamma", true, angle(&EulerAngles::gamma)},
          {"Engine", false,
           [this](const CSwarmanoidSpaceEntity& e, std::string& line)
           {
             const int engine = space_->EngineOf(e.GetIndex(), assignment_->owner);
             if (engine >= 0) line += space_->GetExperiment().engines[static_cast<std::size_t>(engine)].id;
           },
           false},
          {"Host", false,
           [this](const CSwarmanoidSpaceEntity& e, std::string& line)
           {
             const int host = assignment_->host[e.GetIndex()];
             if (host >= 0) line += std::to_string(host);
           },
           false},
          {"State", false,
           [this](const CSwarmanoidSpaceEntity& e, std::string& line)
           {
             const RobotStatus* robot = monitor_ == nullptr ? nullptr : monitor_->Robot(e.GetIndex());
             if (robot != nullptr) line += robot->state.empty() ? robot->text : robot->state;
           },
           false}};
}

bool CTextRender::IsShown(const CSwarmanoidSpaceEntity& entity) const
{
  return shown_kinds_[static_cast<std::size_t>(entity.GetKind())] && space_->IsPresent(entity.GetIndex());
}

void CTextRender::AppendNumber(double value, std::string& line) const
{
  char text[400];  // the largest number has 309 digits
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, precision_).ptr;
  std::string_view number(text, static_cast<std::size_t>(end - text));
  if (number.find('.') != std::string_view::npos)
  {
    number = number.substr(0, number.find_last_not_of('0') + 1);
    if (number.ends_with('.')) number.remove_suffix(1);
  }
  line += number == "-0" ? "0" : number;
}

void CTextRender::ChooseColumns(const std::string& names, const SourceLocation& location)
{
  std::vector<Column> chosen;
  if (names.empty())
    std::copy_if(columns_.begin(), columns_.end(), std::back_inserter(chosen),
                 [](const Column& column) { return column.by_default; });
  for (const std::string& name : SplitList(names))
  {
    const auto column =
        std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.title == name; });
    if (column == columns_.end())
    {
      std::string known;
      for (const Column& c : columns_) known += (known.empty() ? "" : ", ") + c.title;
      throw ConfigurationError(location, "there is no column '" + name + "'; the columns are " + known);
    }
    chosen.push_back(*column);
  }
  columns_ = std::move(chosen);
}

void CTextRender::ChooseEntities(const std::string& kinds, const SourceLocation& location)
{
  shown_kinds_.assign(EntityKindCount(), kinds.empty());
  for (const std::string& name : SplitList(kinds))
  {
    bool found = false;
    std::string known;
    for (std::size_t k = 0; k < EntityKindCount(); ++k)
    {
      const std::string_view tag = TagName(static_cast<EntityKind>(k));
      known += (known.empty() ? "" : ", ") + std::string(tag);
      if (tag == name) shown_kinds_[k] = found = true;
    }
    if (!found) throw ConfigurationError(location, "there are no entities '" + name + "'; allowed are " + known);
  }
}

// The column State needs the status of every robot that has a line.
void CTextRender::WatchShownRobots()
{
  const auto is_state = [](const Column& column) { return column.title == "State"; };
  if (monitor_ == nullptr || std::none_of(columns_.begin(), columns_.end(), is_state)) return;
  std::vector<std::uint32_t> robots;
  for (std::size_t i = 0; i < space_->Size(); ++i)
    if (assignment_->host[i] >= 0 && IsShown(space_->GetEntity(i))) robots.push_back(static_cast<std::uint32_t>(i));
  monitor_->Watch(robots);
}

void CTextRender::AppendStatus()
{
  const RunStatus& status = monitor_->Status();
  told_phase_ = status.phase;
  if (format_ != Format::kJson)
  {
    buffer_ += "# " + StatusLine(status) + "\n";
    return;
  }
  std::string factor;
  AppendNumber(status.real_time_factor, factor);
  Json late = Json::array();
  for (const ProcessStatus& process : status.processes)
    if (process.late_s > 0) late.push_back(process.name);
  const Json line{{"tick", status.tick},
                  {"phase", PhaseName(status.phase)},
                  {"real_time_factor", NumberOf(factor)},
                  {"late", late}};
  buffer_ += TextOf(line) + '\n';
}

void CTextRender::AppendTable()
{
  if (shows_status_) AppendStatus();
  for (std::size_t i = 0; i < space_->Size(); ++i)
    if (IsShown(space_->GetEntity(i))) AppendLine(space_->GetEntity(i));
}

void CTextRender::AppendHeader()
{
  if (format_ == Format::kJson)
  {
    for (const Column& column : columns_) keys_.push_back(TextOf(column.title));
    return;
  }
  const char separator = format_ == Format::kCsv ? ',' : '\t';
  if (format_ == Format::kTable) buffer_ += "#\t";
  for (std::size_t c = 0; c < columns_.size(); ++c)
  {
    if (c > 0) buffer_ += separator;
    buffer_ += format_ == Format::kCsv ? CsvField(columns_[c].title) : columns_[c].title;
  }
  buffer_ += '\n';
}

void CTextRender::AppendLine(const CSwarmanoidSpaceEntity& entity)
{
  const bool json = format_ == Format::kJson;
  const char separator = format_ == Format::kTable || format_ == Format::kTsv ? '\t' : ',';
  if (json) buffer_ += '{';
  for (std::size_t c = 0; c < columns_.size(); ++c)
  {
    if (c > 0) buffer_ += separator;
    // The line follows figure 3.11 of the report: it has one field more than the titles: the one under #.
    if (c == 1 && format_ == Format::kTable) buffer_ += separator;
    if (json) buffer_.append(keys_[c]).append(columns_[c].is_number ? ":" : ":\"");
    const std::size_t start = buffer_.size();
    columns_[c].append(entity, buffer_);
    MendCell(start, columns_[c].is_number);
    if (json && !columns_[c].is_number) buffer_ += '"';
  }
  buffer_ += json ? "}\n" : "\n";
}

// Nearly all cells need no change.
void CTextRender::MendCell(std::size_t start, bool is_number)
{
  const std::string_view cell = std::string_view(buffer_).substr(start);
  if (is_number && !cell.empty() && IsDigit(cell.back()) && cell.find(',') == std::string_view::npos) return;
  if (!(is_number && format_ == Format::kJson) && std::all_of(cell.begin(), cell.end(), IsPlain)) return;
  std::string mended(cell);
  if (format_ == Format::kTable || format_ == Format::kTsv)
    std::replace_if(
        mended.begin(), mended.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  else if (format_ == Format::kCsv)
    mended = CsvField(cell);
  else if (is_number)
    mended = TextOf(NumberOf(mended));
  else
  {
    mended = TextOf(mended);
    mended = mended.substr(1, mended.size() - 2);
  }
  buffer_.replace(start, std::string::npos, mended);
}

// A reader that closes the pipe, such as `head`, has seen enough. That ends the watching, and is no error.
void CTextRender::FailToWrite()
{
  if (file_ != stdout || errno != EPIPE)
    throw std::runtime_error(fmt::format("text_render: cannot write {}: {}",
                                         path_.empty() ? "to standard output" : Quoted(path_), std::strerror(errno)));
  reader_has_gone_ = true;
  ReaderOfOutputHasGone();
}

void CTextRender::Write()
{
  if (buffer_.empty() || reader_has_gone_) return;
  const std::size_t written = std::fwrite(buffer_.data(), 1, buffer_.size(), file_);
  if (written != buffer_.size() || (file_ == stdout && std::fflush(file_) != 0)) FailToWrite();
  buffer_.clear();
}

}  // namespace swarmanoid
