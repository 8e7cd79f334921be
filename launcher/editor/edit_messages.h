// The JSON between `swarmanoid edit` and its pages; docs/edit.md is its specification.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/editor/edited_experiment.h"

namespace swarmanoid
{

// A request, as far as it is for all verbs; what an edit changes is read by CarryOut.
struct EditRequest
{
  std::string verb;            // "document", "form", "edit", "undo", "redo", "save", "reload", "check"
  ElementPath path;            // of a form
  std::uint64_t revision = 0;  // of the text that an edit is meant for
  bool anyway = false;         // of a save
  std::string text;            // the whole
};

// Throws std::invalid_argument, with a text for the user, for anything else than a request.
EditRequest ParseEditRequest(std::string_view text);
// Carries out the change of an "edit". Returns the path of an added element, or an empty path. Throws
// std::invalid_argument.
ElementPath CarryOut(const EditRequest& request, EditedExperiment& experiment);

struct DocumentState
{
  std::string file;
  bool is_saved = true;
  bool changed_on_disk = false;
  std::string hidden;                  // why the picture is older than the text
  const ElementPath* added = nullptr;  // by the change that led here
  bool is_checking = false;
  const std::string* checked = nullptr;  // what a check of this text said; empty: all is well
};
// "document": what there is to say of the text after each change.
std::string DocumentText(const EditedExperiment& experiment, const DocumentState& state);
// Returns the answer to "form": the values of an element, and its possible children.
std::string FormText(const EditedExperiment& experiment, const ElementPath& path);

}  // namespace swarmanoid
