// The text of --help: purpose, usage and examples first, then the arguments, options and commands in groups, wrapped to
// the width of the terminal. Every program uses it.
#pragma once

#include <memory>
#include <string>
#include <utility>

namespace CLI
{
class FormatterBase;
}

namespace swarmanoid
{

std::shared_ptr<CLI::FormatterBase> MakeHelpFormatter();

// Splits a footer into the notes and the examples, which follow the line "Examples:".
std::pair<std::string, std::string> SplitFooter(const std::string& footer);

// Breaks the lines of `text` at blanks, so that none is longer than `width` characters if it can be broken. Lines that
// begin with a blank are not broken.
std::string Wrapped(const std::string& text, std::size_t width);

}  // namespace swarmanoid
