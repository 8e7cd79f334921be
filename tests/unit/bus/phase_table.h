// The table of phases and events of ServerMembership or WorkerMembership, as docs/recovery.md has it.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "test_folders.h"

namespace swarmanoid
{

// Returns the row of each event and result, with all phases that have it; other pairs change nothing.
template <class Membership>
std::string PhaseTable()
{
  using Phase = typename Membership::Phase;
  std::string table = "| event | phases | next phase | action |\n|---|---|---|---|\n";
  for (std::size_t event = 0; event < Membership::kEvents.size(); ++event)
  {
    std::vector<std::pair<typename Membership::Next, std::string>> rows;
    for (std::size_t phase = 0; phase < Membership::kPhases.size(); ++phase)
    {
      const auto next =
          Membership::Transition(static_cast<Phase>(phase), static_cast<typename Membership::Event>(event));
      if (next == typename Membership::Next{static_cast<Phase>(phase)}) continue;
      auto row = std::ranges::find(rows, next, [](const auto& known) { return known.first; });
      if (row == rows.end()) row = rows.insert(row, {next, ""});
      row->second += fmt::format("{}{}", row->second.empty() ? "" : ", ", Membership::kPhases[phase]);
    }
    for (const auto& [next, phases] : rows)
      table += fmt::format("| {} | {} | {} | {} |\n", Membership::kEvents[event], phases,
                           Membership::kPhases[static_cast<std::size_t>(next.phase)],
                           Membership::kActions[static_cast<std::size_t>(next.action)]);
  }
  return table;
}

template <class Membership>
void ExpectTableInDocumentation()
{
  std::stringstream page;
  page << std::ifstream(SWARMANOID_SOURCE_FOLDER "/docs/recovery.md").rdbuf();
  EXPECT_THAT(page.str(), testing::HasSubstr(PhaseTable<Membership>()));
}

}  // namespace swarmanoid
