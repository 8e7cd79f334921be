// A controller that draws in each of its steps and appends the numbers to a file of its robot: step, tick, numbers.
#include <cstdio>
#include <memory>
#include <string>

#include "ci_controller.h"

class COutsideRandom : public CCI_Controller
{
public:
  int Init(const TConfigurationTree tree) override
  {
    folder_ = tree.GetText("folder");
    Draw("Init");
    return RETURN_OK;
  }
  void ControlStep() override { Draw("ControlStep"); }
  void Destroy() override { Draw("Destroy"); }
  bool HasState() const override { return true; }

private:
  void Draw(const char* step)
  {
    auto& random = GetRobot()->GetRandom();
    const double first = random.Uniform();
    const double second = GetRobot()->GetRandom().Uniform();
    const std::string path = folder_ + "/" + GetRobot()->GetId() + ".txt";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "a"), &std::fclose);
    std::fprintf(file.get(), "%s %llu %a %a\n", step, static_cast<unsigned long long>(GetRobot()->GetTick()), first,
                 second);
  }
  std::string folder_;
};

REGISTER_CONTROLLER(COutsideRandom, "outside_random")
