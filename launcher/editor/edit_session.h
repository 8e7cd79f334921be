// EditSession: the requests of pages about an edited experiment, and the messages to them, as JSON (docs/edit.md).
// Pages get the document after each change, the form of an element, and the start state. `swarmanoid edit` uses it.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "launcher/editor/edit_messages.h"
#include "launcher/editor/edited_experiment.h"
#include "launcher/editor/edited_file.h"
#include "launcher/editor/edited_run.h"
#include "launcher/editor/edited_scripts.h"
#include "launcher/system/command_process.h"
#include "launcher/system/scratch_folder.h"
#include "visualiser/editor_page.h"

namespace swarmanoid
{

class EditSession : public EditorRequests
{
public:
  // Throws ConfigurationError if the file cannot be edited. The page must outlive the session.
  EditSession(const std::string& file, EditorPage& page);

  // Sends the page everything, once it is open.
  void Begin();
  std::string Carry(std::string_view request) override;
  // Looks at the file on disk, the running check and the run. Call it from time to time.
  void Idle();
  bool IsSaved() const { return experiment_.Text() == file_.Text(); }
  const EditedExperiment& GetExperiment() const { return experiment_; }

private:
  using Clock = std::chrono::steady_clock;

  void Save(bool anyway);
  void Reload();
  void StartCheck();
  void FinishCheck();
  void Run(const EditRequest& request);
  std::vector<ControllerScript> Scripts() const;
  void Show();
  void Tell();

  EditorPage& page_;
  EditedFile file_;
  EditedExperiment experiment_;
  ElementPath added_;           // the element that the last change added
  std::uint64_t added_in_ = 0;  // the revision that it was added in
  bool changed_on_disk_ = false;
  Clock::time_point disk_due_;

  std::string hidden_;  // why the picture is an older one; empty if it is the newest
  ScratchFolder scratch_;
  std::unique_ptr<CommandProcess> check_;
  std::string checked_;           // the output of the last check
  std::uint64_t checked_in_ = 0;  // the revision that was checked
  EditedScripts scripts_;
  EditedRun run_{scratch_.Path()};
};

}  // namespace swarmanoid
