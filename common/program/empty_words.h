// Refuses empty words on a command line: they name no file, run, entity or kind, and mostly come from a variable of a
// shell that is not set. RunProgram applies it to every option of every program.
#pragma once

namespace CLI
{
class App;
class Option;
}  // namespace CLI

namespace swarmanoid
{

// Lets the option have an empty value. Call it before RefuseEmptyWords.
void AllowEmpty(CLI::Option& option);

// Makes an empty value throw UsageError, with the name of the option, when the command line is parsed.
void RefuseEmptyWords(CLI::App& app);

}  // namespace swarmanoid
