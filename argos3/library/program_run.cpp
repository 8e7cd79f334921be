// CSimulator of programs that load an experiment and run it themselves, any number of times.
#include <argos3/core/simulator/loop_functions.h>

#include <optional>

#include "argos3/library/running.h"
#include "common/plugins/plugin_library.h"

namespace argos
{
namespace
{

using swarmanoid::argos3::ProgramRun;
using swarmanoid::argos3::Running;
using swarmanoid::argos3::Speaker;
using swarmanoid::argos3::TheRunning;

// Between the steps the program acts as the loop functions, and may change the same things.
struct Program
{
  explicit Program(std::unique_ptr<ProgramRun> loaded) : run(std::move(loaded)) { run->Step(); }
  ~Program()
  {
    speaker.reset();
    TheRunning().editor = nullptr;
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  void Speak()
  {
    TheRunning().editor = &run->Editor();
    speaker.emplace(run->Editor());
  }

  std::unique_ptr<ProgramRun> run;
  std::optional<Speaker> speaker;
};

std::unique_ptr<Program>& TheProgram()
{
  static std::unique_ptr<Program> program;
  return program;
}

Program& Loaded()
{
  if (TheProgram() == nullptr) THROW_ARGOSEXCEPTION("no experiment is loaded; call LoadExperiment() before");
  return *TheProgram();
}

// Converts errors of a run to exceptions that programs of ARGoS3 catch.
template <class Call>
auto Told(Call call)
{
  try
  {
    return call();
  }
  catch (const CARGoSException&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw CARGoSException(error.what());
  }
}

}  // namespace

namespace
{

// Loads a file. If `text` is not nullptr, it is the content of the file.
void LoadText(const std::string& file, const std::string* text)
{
  Running& running = TheRunning();
  if (TheProgram() != nullptr) THROW_ARGOSEXCEPTION("an experiment is loaded; call Destroy() before the next one");
  if (running.editor != nullptr) THROW_ARGOSEXCEPTION("an experiment runs in this process");
  const auto& library = swarmanoid::LoadPluginLibrary("argos3_program", swarmanoid::StandardPluginFolders());
  if (!library.error.empty()) throw CARGoSException(library.error);
  running.is_program = true;
  Told([&] { TheProgram() = std::make_unique<Program>(running.load(file, text)); });
  if (running.stepped != nullptr) return Loaded().Speak();
  TheProgram().reset();
  THROW_ARGOSEXCEPTION("the experiment file '" << file << "' has no <loop_functions>; add them");
}

}  // namespace

void CSimulator::LoadExperiment() { LoadText(experiment_file_, nullptr); }

void CSimulator::Load(ticpp::Document& document)
{
  std::ostringstream text;
  text << *document.FirstChildElement();
  const std::string content = text.str();
  LoadText(document.Value().empty() ? experiment_file_ : document.Value(), &content);
}

void CSimulator::Execute()
{
  Loaded();
  GetLoopFunctions().PreExperiment();
  while (!IsExperimentFinished()) UpdateSpace();
  GetLoopFunctions().PostExperiment();
}

void CSimulator::UpdateSpace()
{
  Program& program = Loaded();
  Told(
      [&]
      {
        swarmanoid::argos3::SendWrittenMessages();
        TheRunning().stepped->BeginStep(program.run->Editor());
        program.run->Step();
      });
}

bool CSimulator::IsExperimentFinished() const
{
  Loaded();
  return TheRunning().stepped->IsOver();
}

void CSimulator::Destroy()
{
  if (TheProgram() == nullptr) return;
  Told([] { TheProgram()->run->Finish(); });
  TheProgram().reset();
  TheRunning().is_program = false;
  // The next experiment must draw the same numbers as the first one.
  CRandom::RemoveCategory("argos");
  CRandom::CreateCategory("argos", 0);
}

}  // namespace argos
