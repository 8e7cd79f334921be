// Changes of XML text that leave every byte alone which they do not name: comments, order, blanks and quotes stay as
// the user wrote them. Each function gives the pieces of text to replace; EditedText applies them, and takes them back.
// Used by `swarmanoid edit`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/configuration/xml_outline.h"

namespace swarmanoid
{

struct TextEdit
{
  TextSpan span;     // what is replaced
  std::string text;  // by what
};
using TextEdits = std::vector<TextEdit>;  // ascending, none overlaps another

// The text with the edits made. Throws std::logic_error if they overlap or leave the text.
std::string WithEdits(std::string_view text, const TextEdits& edits);

// A parameter of an element, where it stands (attribute or child element); one that is not there is added in the form
// that the element's other values have. Comments within a child element stay.
TextEdits SetValue(std::string_view text, const XmlElement& element, const std::string& name, const std::string& value);
// Takes a parameter away, in whichever form it stands; no edits if it is not there.
TextEdits DropValue(std::string_view text, const XmlElement& element, std::string_view name);

// An element to be added: its values as attributes or as child elements.
struct NewElement
{
  std::string tag;
  std::vector<std::pair<std::string, std::string>> values;
  bool as_elements = false;  // of the values; an id is always an attribute
};
std::string TextOf(const NewElement& element, std::string_view indent, std::string_view line_end);

// Puts text (one element or several, in lines whose first is not indented) behind the last child. `inner_indent` is
// what each further line of it gets in front.
struct InsertionPlace
{
  std::string indent;    // of the children
  std::string line_end;  // "\n" or "\r\n", as the text has them
};
InsertionPlace PlaceForChild(std::string_view text, const XmlElement& parent);
TextEdits AppendChild(std::string_view text, const XmlElement& parent, const std::string& child);

// With the line that it has for itself, if it has.
TextEdits RemoveElement(std::string_view text, const XmlElement& element);

// Whether an element has a value as a child element, such as <position>1, 2, 0</position>.
bool HasValuesAsElements(const XmlElement& element);

// Text with its history. `name` of a change is for people: "move fb_1".
class EditedText
{
public:
  explicit EditedText(std::string text) : text_(std::move(text)) {}

  const std::string& Text() const { return text_; }
  // Another number after each change.
  std::uint64_t Revision() const { return revision_; }
  void Apply(const TextEdits& edits, const std::string& name);
  // The last change and the last one taken back; nullptr if there is none.
  const std::string* UndoName() const { return done_.empty() ? nullptr : &done_.back().name; }
  const std::string* RedoName() const { return undone_.empty() ? nullptr : &undone_.back().name; }
  // False if there is nothing to do.
  bool Undo() { return Move(done_, undone_); }
  bool Redo() { return Move(undone_, done_); }

private:
  struct Change
  {
    TextEdits edits;  // that lead away from the present text
    std::string name;
  };
  // The edits that take them back, once they are made.
  TextEdits Inverse(const TextEdits& edits) const;
  bool Move(std::vector<Change>& from, std::vector<Change>& to);

  std::string text_;
  std::uint64_t revision_ = 1;
  std::vector<Change> done_, undone_;
};

}  // namespace swarmanoid
