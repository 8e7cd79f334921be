#include "common/configuration/xml_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

constexpr std::string_view kBlanks = " \t\r\n";

bool IsBlank(char c) { return kBlanks.find(c) != std::string_view::npos; }

// Where a name ends: before a blank, '/', '>', '=' or the end.
std::size_t EndOfName(std::string_view text, std::size_t from)
{
  while (from < text.size() && !IsBlank(text[from]) && text[from] != '/' && text[from] != '>' && text[from] != '=' &&
         text[from] != '<')
  {
    ++from;
  }
  return from;
}

std::size_t SkipBlanks(std::string_view text, std::size_t from)
{
  while (from < text.size() && IsBlank(text[from])) ++from;
  return from;
}

bool IsNameStart(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80U;
}

// "#65" or "#x41", of a character that XML allows.
bool IsCharacterReference(std::string_view name)
{
  const bool hex = name.starts_with("#x");
  const std::string_view digits = name.substr(hex ? 2 : 1);
  unsigned code = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), code, hex ? 16 : 10);
  if (digits.empty() || result.ec != std::errc() || result.ptr != digits.data() + digits.size()) return false;
  const bool blank = code == '\t' || code == '\n' || code == '\r';
  return blank || (code >= 0x20U && code < 0xd800U) || (code >= 0xe000U && code <= 0xfffdU) ||
         (code >= 0x10000U && code <= 0x10ffffU);
}

class Scanner
{
public:
  Scanner(std::string_view text, const LineTable& lines, const XmlLimits& limits)
      : text_(text), lines_(lines), limits_(limits)
  {
  }

  std::optional<XmlMistake> Run()
  {
    while (!mistake_ && at_ < text_.size())
    {
      if (text_[at_] == '<')
      {
        Markup();
      }
      else
      {
        Characters();
      }
    }
    if (!mistake_ && !open_.empty())
    {
      Fail(text_.size(), fmt::format("the file ends within <{}>, which starts in line {}; add </{}>",
                                     NameAt(open_.back()), lines_.Line(open_.back()), NameAt(open_.back())));
    }
    if (!mistake_ && !seen_root_) Fail(text_.size(), "the file holds no element");
    return mistake_;
  }

private:
  std::string NameAt(std::size_t offset) const
  {
    const std::string quoted = Quoted(text_.substr(offset, EndOfName(text_, offset) - offset));
    return quoted.substr(1, quoted.size() - 2);
  }

  void Fail(std::size_t offset, std::string message)
  {
    if (!mistake_) mistake_ = XmlMistake{offset, std::move(message)};
    at_ = text_.size();
  }

