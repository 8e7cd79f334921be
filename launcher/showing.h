// Shows an experiment to a user at a terminal who asked for no visualisation: on a page in the browser if there is a
// display, otherwise as a picture and a film. The experiment is run again for that, in a process of its own, with the
// same bits. So the run itself is not slowed. The commands `demo` and `run` use it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

enum class ShowingKind
{
  kPage,        // the address of the page is printed
  kOpenedPage,  // the page is also opened in the browser
  kFilm
};

// Returns a page if this session has a display or names a browser, otherwise a film.
ShowingKind KindForSession();
// Returns true if standard output and error are a terminal.
bool IsAtTerminal();
// Opens an address in the browser of the desktop. Without a desktop it does nothing, and the user has the printed
// address.
void OpenInBrowser(const std::string& url);
// Returns true if a visualisation of the experiment draws pictures.
bool HasPictures(const Experiment& experiment);

// Returns the path relative to the current folder if the file is in it, otherwise the path unchanged.
std::string ShortPath(const std::string& path);

// Returns the experiment with the visualisations of `kinds`, such as "web" or "opengl". `with_own`: beside its own
// ones, otherwise instead of them. Throws UsageError if there is no such renderer.
std::unique_ptr<Experiment> WithShown(const Experiment& experiment, const std::vector<std::string>& kinds,
                                      bool with_own);
// Returns the text with the visualisation in the place of its own ones.
std::string WithVisualisation(const std::string& effective_xml, const std::string& element);

// Returns the number of ticks of a film that is made within some seconds: fewer ticks for more robots, and never more
// than `ran` (0: unknown).
std::uint64_t TicksOfFilm(const Experiment& experiment, std::uint64_t ran);

// Shows the experiment, with files in `folder`, which must exist. Prints on standard error where to look. Returns the
// exit code of the process when the film is written, the run has ended, or the user closed the page by Ctrl-C.
int Show(const Experiment& experiment, ShowingKind kind, const std::string& folder, std::uint64_t ran = 0);

}  // namespace swarmanoid
