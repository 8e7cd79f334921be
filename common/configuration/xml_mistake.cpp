// The parser reports an error code and an offset, which often lies behind the mistake. This file scans the text of the
// refused markup again from its start, and chooses the first rule of XML 1.0 that it breaks. The result is the position
// of the mistake and its cure.
#include "common/configuration/xml_mistake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

constexpr auto kNone = std::string_view::npos;
constexpr std::string_view kWhiteSpace = " \t\r\n";
constexpr std::string_view kEndsOfNames = " \t\r\n/>=<";

std::size_t Find(std::string_view text, std::string_view any_of, std::size_t from)
{
  return std::min(text.find_first_of(any_of, from), text.size());
}

std::size_t SkipBlanks(std::string_view text, std::size_t from)
{
  return std::min(text.find_first_not_of(kWhiteSpace, from), text.size());
}

// An attribute from the first letter of its name to its closing quote, or to the end of the text.
struct AttributeText
{
  std::size_t name_end;
  std::size_t value;  // the offset behind the opening quote; kNone without one
  std::size_t close;  // the closing quote; kNone without one
};

AttributeText AttributeAt(std::string_view text, std::size_t start)
{
  const std::size_t name_end = Find(text, kEndsOfNames, start);
  const std::size_t equals = SkipBlanks(text, name_end);
  const std::size_t quote = SkipBlanks(text, equals + 1);
  const bool is_quoted = quote < text.size() && text[equals] == '=' && (text[quote] == '"' || text[quote] == '\'');
  if (name_end == start || !is_quoted) return {name_end, kNone, kNone};
  return {name_end, quote + 1, text.find(text[quote], quote + 1)};
}

// Returns the name that starts at `name`, as errors show it without quotes.
std::string ShownName(std::string_view text, std::size_t name)
{
  const std::string quoted = Quoted(text.substr(name, Find(text, kEndsOfNames, name) - name));
  return quoted.substr(1, quoted.size() - 2);
}

// Returns whether the parser accepts the character at an offset as text.
bool IsCharacter(std::string_view text, std::size_t offset)
{
  const auto first = static_cast<unsigned char>(text[offset]);
  if (first < 0x80) return first >= 0x20 || kWhiteSpace.find(text[offset]) != kNone;
  std::size_t end = offset + 1;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
  const std::string alone = fmt::format("<a>{}</a>", text.substr(offset, end - offset));
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate("UTF-8"), XML_ParserFree);
  return parser && XML_Parse(parser.get(), alone.data(), static_cast<int>(alone.size()), 1) == XML_STATUS_OK;
}

class Explanation
{
public:
  Explanation(std::string_view text, const XmlRefusal& refusal) : text_(text), refusal_(refusal) {}

  XmlMistake Mistake() const
  {
    switch (refusal_.error)
    {
      case XML_ERROR_NO_ELEMENTS:
        return EndOfFile();
      case XML_ERROR_TAG_MISMATCH:
        return Mismatch();
      case XML_ERROR_DUPLICATE_ATTRIBUTE:
        return {refusal_.offset, fmt::format("the attribute {} of <{}> is given twice", Quoted(NameAt(refusal_.offset)),
                                             ShownName(text_, refusal_.markup + 1))};
      case XML_ERROR_UNDEFINED_ENTITY:
        return UnknownEntity();
      case XML_ERROR_BAD_CHAR_REF:
        return Reference(refusal_.offset);
      case XML_ERROR_UNCLOSED_CDATA_SECTION:
        return {refusal_.section, "a CDATA section does not end; add ]]>"};
      case XML_ERROR_XML_DECL:
        return {refusal_.markup, "an XML declaration must read <?xml version=\"1.0\" encoding=\"UTF-8\"?>"};
      case XML_ERROR_MISPLACED_XML_PI:
        return Misplaced();
      default:
        return Syntax();
    }
  }

private:
  std::string_view NameAt(std::size_t offset) const
  {
    return text_.substr(offset, Find(text_, kEndsOfNames, offset) - offset);
  }
  bool IsCutOff() const { return refusal_.error == XML_ERROR_UNCLOSED_TOKEN; }
  XmlMistake TextOutside(std::size_t offset) const { return {offset, "there is text outside the root element"}; }

  XmlMistake EndOfFile() const
  {
    if (refusal_.open.empty()) return {text_.size(), "the file holds no element"};
    const std::size_t open = refusal_.open.back();
    return {text_.size(), fmt::format("the file ends within <{0}>, which starts in line {1}; add </{0}>",
                                      ShownName(text_, open + 1), refusal_.line(open))};
  }

  XmlMistake Mismatch() const
  {
    const std::size_t open = refusal_.open.back();
    return {refusal_.markup,
            fmt::format("</{}> does not match <{}>, which starts in line {} and must be closed first",
                        ShownName(text_, refusal_.markup + 2), ShownName(text_, open + 1), refusal_.line(open))};
  }

  XmlMistake Misplaced() const
  {
    return {refusal_.offset, "an XML declaration (<?xml …?>) must be the first of the file; remove what is before it"};
  }

  // For a mistake within an attribute, the parser reports only the tag.
  XmlMistake UnknownEntity() const
  {
    std::size_t at = text_.find('&', refusal_.offset);
    while (IsAllowed(at)) at = text_.find('&', at + 1);
    return Reference(at);
  }

