// A program that runs an experiment several times by itself, as searches for the best parameters do.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/core/utility/plugins/dynamic_loading.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>

#include <iostream>

using namespace argos;

namespace
{

void Tell(const char* when)
{
  CSimulator& simulator = CSimulator::GetInstance();
  const auto& robot = *any_cast<CFootBotEntity*>(simulator.GetSpace().GetEntitiesByType("foot-bot")["fb"]);
  std::cout << when << ' ' << simulator.GetSpace().GetSimulationClock() << ' '
            << robot.GetEmbodiedEntity().GetOriginAnchor().Position.GetX() << std::endl;
}

// `seed`: the random seed that is written into the document; nullptr for that of the file.
void Search(const char* file, const char* seed)
{
  std::ofstream log("said.txt");
  LOG.DisableColoredOutput();
  LOG.GetStream().rdbuf(log.rdbuf());
  CSimulator& simulator = CSimulator::GetInstance();
  if (seed == nullptr)
  {
    simulator.SetExperimentFileName(file);
    simulator.LoadExperiment();
  }
  else
  {
    ticpp::Document document(file);
    document.LoadFile();
    TConfigurationNode root = *document.FirstChildElement();
    SetNodeAttribute(GetNode(GetNode(root, "framework"), "experiment"), "random_seed", seed);
    simulator.Load(document);
  }
  int robots = 0;
  simulator.GetLoopFunctions().IterateOverControllableEntities([&](CControllableEntity*) { ++robots; });
  std::cout << "seed " << simulator.GetRandomSeed() << " robots " << robots << std::endl;
  LOG << "loaded " << simulator.GetMaxSimulationClock() << std::endl;
  Tell("loaded");
  simulator.Execute();
  Tell("first");
  for (int trial = 1; trial < 3; ++trial)
  {
    simulator.Reset();
    Tell("reset");
    CLoopFunctions& functions = simulator.GetLoopFunctions();
    auto& gone = dynamic_cast<CFootBotEntity&>(simulator.GetSpace().GetEntity("lua"));
    functions.MoveEntity(gone.GetEmbodiedEntity(), CVector3(1.5, -1.5, 0), CQuaternion());
    simulator.Execute();
    Tell("again");
  }
  simulator.Reset(99);
  simulator.UpdateSpace();
  Tell("one step");
  std::cout << simulator.IsExperimentFinished() << std::endl;
  simulator.Destroy();
  LOG.GetStream().rdbuf(nullptr);
}

}  // namespace

int main(int count, char** words)
{
  try
  {
    for (int i = 1; i < count; ++i)
    {
      const bool has_seed = std::string(words[i]) == "--seed" && i + 2 < count;
      Search(words[has_seed ? i + 2 : i], has_seed ? words[i + 1] : nullptr);
      if (has_seed) i += 2;
    }
  }
  catch (CARGoSException& error)
  {
    DEBUG("%d words\n", count);
    std::cerr << "refused: " << error.what() << std::endl;
    return 1;
  }
  return 0;
}
