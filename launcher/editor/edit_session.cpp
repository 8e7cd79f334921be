#include "launcher/editor/edit_session.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "common/errors/exit_codes.h"
#include "common/experiment/notes.h"
#include "common/messages/assignment.h"
#include "common/space/space.h"
#include "launcher/system/installation.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr auto kDiskPeriod = 1s;

std::string FolderOf(const std::string& file) { return fs::absolute(file).parent_path().lexically_normal().string(); }

}  // namespace

EditSession::EditSession(const std::string& file, EditorPage& page)
    : page_(page), file_(file), experiment_(file_.Text(), file, FolderOf(file))
{
}

void EditSession::Begin()
{
  Show();
  Tell();
}

std::string EditSession::Carry(std::string_view text)
{
  const EditRequest request = ParseEditRequest(text);
  const std::string& verb = request.verb;
  const std::uint64_t before = experiment_.History().Revision();
  if (verb == "document") return {};
  if (verb == "form") return FormText(experiment_, request.path);
  if (verb == "script") return ScriptText(request.file, scripts_.Read(request.file, Scripts()));
  if (verb == "save_script")
  {
    scripts_.Save(request.file, request.content, request.anyway, Scripts());
    return ScriptText(request.file, request.content);
  }
  if (verb == "undo" && !experiment_.Undo()) RefuseEdit("there is nothing to undo");
  if (verb == "redo" && !experiment_.Redo()) RefuseEdit("there is nothing to do again");
  if (verb == "edit")
  {
    if (request.revision != before) RefuseEdit("the experiment has changed meanwhile: look again");
    added_ = CarryOut(request, experiment_);
    added_in_ = added_.empty() ? 0 : experiment_.History().Revision();
  }
  if (verb == "save") Save(request.anyway);
  if (verb == "reload") Reload();
  if (verb == "check") StartCheck();
  if (verb == "run") Run(request);
  if (verb == "end_run") run_.End();
  if (experiment_.History().Revision() != before) Show();
  Tell();
  return {};
}

void EditSession::Save(bool anyway)
{
  changed_on_disk_ = file_.HasChanged();
  if (changed_on_disk_ && !anyway)
  {
    Tell();
    RefuseEdit(fmt::format("not saved: somebody else has changed {}; read it again, or save over it", file_.Path()));
  }
  try
  {
    file_.Write(experiment_.Text());
  }
  catch (const std::runtime_error& error)
  {
    RefuseEdit(error.what());
  }
  changed_on_disk_ = false;
}

void EditSession::Reload()
{
  std::string text;
  try
  {
    text = file_.OnDisk();
  }
  catch (const ConfigurationError& error)
  {
    RefuseEdit(error.what());
  }
  experiment_.Replace(text);
  file_.Accept(text);
  changed_on_disk_ = false;
}

void EditSession::Idle()
{
  if (check_ && check_->Ended()) FinishCheck();
  if (run_.Look())
  {
    page_.ShowRun(run_.Url());
    Tell();
  }
  const Clock::time_point now = Clock::now();
  if (now < disk_due_) return;
  disk_due_ = now + kDiskPeriod;
  const bool was_saved = IsSaved();
  const bool changed = file_.HasChanged();
  if (changed == changed_on_disk_) return;
  changed_on_disk_ = changed;
  try
  {
    // If the user has changed nothing here, the file on disk replaces the text.
    if (changed && was_saved) Reload();
  }
  catch (const std::invalid_argument&)
  {
    // The file is gone or no experiment. The text here stays, and the page says so.
  }
  Show();
  Tell();
}

// ---- the check of a start, as `swarmanoid check` makes it ----

void EditSession::StartCheck()
{
  if (!experiment_.Mistakes().empty() || experiment_.GetExperiment() == nullptr)
    RefuseEdit("mend the mistakes that are listed first");
  check_.reset();
  const fs::path file = fs::path(scratch_.Path()) / "edited.xml";
  std::ofstream(file) << experiment_.GetExperiment()->effective_xml << experiment_.Places();
  checked_in_ = experiment_.History().Revision();
  checked_.clear();
  check_ = std::make_unique<CommandProcess>(std::vector<std::string>{OwnProgram(), "check", file.string()},
                                            (fs::path(scratch_.Path()) / "errors").string());
}

void EditSession::FinishCheck()
{
  const bool good = check_->Wait() == kExitDone;
  check_.reset();
  std::ifstream errors(fs::path(scratch_.Path()) / "errors");
  const std::string said(std::istreambuf_iterator<char>(errors), {});
  checked_ = good ? "" : said.empty() ? "the start failed without a word" : said;
  Tell();
}

// ---- the run ----

void EditSession::Run(const EditRequest& request)
{
  const Experiment* experiment = experiment_.GetExperiment();
  if (!experiment_.Mistakes().empty() || experiment == nullptr) RefuseEdit("mend the mistakes that are listed first");
  try
  {
    run_.Start(experiment->name, experiment->effective_xml + experiment_.Places(), request.pace);
  }
  catch (const std::runtime_error& error)
  {
    RefuseEdit(error.what());
  }
}

std::vector<ControllerScript> EditSession::Scripts() const
{
  return ScriptsOf(experiment_.NodeAt({}), FolderOf(file_.Path()));
}

// ---- what pages are told ----

// Sends the picture of the experiment. No space can be made of some files with mistakes; then the old picture stays.
void EditSession::Show()
{
  hidden_.clear();
  const Experiment* experiment = experiment_.GetExperiment();
  if (experiment == nullptr)
  {
    hidden_ = "the picture is of the last state without mistakes";
    return;
  }
  try
  {
    const CSwarmanoidSpace space(*experiment);
    page_.Show(space, MakeAssignment(*experiment, 1));
  }
  catch (const std::exception& error)
  {
    hidden_ = fmt::format("the picture is an older one: {}", error.what());
  }
}

void EditSession::Tell()
{
  const EditedText& history = experiment_.History();
  DocumentState state;
  state.file = file_.Path();
  state.is_saved = IsSaved();
  state.changed_on_disk = changed_on_disk_;
  state.hidden = hidden_;
  state.added = added_in_ == history.Revision() ? &added_ : nullptr;
  state.is_checking = check_ != nullptr;
  state.checked = checked_in_ == history.Revision() && check_ == nullptr ? &checked_ : nullptr;
  state.scripts = Scripts();
  state.run = &run_;
  page_.Tell(DocumentText(experiment_, state));
}

}  // namespace swarmanoid
