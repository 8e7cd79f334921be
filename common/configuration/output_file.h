// Writes the files of a run, and files that an experiment names. Links in the folder of a run are never followed.
// docs/security.md has the rules.
#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>

namespace swarmanoid
{

// Opens a file of this program for writing, as open() with these flags, but follows no link. Returns -1 with errno
// otherwise.
int OpenOutput(const std::string& path, int flags);
// Opens a file as fopen() does: empties it, or with `appends` writes at its end. Returns nullptr with errno if that
// fails.
std::FILE* OpenOutputFile(const std::string& path, bool appends = false);

// Returns why a folder must not hold the files of a run: it belongs to another user, or all users can put files there.
// The text is empty if the folder may hold them or does not exist.
std::string OutputFolderMistake(const std::string& path);

class OutputFileError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// Lifts the rules for a process that shows a run through a renderer, since the user names its files, not the
// experiment.
void LetUserNameFiles();

// The files that an experiment names. They lie below a folder, and replace only files that this run made. Both rules
// are lifted if the user names the files or trusts the experiment (trust.h). One thread at a time may use it.
class OutputFiles
{
public:
  OutputFiles() = default;
  // `folder`: the start of relative names; empty: the working folder.
  explicit OutputFiles(std::string folder) : folder_(std::move(folder)) {}

  // Checks whether a file of that name may be written. Throws OutputFileError, with the cure, otherwise.
  void Check(const std::string& name) const;
  // Makes the folders of the file and, if it does not exist, the file. Returns its path for writing. Throws as Check
  // does.
  std::string Claim(const std::string& name) const;

private:
  std::string folder_;
};

}  // namespace swarmanoid
