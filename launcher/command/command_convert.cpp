// `swarmanoid convert`: an experiment of ARGoS3 as one of ours.
#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "argos3/converter/convert.h"
#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/experiment/foreign_experiments.h"
#include "launcher/argos3_dry_run.h"
#include "launcher/command/sub_command.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

int Convert(const std::string& file, const std::string& output)
{
  try
  {
    const auto root = ReadExperimentXml(ReadTextFile(file), file);
    if (root->name != "argos-configuration")
      throw ConfigurationError(root->location,
                               "the root element is <" + root->name + ">; that of ARGoS3 is <argos-configuration>");
    const ConvertedExperiment converted =
        ConvertArgos3(*root, fs::absolute(file).parent_path().string(), RehearseArgos3);
    PrintNotes(converted.notes);
    for (const Diagnostic& mistake : converted.mistakes) PrintError("{}\n", mistake.Text());
    if (!converted.mistakes.empty()) return kExitInvalidFile;
    const std::string text = WriteXml(*converted.root);
    if (output.empty())
    {
      fmt::print("{}", text);
      return kExitDone;
    }
    std::ofstream stream(output);
    if (!(stream << text).flush())
      throw UsageError("--output: the file '" + output + "' cannot be written: " + std::strerror(errno));
    return kExitDone;
  }
  catch (const ConfigurationError& mistake)
  {
    PrintError("{}\n", mistake.what());
    return kExitInvalidFile;
  }
}

void AddConvertCommand(CLI::App& app, int& exit_code)
{
  ReadArgos3Experiments(RehearseArgos3);
  auto file = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("convert", "Write an experiment of ARGoS3 as one of ours");
  verb->add_option("FILE", *file, "An experiment of ARGoS3")->required();
  verb->add_option("--output", *output, "The file to write; without it the standard output")->type_name("FILE");
  verb->footer(
      "`swarmanoid run` and `check` read such files directly; what is written here is to be changed and kept.\n"
      "Exit codes: 0 written; 3 something in the file has no counterpart, and its place and cure are told.\n"
      "Examples:\n"
      "  swarmanoid convert experiments/foraging.argos > foraging.xml\n"
      "  swarmanoid convert experiments/foraging.argos --output foraging.xml");
  verb->callback([file, output, &exit_code] { exit_code = Convert(*file, *output); });
}

const RegisterSubCommand kConvert(14, AddConvertCommand);

}  // namespace
}  // namespace swarmanoid
