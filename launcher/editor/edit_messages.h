// `swarmanoid edit` and its pages exchange these JSON messages. docs/edit.md specifies them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/editor/edited_experiment.h"
#include "launcher/editor/edited_run.h"
#include "launcher/editor/edited_scripts.h"

namespace swarmanoid
{

// The part of a request that all verbs have. CarryOut reads the change of an edit.
struct EditRequest
{
  // "document", "form", "edit", "undo", "redo", "save", "reload", "check", "run", "end_run", "script", "save_script"
  std::string verb;
  ElementPath path;            // for "form": the element
  std::uint64_t revision = 0;  // the revision of the text that an edit was made on
  bool anyway = false;         // for "save" and "save_script": even if the file has changed on disk
  std::string file;            // for "script" and "save_script": the script
  std::string content;         // for "save_script": its text
  EditedRun::Pace pace;        // for "run"
  std::string text;            // the whole request
};

// Throws std::invalid_argument, with a text for the user, if the text is no request.
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
  const ElementPath* added = nullptr;  // the element that the last change added
  bool is_checking = false;
  const std::string* checked = nullptr;  // the output of a check of this text; empty: no mistakes
  std::vector<ControllerScript> scripts{};
  const EditedRun* run = nullptr;
};
// Returns the message "document": the state of the text after each change.
std::string DocumentText(const EditedExperiment& experiment, const DocumentState& state);
// Returns the answer to "script" and "save_script". Throws std::invalid_argument if the text is no UTF-8.
std::string ScriptText(const std::string& file, const std::string& content);
// Returns the answer to "form": the values of an element, and its possible children.
std::string FormText(const EditedExperiment& experiment, const ElementPath& path);

}  // namespace swarmanoid