  bool IsAllowed(std::size_t ampersand) const
  {
    constexpr std::array<std::string_view, 6> kAllowed{"&lt;", "&gt;", "&amp;", "&quot;", "&apos;", "&#"};
    const std::string_view rest = text_.substr(ampersand);
    return std::any_of(kAllowed.begin(), kAllowed.end(), [&](std::string_view one) { return rest.starts_with(one); });
  }

  XmlMistake Reference(std::size_t ampersand) const
  {
    constexpr std::size_t kLongest = 64;
    const std::string_view rest = text_.substr(ampersand, kLongest);
    const std::size_t end = rest.find(';');
    if (end == kNone || end == 1) return {ampersand, "a bare '&' is not allowed; write &amp;"};
    const std::string written = Quoted(rest.substr(0, end + 1));
    if (rest[1] == '#') return {ampersand, written + " is no character of XML"};
    return {ampersand, fmt::format("unknown entity {}; allowed: &lt; &gt; &amp; &quot; &apos; &#n;", written)};
  }

  XmlMistake Syntax() const
  {
    const std::size_t offset = refusal_.offset;
    if (offset < text_.size() && !IsCharacter(text_, offset))
    {
      const bool is_utf8 = text_.substr(offset).starts_with("\xef\xbf");
      return {offset, is_utf8 ? "a character that XML does not allow; remove it"
                              : "a byte that is not UTF-8 text; save the file as UTF-8"};
    }
    const std::size_t start = refusal_.markup;
    const std::string_view markup = text_.substr(start);
    if (!markup.starts_with('<')) return Characters();
    if (markup.starts_with("<!--"))
    {
      if (IsCutOff()) return {start, "a comment does not end; add -->"};
      return {offset - 2, "'--' is not allowed within a comment; write one '-', or '- -'"};
    }
    if (markup.starts_with("<![CDATA[") && refusal_.open.empty()) return TextOutside(start);
    if (markup.starts_with("<!"))
      return {start, "a document type (<!DOCTYPE …>) and entities of its own are not allowed; remove it"};
    if (markup.starts_with("<?"))
    {
      if (IsCutOff()) return {start, "a processing instruction does not end; add ?>"};
      return {start, "a processing instruction must read <?name …?>"};
    }
    if (markup.starts_with("</"))
    {
      if (!refusal_.open.empty()) return {start, "an end tag must read </name>"};
      return {start, fmt::format("</{}> closes nothing", ShownName(text_, start + 2))};
    }
    if (refusal_.error == XML_ERROR_JUNK_AFTER_DOC_ELEMENT) return {start, "a second root element; a file holds one"};
    return StartTag();
  }

  XmlMistake Characters() const
  {
    const std::size_t start = refusal_.markup;
    if (refusal_.open.empty()) return TextOutside(SkipBlanks(text_, start));
    if (text_[start] == '&') return Reference(start);
    return {refusal_.offset - 2, "']]>' is not allowed in text; write ]]&gt;"};
  }

  XmlMistake StartTag() const
  {
    const std::size_t start = refusal_.markup;
    const std::size_t offset = IsCutOff() ? text_.size() : refusal_.offset;
    const std::size_t name_end = Find(text_, kEndsOfNames, start + 1);
    if (offset <= start + 1) return {start, "a '<' that starts no element; write &lt; in text"};
    if (offset < name_end) return NoName(start + 1);

    const std::string element = ShownName(text_, start + 1);
    std::size_t at = SkipBlanks(text_, name_end);
    while (at < offset && text_[at] != '/')
    {
      const AttributeText attribute = AttributeAt(text_, at);
      if (offset < attribute.name_end) return NoName(at);
      if (attribute.close == kNone || offset < attribute.value)
        return {at, fmt::format("an attribute of <{}> must read name=\"value\"", element)};
      if (offset <= attribute.close) return Value(offset);
      at = SkipBlanks(text_, attribute.close + 1);
    }
    if (at < offset) return {at, "a '/' must be followed by '>'"};
    if (at >= text_.size() || text_[at] == '<')
      return {start, fmt::format("the tag <{} does not end; add '>'", element)};
    if (at > name_end && kWhiteSpace.find(text_[at - 1]) == kNone)
      return {at, fmt::format("a blank must stand between the attributes of <{}>", element)};
    return {at, fmt::format("an attribute of <{}> must read name=\"value\"", element)};
  }

  XmlMistake NoName(std::size_t name) const
  {
    return {name, fmt::format("{} is no name; names have letters, digits, '_', '-', '.' and ':', and start with a "
                              "letter or '_'",
                              Quoted(NameAt(name)))};
  }

  XmlMistake Value(std::size_t offset) const
  {
    if (text_[offset] == '<')
      return {offset, "a '<' within the value of an attribute; write &lt; or close the quotes before"};
    return Reference(text_.rfind('&', offset));
  }

  std::string_view text_;
  const XmlRefusal& refusal_;
};

}  // namespace

XmlMistake ExplainRefusal(std::string_view text, const XmlRefusal& refusal)
{
  return Explanation(text, refusal).Mistake();
}

std::vector<std::size_t> AttributeOffsets(std::string_view text, std::size_t tag)
{
  std::vector<std::size_t> offsets;
  std::size_t at = SkipBlanks(text, Find(text, kEndsOfNames, tag + 1));
  while (at < text.size() && text[at] != '>' && text[at] != '/')
  {
    offsets.push_back(at);
    const AttributeText attribute = AttributeAt(text, at);
    if (attribute.close == kNone) break;
    at = SkipBlanks(text, attribute.close + 1);
  }
  return offsets;
}

}  // namespace swarmanoid
