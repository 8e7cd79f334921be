// Showing an experiment to somebody at a terminal who asked for no visualisation: on a page in the browser if there is
// a display, otherwise as a picture and a film. It is run once more for that, in a process of its own: the same bits,
// and no run is slowed. Used by the commands `demo` and `run`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

enum class ShowingKind
{
  kPage,        // its address is told
  kOpenedPage,  // and given to the browser
  kFilm
};

// The page if this session has a display or names a browser.
ShowingKind KindForSession();
// Whether somebody reads what is written to standard output and error.
bool IsAtTerminal();
// As the desktop does; without one the address that was told has to do.
void OpenInBrowser(const std::string& url);
// Whether a visualisation of the experiment draws what it shows.
bool HasPictures(const Experiment& experiment);

// From the current folder, if the file is in it; otherwise the path as it is.
std::string ShortPath(const std::string& path);

// The experiment with the visualisations of `kinds`, such as "web" or "opengl". `with_own`: beside its own ones,
// otherwise instead of them. Throws UsageError if there is no such renderer.
std::unique_ptr<Experiment> WithShown(const Experiment& experiment, const std::vector<std::string>& kinds,
                                      bool with_own);
// The text with the visualisation in the place of its own ones.
std::string WithVisualisation(const std::string& effective_xml, const std::string& element);

// Ticks of a film, so that it is made within some seconds: fewer for more robots, never more than `ran` (0: not known).
std::uint64_t TicksOfFilm(const Experiment& experiment, std::uint64_t ran);

// In `folder`, which must be there. Says on standard error where to look; returns when the page was closed by Ctrl-C or
// the end of the run, or the film is written, with the exit code of the process.
int Show(const Experiment& experiment, ShowingKind kind, const std::string& folder, std::uint64_t ran = 0);

}  // namespace swarmanoid
