// A user's file keeps its comments, order and blanks when the editor changes a value, so the text is not written again
// from a tree. Each change becomes a list of places in the text, with what replaces each. New elements take the
// indentation and the line ends of their neighbours.
//
// Invariants: the edits of a list ascend and do not overlap; WithEdits followed by the edits of Inverse gives the same
// bytes again, which is how EditedText takes back changes.
#include "common/configuration/xml_edit.h"

#include <algorithm>
#include <stdexcept>

#include "common/configuration/xml_writer.h"

namespace swarmanoid
{
namespace
{

constexpr std::string_view kXmlBlanks = " \t\r\n";
constexpr std::string_view kIndent = "  ";

bool HasOnlyBlanks(std::string_view text) { return text.find_first_not_of(kXmlBlanks) == std::string_view::npos; }

// Returns the text for use within quotes of either kind.
std::string InAttribute(std::string_view value)
{
  std::string text;
  for (const char c : EscapedAttribute(value)) text += c == '\'' ? "&apos;" : std::string(1, c);
  return text;
}

// Returns the bytes from the start of its line to a place, if they are blank; otherwise nothing.
std::string IndentBefore(std::string_view text, std::size_t place)
{
  const std::size_t line = text.substr(0, place).rfind('\n');
  const std::size_t begin = line == std::string_view::npos ? 0 : line + 1;
  const std::string_view before = text.substr(begin, place - begin);
  return HasOnlyBlanks(before) ? std::string(before) : std::string();
}

bool BeginsLine(std::string_view text, std::size_t place)
{
  const std::size_t line = text.substr(0, place).rfind('\n');
  return line != std::string_view::npos && HasOnlyBlanks(text.substr(line + 1, place - line - 1));
}

std::string LineEndOf(std::string_view text)
{
  const std::size_t line = text.find('\n');
  return line != std::string_view::npos && line > 0 && text[line - 1] == '\r' ? "\r\n" : "\n";
}

// Returns the text of an element without children, in pieces between its comments, without blanks at both ends of the
// whole.
std::vector<TextSpan> RunsOf(std::string_view text, const XmlElement& element)
{
  std::vector<TextSpan> runs;
  std::size_t begin = element.content.begin;
  for (const TextSpan& note : element.notes)
  {
    runs.push_back({begin, note.begin});
    begin = note.end;
  }
  runs.push_back({begin, element.content.end});
  std::erase_if(runs, [&](const TextSpan& run) { return HasOnlyBlanks(run.Of(text)); });
  for (TextSpan& run : runs)
  {
    const std::string_view words = run.Of(text);
    run = {run.begin + words.find_first_not_of(kXmlBlanks), run.begin + words.find_last_not_of(kXmlBlanks) + 1};
  }
  return runs;
}

// Returns the "/>" of <name/>.
TextSpan SlashOf(const XmlElement& element) { return {element.whole.end - 2, element.whole.end}; }

bool HoldsAValue(const XmlElement& element) { return element.attributes.empty() && element.children.empty(); }

TextEdits SetText(std::string_view text, const XmlElement& element, const std::string& value)
{
  const std::string written = EscapedXml(value);
  if (element.HasNoEndTag())
  {
    return {{SlashOf(element), ">" + written + "</" + element.name + ">"}};
  }
  const std::vector<TextSpan> runs = RunsOf(text, element);
  if (runs.empty()) return {{{element.content.begin, element.content.begin}, written}};
  TextEdits edits{{runs.front(), written}};
  for (std::size_t i = 1; i < runs.size(); ++i) edits.push_back({runs[i], ""});
  return edits;
}

TextEdits AddAttribute(const XmlElement& element, const std::string& name, const std::string& value)
{
  std::size_t place = element.start.begin + 1 + element.name.size();
  if (!element.attributes.empty()) place = element.attributes.back().whole.end;
  return {{{place, place}, " " + name + "=\"" + InAttribute(value) + "\""}};
}

}  // namespace

std::string WithEdits(std::string_view text, const TextEdits& edits)
{
  std::string made;
  std::size_t place = 0;
  for (const TextEdit& edit : edits)
  {
    if (edit.span.begin < place || edit.span.end < edit.span.begin || edit.span.end > text.size())
      throw std::logic_error("edits of a text overlap, or leave it");
    made += text.substr(place, edit.span.begin - place);
    made += edit.text;
    place = edit.span.end;
  }
  made += text.substr(place);
  return made;
}

bool HasValuesAsElements(const XmlElement& element) { return std::ranges::any_of(element.children, HoldsAValue); }

TextEdits SetValue(std::string_view text, const XmlElement& element, const std::string& name, const std::string& value)
{
  if (const XmlElement::Attribute* attribute = element.FindAttribute(name))
    return {{attribute->value, InAttribute(value)}};
  if (const XmlElement* child = element.FindChild(name)) return SetText(text, *child, value);
  if (!HasValuesAsElements(element)) return AddAttribute(element, name, value);
  return AppendChild(text, element, "<" + name + ">" + EscapedXml(value) + "</" + name + ">");
}

TextEdits DropValue(std::string_view text, const XmlElement& element, std::string_view name)
{
  if (const XmlElement::Attribute* attribute = element.FindAttribute(name))
  {
    const std::size_t before = text.substr(0, attribute->whole.begin).find_last_not_of(kXmlBlanks) + 1;
    return {{{before, attribute->whole.end}, ""}};
  }
  const XmlElement* child = element.FindChild(name);
  return child == nullptr ? TextEdits{} : RemoveElement(text, *child);
}

std::string TextOf(const NewElement& element, std::string_view indent, std::string_view line_end)
{
  std::string text = "<" + element.tag;
  std::string children;
  for (const auto& [name, value] : element.values)
    if (!element.as_elements || name == "id")
      text += " " + name + "=\"" + InAttribute(value) + "\"";
    else
      children.append(line_end).append(indent).append(kIndent).append("<" + name + ">" + EscapedXml(value) + "</" +
                                                                      name + ">");
  if (children.empty()) return text + "/>";
  return text + ">" + children + std::string(line_end) + std::string(indent) + "</" + element.tag + ">";
}

InsertionPlace PlaceForChild(std::string_view text, const XmlElement& parent)
{
  InsertionPlace place{"", LineEndOf(text)};
  if (!parent.children.empty() && BeginsLine(text, parent.children.back().whole.begin))
    place.indent = IndentBefore(text, parent.children.back().whole.begin);
  else
    place.indent = IndentBefore(text, parent.whole.begin) + std::string(kIndent);
  return place;
}

TextEdits AppendChild(std::string_view text, const XmlElement& parent, const std::string& child)
{
  const InsertionPlace place = PlaceForChild(text, parent);
  const std::string line = place.line_end + place.indent + child;
  const std::string last_line = place.line_end + IndentBefore(text, parent.whole.begin);
  if (parent.HasNoEndTag())
  {
    return {{SlashOf(parent), ">" + line + last_line + "</" + parent.name + ">"}};
  }
  if (parent.children.empty() && HasOnlyBlanks(parent.content.Of(text))) return {{parent.content, line + last_line}};
  // The new text follows the last child or comment; the text after it stays.
  std::size_t end = parent.content.begin;
  if (!parent.children.empty()) end = parent.children.back().whole.end;
  if (!parent.notes.empty()) end = std::max(end, parent.notes.back().end);
  const bool in_lines = parent.children.empty() || BeginsLine(text, parent.children.back().whole.begin);
  if (!in_lines) return {{{end, end}, child}};
  const bool closes_line = text.substr(end, parent.content.end - end).find('\n') != std::string_view::npos;
  return {{{end, end}, closes_line ? line : line + last_line}};
}

TextEdits RemoveElement(std::string_view text, const XmlElement& element)
{
  const TextSpan& whole = element.whole;
  const std::size_t rest = text.find_first_not_of(" \t\r", whole.end);
  const bool ends_line = rest != std::string_view::npos && text[rest] == '\n';
  if (!ends_line || !BeginsLine(text, whole.begin)) return {{whole, ""}};
  return {{{text.substr(0, whole.begin).rfind('\n') + 1, rest + 1}, ""}};
}

TextEdits EditedText::Inverse(const TextEdits& edits) const
{
  TextEdits inverse;
  std::size_t grown = 0, shrunk = 0;
  for (const TextEdit& edit : edits)
  {
    const std::size_t begin = edit.span.begin + grown - shrunk;
    inverse.push_back({{begin, begin + edit.text.size()}, std::string(edit.span.Of(text_))});
    grown += edit.text.size();
    shrunk += edit.span.end - edit.span.begin;
  }
  return inverse;
}

void EditedText::Apply(const TextEdits& edits, const std::string& name)
{
  std::string text = WithEdits(text_, edits);
  if (text == text_) return;
  done_.push_back({Inverse(edits), name});
  undone_.clear();
  text_ = std::move(text);
  ++revision_;
}

bool EditedText::Move(std::vector<Change>& from, std::vector<Change>& to)
{
  if (from.empty()) return false;
  const Change change = std::move(from.back());
  from.pop_back();
  to.push_back({Inverse(change.edits), change.name});
  text_ = WithEdits(text_, change.edits);
  ++revision_;
  return true;
}

}  // namespace swarmanoid
