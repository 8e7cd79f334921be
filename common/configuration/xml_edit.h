// Changes XML text and leaves every other byte as it is: comments, order, blanks and quotes stay as the user wrote
// them. Each function returns the pieces of text to replace. EditedText applies them and takes them back. `swarmanoid
// edit` uses it.
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
  TextSpan span;     // the text that is replaced
  std::string text;  // the new text
};
using TextEdits = std::vector<TextEdit>;  // ascending and without overlaps

// Returns the edited text. Throws std::logic_error if they overlap or leave the text.
std::string WithEdits(std::string_view text, const TextEdits& edits);

// Sets a parameter of an element, in the form in which it exists (attribute or child element). A new parameter gets the
// form of the element's other values. Comments within a child element stay.
TextEdits SetValue(std::string_view text, const XmlElement& element, const std::string& name, const std::string& value);
// Removes a parameter in either form. Returns no edits if it does not exist.
TextEdits DropValue(std::string_view text, const XmlElement& element, std::string_view name);

// A new element, with its values as attributes or as child elements.
struct NewElement
{
  std::string tag;
  std::vector<std::pair<std::string, std::string>> values;
  bool as_elements = false;  // the form of the values; an id is always an attribute
};
// Returns the text of the element. `indent` precedes its further lines.
std::string TextOf(const NewElement& element, std::string_view indent, std::string_view line_end);

// New children of an element are written with this layout.
struct InsertionPlace
{
  std::string indent;    // indent of the children
  std::string line_end;  // "\n" or "\r\n", as the text has them
};
InsertionPlace PlaceForChild(std::string_view text, const XmlElement& parent);
// Adds text behind the last child: one or several elements. The first line has no indent; the further lines have
// theirs.
TextEdits AppendChild(std::string_view text, const XmlElement& parent, const std::string& child);

// Removes the element, with its line if nothing else is on it.
TextEdits RemoveElement(std::string_view text, const XmlElement& element);

// Returns whether an element has a value as a child element, such as <position>1, 2, 0</position>.
bool HasValuesAsElements(const XmlElement& element);

// The text with its history of changes. The `name` of a change is for users: "move fb_1".
class EditedText
{
public:
  explicit EditedText(std::string text) : text_(std::move(text)) {}

  const std::string& Text() const { return text_; }
  // Returns a number that differs after each change.
  std::uint64_t Revision() const { return revision_; }
  void Apply(const TextEdits& edits, const std::string& name);
  // Returns the last change, and the last one taken back; nullptr if none exists.
  const std::string* UndoName() const { return done_.empty() ? nullptr : &done_.back().name; }
  const std::string* RedoName() const { return undone_.empty() ? nullptr : &undone_.back().name; }
  // Returns false if there is nothing to undo.
  bool Undo() { return Move(done_, undone_); }
  bool Redo() { return Move(undone_, done_); }

private:
  struct Change
  {
    TextEdits edits;  // edits that lead away from the present text
    std::string name;
  };
  // Returns the edits that undo these edits after they are applied.
  TextEdits Inverse(const TextEdits& edits) const;
  bool Move(std::vector<Change>& from, std::vector<Change>& to);

  std::string text_;
  std::uint64_t revision_ = 1;
  std::vector<Change> done_, undone_;
};

}  // namespace swarmanoid
