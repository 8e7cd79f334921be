#include "launcher/supervision/manifest_at_death.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string_view>

#include "common/activity/failure_report.h"
#include "common/configuration/utf8.h"

namespace swarmanoid
{

struct ManifestAtDeath::Prepared
{
  std::string text;  // the JSON text without its end
  std::string path;
  std::string draft;
  std::chrono::seconds offset;  // offset of the local time
};

namespace
{

// All functions from here to WriteAtDeath run in signal handlers: no allocation, no locks.
std::atomic<const ManifestAtDeath::Prepared*> current = nullptr;

// It holds a piece of JSON with bounded length.
class JsonPiece
{
public:
  JsonPiece& Add(std::string_view text)
  {
    for (const char c : text)
      if (length_ < text_.size()) text_[length_++] = c;
    return *this;
  }
  JsonPiece& AddNumber(unsigned number, unsigned digits)
  {
    std::array<char, 10> reversed{};
    unsigned count = 0;
    do {
      reversed[count++] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number != 0 || count < digits);
    while (count > 0) Add({&reversed[--count], 1});
    return *this;
  }
  // Invalid UTF-8 becomes a question mark.
  JsonPiece& AddQuoted(std::string_view text)
  {
    Add("\"");
    while (!text.empty())
    {
      const std::size_t size = Utf8Length(text);
      const char first = text.front();
      if (size == 0)
        Add("?");
      else if (first == '"' || first == '\\')
        Add("\\").Add(text.substr(0, 1));
      else if (static_cast<unsigned char>(first) < ' ')
        Add(" ");
      else
        Add(text.substr(0, size));
      text.remove_prefix(size == 0 ? 1 : size);
    }
    return Add("\"");
  }
  std::string_view Text() const { return {text_.data(), length_}; }

private:
  std::array<char, 4096> text_;  // holds a line of a report with each character escaped, and the rest
  std::size_t length_ = 0;
};

// Adds the time in the format of TimeStamp.
void AddTime(JsonPiece& json, std::chrono::seconds offset)
{
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const auto local = std::chrono::sys_seconds(std::chrono::seconds(now.tv_sec)) + offset;
  const auto day = std::chrono::floor<std::chrono::days>(local);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss time(local - day);
  const auto number = [&json](auto value, unsigned digits = 2)
  { json.AddNumber(static_cast<unsigned>(value), digits); };
  json.Add("\"");
  number(static_cast<int>(date.year()), 4);
  json.Add("-");
  number(static_cast<unsigned>(date.month()));
  json.Add("-");
  number(static_cast<unsigned>(date.day()));
  json.Add("T");
  number(time.hours().count());
  json.Add(":");
  number(time.minutes().count());
  json.Add(":");
  number(time.seconds().count());
  json.Add(offset.count() < 0 ? "-" : "+");
  const auto minutes = (offset.count() < 0 ? -offset.count() : offset.count()) / 60;
  number(minutes / 60);
  number(minutes % 60);
  json.Add("\"");
}

void WriteAtDeath(std::string_view line, int exit_code)
{
  const ManifestAtDeath::Prepared* prepared = current.load();
  if (prepared == nullptr) return;
  JsonPiece end;
  end.Add(",\n  \"ended\": ");
  AddTime(end, prepared->offset);
  end.Add(",\n  \"exit_code\": ").AddNumber(static_cast<unsigned>(exit_code), 1);
  if (!line.empty()) end.Add(",\n  \"failure\": ").AddQuoted(line);
  end.Add("\n}\n");
  const int file = open(prepared->draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file < 0) return;
  const bool whole = WriteAll(file, prepared->text) && WriteAll(file, end.Text());
  if (close(file) == 0 && whole)
    rename(prepared->draft.c_str(), prepared->path.c_str());
  else
    unlink(prepared->draft.c_str());
}

std::chrono::seconds LocalOffset()
{
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  return std::chrono::seconds(local.tm_gmtoff);
}

}  // namespace

ManifestAtDeath::ManifestAtDeath(const RunFolder& folder, const Manifest& manifest)
{
  constexpr std::string_view kEnd = "\n}\n";
  std::string text = manifest.Text();
  text.resize(text.size() - kEnd.size());
  const std::string path = folder.File("manifest.json");
  prepared_ = std::make_unique<const Prepared>(Prepared{std::move(text), path, path + ".last", LocalOffset()});
  current = prepared_.get();
  SetLastCall(WriteAtDeath);
}

ManifestAtDeath::~ManifestAtDeath()
{
  SetLastCall(nullptr);
  current = nullptr;
}

}  // namespace swarmanoid