  bool SkipTo(std::string_view end, std::string_view what)
  {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string_view::npos)
    {
      Fail(at_, fmt::format("{} does not end; add {}", what, end));
      return false;
    }
    at_ = found + end.size();
    return true;
  }

  void Markup()
  {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("<!--"))
    {
      const std::size_t start = at_;
      at_ += 4;
      if (!SkipTo("-->", "a comment")) mistake_->offset = start;
    }
    else if (rest.starts_with("<![CDATA["))
    {
      if (open_.empty()) return Fail(at_, "there is text outside the root element");
      SkipTo("]]>", "a CDATA section");
    }
    else if (rest.starts_with("<?"))
    {
      SkipTo("?>", "a processing instruction");
    }
    else if (rest.starts_with("<!"))
    {
      Fail(at_, "a document type (<!DOCTYPE …>) and entities of its own are not allowed; remove it");
    }
    else if (rest.starts_with("</"))
    {
      EndTag();
    }
    else
    {
      StartTag();
    }
  }

  void Characters()
  {
    if (text_[at_] == '&') return Entity();
    if (open_.empty() && !IsBlank(text_[at_])) return Fail(at_, "there is text outside the root element");
    ++at_;
  }

  void Entity()
  {
    const std::size_t start = at_;
    if (open_.empty()) return Fail(start, "there is text outside the root element");
    constexpr std::array<std::string_view, 5> kNames{"lt", "gt", "amp", "quot", "apos"};
    const std::size_t end = text_.substr(0, std::min(text_.size(), start + 64)).find(';', start);
    const std::string_view name =
        end == std::string_view::npos ? std::string_view() : text_.substr(start + 1, end - start - 1);
    const std::string written(text_.substr(start, name.size() + 2));
    if (name.starts_with('#'))
    {
      if (!IsCharacterReference(name)) return Fail(start, Quoted(written) + " is no character of XML");
    }
    else if (std::find(kNames.begin(), kNames.end(), name) == kNames.end())
    {
      return Fail(start, name.empty() ? "a bare '&' is not allowed; write &amp;"
                                      : fmt::format("unknown entity {}; allowed: &lt; &gt; &amp; &quot; &apos; &#n;",
                                                    Quoted(written)));
    }
    at_ = end + 1;
  }

  void EndTag()
  {
    const std::size_t start = at_;
    const std::size_t name = at_ + 2;
    at_ = EndOfName(text_, name);
    const std::string_view closed = text_.substr(name, at_ - name);
    at_ = SkipBlanks(text_, at_);
    if (at_ >= text_.size() || text_[at_] != '>') return Fail(start, "an end tag must read </name>");
    ++at_;
    if (open_.empty()) return Fail(start, fmt::format("</{}> closes nothing", NameAt(name)));
    const std::size_t opened = open_.back();
    if (text_.substr(opened, EndOfName(text_, opened) - opened) != closed)
    {
      return Fail(start, fmt::format("</{}> does not match <{}>, which starts in line {} and must be closed first",
                                     NameAt(name), NameAt(opened), lines_.Line(opened)));
    }
    open_.pop_back();
  }

  void StartTag()
  {
    const std::size_t start = at_;
    const std::size_t name = start + 1;
    if (name >= text_.size() || !IsNameStart(text_[name]))
    {
      return Fail(start, "a '<' that starts no element; write &lt; in text");
    }
    if (open_.empty() && seen_root_) return Fail(start, "a second root element; a file holds one");
    seen_root_ = true;
    if (static_cast<int>(open_.size()) >= limits_.depth)
    {
      return Fail(start, fmt::format("elements are nested deeper than {} levels", limits_.depth));
    }
    if (++elements_ > limits_.elements)
    {
      return Fail(start, fmt::format("more than {} elements; use <distribute> for many entities", limits_.elements));
    }
    at_ = EndOfName(text_, name);
    if (!Attributes(name)) return;
    if (text_[at_] == '/')
    {
      if (at_ + 1 >= text_.size() || text_[at_ + 1] != '>') return Fail(at_, "a '/' must be followed by '>'");
      at_ += 2;
      return;
    }
    ++at_;
    open_.push_back(name);
  }

  // Stops at the '/' or '>' that ends the tag.
  bool Attributes(std::size_t element)
  {
    names_.clear();
    while (true)
    {
      at_ = SkipBlanks(text_, at_);
      if (at_ >= text_.size() || text_[at_] == '<')
      {
        Fail(element - 1, fmt::format("the tag <{} does not end; add '>'", NameAt(element)));
        return false;
      }
      if (text_[at_] == '/' || text_[at_] == '>') return true;
      if (!OneAttribute(element)) return false;
    }
  }

  bool OneAttribute(std::size_t element)
  {
    const std::size_t start = at_;
    at_ = EndOfName(text_, start);
    const std::string_view name = text_.substr(start, at_ - start);
    const std::size_t equals = SkipBlanks(text_, at_);
    const std::size_t quote = equals < text_.size() ? SkipBlanks(text_, equals + 1) : text_.size();
    const bool well_formed = !name.empty() && IsNameStart(name[0]) && quote < text_.size() && text_[equals] == '=' &&
                             (text_[quote] == '"' || text_[quote] == '\'');
    const std::size_t end = well_formed ? text_.find(text_[quote], quote + 1) : std::string_view::npos;
    if (end == std::string_view::npos)
    {
      Fail(start, fmt::format("an attribute of <{}> must read name=\"value\"", NameAt(element)));
      return false;
    }
    if (std::find(names_.begin(), names_.end(), name) != names_.end())
    {
      Fail(start, fmt::format("the attribute {} of <{}> is given twice", Quoted(name), NameAt(element)));
      return false;
    }
    names_.push_back(name);
    if (++attributes_ > limits_.attributes || static_cast<int>(names_.size()) > limits_.attributes_of_one)
    {
      Fail(start, fmt::format("too many attributes: at most {} in one element and {} in all", limits_.attributes_of_one,
                              limits_.attributes));
      return false;
    }
    return Value(quote + 1, end);
  }

  bool Value(std::size_t begin, std::size_t end)
  {
    for (at_ = begin; at_ < end;)
    {
      if (text_[at_] == '<')
      {
        Fail(at_, "a '<' within the value of an attribute; write &lt; or close the quotes before");
      }
      else if (text_[at_] == '&')
      {
        open_.push_back(begin);
        Entity();
        open_.pop_back();
      }
      else
      {
        ++at_;
      }
    }
    if (!mistake_) at_ = end + 1;
    return !mistake_;
  }

  std::string_view text_;
  const LineTable& lines_;
  const XmlLimits& limits_;
  std::size_t at_ = 0;
  std::vector<std::size_t> open_;        // offsets of the names of the open elements
  std::vector<std::string_view> names_;  // attributes of the element being read
  std::size_t elements_ = 0;
  std::size_t attributes_ = 0;
  bool seen_root_ = false;
  std::optional<XmlMistake> mistake_;
};

}  // namespace

LineTable::LineTable(std::string_view text) : text_(text), starts_{0}
{
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (text[i] == '\n') starts_.push_back(i + 1);
  }
}

int LineTable::Line(std::size_t offset) const
{
  return static_cast<int>(std::upper_bound(starts_.begin(), starts_.end(), offset) - starts_.begin());
}

int LineTable::Column(std::size_t offset) const
{
  offset = std::min(offset, text_.size());
  const std::size_t start = starts_[static_cast<std::size_t>(Line(offset) - 1)];
  if (last_offset_ < start || last_offset_ > offset)
  {
    last_offset_ = start;
    last_column_ = 1;
  }
  for (; last_offset_ < offset; ++last_offset_)
  {
    if ((static_cast<unsigned char>(text_[last_offset_]) & 0xC0U) != 0x80U) ++last_column_;
  }
  return last_column_;
}

std::optional<XmlMistake> ScanXml(std::string_view text, const LineTable& lines, const XmlLimits& limits)
{
  return Scanner(text, lines, limits).Run();
}

std::vector<std::size_t> AttributeOffsets(std::string_view text, std::size_t name)
{
  std::vector<std::size_t> offsets;
  std::size_t at = SkipBlanks(text, EndOfName(text, name));
  while (at < text.size() && text[at] != '>' && text[at] != '/')
  {
    offsets.push_back(at);
    const std::size_t quote = text.find_first_of("\"'", at);
    const std::size_t end = quote == std::string_view::npos ? quote : text.find(text[quote], quote + 1);
    if (end == std::string_view::npos) break;
    at = SkipBlanks(text, end + 1);
  }
  return offsets;
}

}  // namespace swarmanoid
