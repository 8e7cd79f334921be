// Whole studies in this process: their tables, failed runs, more seeds, searches, damaged results, estimates.
#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/errors/exit_codes.h"
#include "common/math/random.h"
#include "common/program/usage_error.h"
#include "simulation/register_all.h"
#include "studies/executors/executor.h"
#include "studies/runs/run_order.h"
#include "studies/runs/study_estimate.h"
#include "studies/runs/study_setup.h"
#include "studies/sweep.h"
#include "studies/sweep_progress.h"
#include "studies/tables/study_store.h"
#include "tests/world/experiment_text.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Drives at a speed to which its random number of the run adds up to `noise`. `fault` is what happens in its second
// step while the variable SWARMANOID_TEST_FAULT is set.
class CWholeStudyDriver : public CCI_Controller
{
public:
  int Init(const TConfigurationTree tree) override
  {
    speed_ = tree.GetNumber("speed", 0) + tree.GetNumber("noise", 0) * GetRobot()->GetRandom().Uniform();
    fault_ = tree.GetText("fault", "");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    GetRobot()->Actuator<CCI_WheelsActuator>("wheels").SetLinearVelocity(speed_, speed_);
    if (GetRobot()->GetTick() != 1 || std::getenv("SWARMANOID_TEST_FAULT") == nullptr) return;
    if (fault_ == "throws") throw std::runtime_error("no way");
    if (fault_ == "kills") std::raise(SIGKILL);
    if (fault_ == "speeds" && speed_ > 0.15) throw std::runtime_error("too fast");
  }
  bool HasState() const override { return true; }

private:
  double speed_ = 0;
  std::string fault_;
};
REGISTER_CONTROLLER(CWholeStudyDriver, "whole_study_driver")

// While it lives, runs have the faults that they ask for.
struct FaultsAreOn
{
  FaultsAreOn() { setenv("SWARMANOID_TEST_FAULT", "1", 1); }
  ~FaultsAreOn() { unsetenv("SWARMANOID_TEST_FAULT"); }
};

struct Done
{
  int code = 0;
  std::string out, err;
};

// The folder of a study and its experiment: a foot-bot that drives for 1 s. Results go to its folder "out".
class WholeStudy : public testing::Test
{
protected:
  WholeStudy()
  {
    RegisterBuiltins();
    WriteExperiment("e.xml");
  }

  void WriteExperiment(const std::string& name, const std::string& parameters = "<speed>0.1</speed>",
                       const std::string& clock = "<maxclock>10</maxclock>") const
  {
    folder.Write(
        name,
        test::ExperimentText{
            .framework = clock,
            .controllers = test::Controller(
                {.tag = "whole_study_driver", .id = "go", .actuators = {"generic_wheels"}, .parameters = parameters}),
            .arena = "<footbot id='a' position='5,5,0' controller='go'/>"}
            .Text());
  }
  std::string StudyFile(const std::string& inside, const std::string& attributes = "seeds='1-2'",
                        const std::string& name = "s.xml") const
  {
    return folder.Write(name, "<study experiment='e.xml' " + attributes + ">\n" + inside + "\n</study>\n");
  }
  // A factor of the controller.
  static std::string Factor(const std::string& parameter, const std::string& values)
  {
    return "<factor id='" + parameter + "' path='controllers.go.parameters." + parameter + "' " + values + "/>";
  }

  Done Swept(SweepOptions options) const
  {
    if (options.output.empty() && !options.resume) options.output = Out();
    if (options.jobs == 0 && options.hosts.empty()) options.jobs = 2;
    Done done;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    std::string refused;
    try
    {
      done.code = Sweep(options);
    }
    catch (const UsageError& error)
    {
      refused = error.what();
      done.code = kExitUsage;
    }
    std::fflush(stdout);
    done.out = testing::internal::GetCapturedStdout();
    done.err = testing::internal::GetCapturedStderr() + refused;
    return done;
  }
  std::string Out() const { return folder.Path() + "/out"; }

  // Returns the rows of table.csv without the last column, which is the hash.
  std::vector<std::string> Rows(const std::string& out = "out") const
  {
    std::vector<std::string> rows;
    std::istringstream lines(folder.Read(out + "/table.csv"));
    for (std::string line; std::getline(lines, line);) rows.push_back(line.substr(0, line.rfind(',')));
    return rows;
  }
  std::vector<StudyStore::RunState> RunsIn(const std::string& out = "out") const
  {
    return StudyStore::Open(folder.Path() + "/" + out)->Runs();
  }
  // Runs commands of SQL on the study's database.
  void Execute(const std::string& commands) const { StudyDatabase(Out() + "/study.sqlite", "study").Execute(commands); }

  test::TemporaryFolder folder;
};

constexpr const char* kWay = "<metrics every='5'><distance id='way'/></metrics>";
constexpr const char* kWayAtEnd = "<metrics><distance id='way'/></metrics>";

TEST_F(WholeStudy, TableHasARowForEachRunAndMeasuredTick)
{
  const std::string study = StudyFile(Factor("speed", "values='0.1 0.25'") + kWay, "seeds='1-2' ticks='8'");
  const Done done = Swept({.study = study});
  EXPECT_EQ(done.code, kExitDone) << done.err;
  EXPECT_THAT(done.out,
              testing::MatchesRegex("finished: 4 runs, 0 failed, [0-9.]+ s, table " + Out() + "/table.csv\n"));
  EXPECT_THAT(done.err, HasSubstr("study s: 2 points, 2 seeds, in " + Out() + "\n"));
  EXPECT_THAT(done.err, HasSubstr("of 4 runs ("));
  const std::vector<std::string> rows = Rows();
  ASSERT_EQ(rows.size(), 13U);
  EXPECT_EQ(rows[0], "point,speed,seed,tick,time_s,way.mean,exit");
  EXPECT_EQ(rows[1], "0,0.1,1,0,0,0,0");
  // Ticks 0, 5 and the last one, 8.
  const std::vector<std::pair<int, double>> ticks = {{0, 0.0}, {5, 0.5}, {8, 0.8}};
  std::size_t row = 1;
  for (const auto& [point, speed] : {std::pair{0, 0.1}, {1, 0.25}})
    for (const int seed : {1, 2})
      for (const auto& [tick, seconds] : ticks)
      {
        int values[3];
        double numbers[3];
        int exit_code = -1;
        ASSERT_EQ(std::sscanf(rows[row].c_str(), "%d,%lf,%d,%d,%lf,%lf,%d", &values[0], &numbers[0], &values[1],
                              &values[2], &numbers[1], &numbers[2], &exit_code),
                  7)
            << rows[row];
        EXPECT_THAT(values, ElementsAre(point, seed, tick));
        EXPECT_EQ(numbers[0], speed);
        EXPECT_NEAR(numbers[1], seconds, 1e-12);
        EXPECT_NEAR(numbers[2], speed * seconds, 1e-9);
        EXPECT_EQ(exit_code, 0);
        ++row;
      }
  EXPECT_TRUE(std::filesystem::is_empty(Out() + "/runs")) << "runs that leave no files leave no folders";

  // One process gives the same bytes, in another order of runs, and so does a study that was interrupted.
  EXPECT_EQ(Swept({.study = study, .output = folder.Path() + "/one", .quiet = true, .jobs = 1}).err, "");
  EXPECT_EQ(folder.Read("one/table.csv"), folder.Read("out/table.csv"));
  const std::string parts = folder.Path() + "/parts";
  const Done part = Swept({.study = study, .output = parts, .quiet = true, .only = "speed > 0.2 and seed == 2"});
  EXPECT_EQ(part.code, kExitDone);
  EXPECT_THAT(part.out, HasSubstr("finished: 1 runs, 0 failed"));
  EXPECT_EQ(Rows("parts").size(), 4U);
  EXPECT_EQ(Swept({.study = parts, .resume = true, .quiet = true}).code, kExitDone);
  EXPECT_EQ(folder.Read("parts/table.csv"), folder.Read("out/table.csv"));
  const Done again = Swept({.study = parts, .resume = true, .quiet = true});
  EXPECT_THAT(again.out, HasSubstr("finished: 4 runs, 0 failed")) << "nothing is left to do";
  for (const StudyStore::RunState& run : RunsIn("parts"))
  {
    EXPECT_TRUE(run.is_done);
    EXPECT_EQ(run.attempts, 1U);
    EXPECT_GT(run.wall_s, 0);
  }
}

TEST_F(WholeStudy, FailedRunsAreRepeatedAndNamed)
{
  const std::string study = StudyFile(Factor("fault", "values='none throws kills'") + kWayAtEnd, "seeds='1-2'");
  Done done;
  {
    const FaultsAreOn faults;
    done = Swept({.study = study, .quiet = true, .retries = 1});
  }
  EXPECT_EQ(done.code, kExitProcessFailed);
  EXPECT_THAT(done.out, HasSubstr("finished: 6 runs, 4 failed"));
  EXPECT_THAT(done.err,
              ContainsRegex("run 1-2 \\(fault=throws\\) failed with exit code 4: .*no way; what it left is in " +
                            Out() + "/runs/1-2\n"));
  EXPECT_THAT(done.err,
              HasSubstr("run 2-1 (fault=kills) failed with exit code 137: the process was killed by signal 9"));
  EXPECT_EQ(Rows().size(), 1U + 2) << "failed runs have no rows";
  EXPECT_THAT(folder.Read("out/runs/1-1/log.txt"), HasSubstr("no way"));
  EXPECT_FALSE(std::filesystem::exists(Out() + "/runs/0-1"));
  std::vector<unsigned> attempts;
  for (const StudyStore::RunState& run : RunsIn())
  {
    attempts.push_back(run.attempts);
    EXPECT_EQ(run.is_done, run.name.point == 0);
    EXPECT_EQ(run.has_failed, run.name.point != 0);
  }
  EXPECT_THAT(attempts, ElementsAre(1, 1, 2, 2, 2, 2));

  // Runs with enough attempts are not repeated.
  done = Swept({.study = Out(), .resume = true, .quiet = true, .retries = 1});
  EXPECT_EQ(done.code, kExitProcessFailed);
  EXPECT_THAT(done.out, HasSubstr("finished: 6 runs, 4 failed"));
  EXPECT_EQ(RunsIn()[2].attempts, 2U);
  done = Swept({.study = Out(), .resume = true, .quiet = true, .retries = 2});
  EXPECT_EQ(done.code, kExitDone) << done.err;
  EXPECT_EQ(Rows().size(), 1U + 6);
  EXPECT_EQ(RunsIn()[2].attempts, 3U);
}

TEST_F(WholeStudy, SeedsAreAddedUntilTheMeanIsKnown)
{
  const std::string noisy = StudyFile(Factor("noise", "values='0 0.1'") + kWayAtEnd, "seeds='1-3'");
  const Done done = Swept({.study = noisy, .quiet = true, .until_ci = "way.mean=0.5%", .most_seeds = 9});
  EXPECT_EQ(done.code, kExitTooFewSeeds) << done.err;
  // Three and five and, since nine is the limit, one.
  EXPECT_EQ(Rows().size(), 1U + 3 + 9);
  EXPECT_THAT(done.err,
              ContainsRegex("^point 1 \\(noise=0.1\\): way\\.mean is 0\\.[0-9]+ ± 0\\.[0-9]+ with 9 seeds\n1 of 2 "
                            "points do not reach --until-ci way.mean=0.5% with --most-seeds 9; for more: "
                            "swarmanoid sweep .*out --resume --until-ci way.mean=0.5% --most-seeds 90\n$"));
  // An interval that is wide enough needs no more seeds.
  const Done wide =
      Swept({.study = noisy, .output = folder.Path() + "/wide", .quiet = true, .until_ci = "way.mean=900%"});
  EXPECT_EQ(wide.code, kExitDone) << wide.err;
  EXPECT_EQ(Rows("wide").size(), 1U + 6);
  // The first seed that is added follows the last one.
  EXPECT_EQ(RunsIn().back().name, (RunName{1, 9}));
  for (const auto& [text, told] : std::map<std::string, std::string>{
           {"way.mean", "--until-ci: write COLUMN=PERCENT%"},
           {"way.mean=5", "--until-ci: write COLUMN=PERCENT%"},
           {"way.mean=0%", "--until-ci: write COLUMN=PERCENT%"},
           {"way.mean=x%", "--until-ci: write COLUMN=PERCENT%"},
           {"wya.mean=5%", "the study has no column 'wya.mean'; it has: way.mean; did you mean 'way.mean'?"}})
  {
    const Done refused = Swept({.study = Out(), .resume = true, .until_ci = text});
    EXPECT_EQ(refused.code, kExitUsage);
    EXPECT_THAT(refused.err, HasSubstr(told)) << text;
  }
}

TEST_F(WholeStudy, ADryRunListsRunsAndEstimatesThem)
{
  const std::string study = StudyFile(Factor("speed", "values='0.1 0.2'") + kWay, "seeds='4-6' ticks='50'");
  const Done done = Swept({.study = study, .dry_run = true, .only = "seed != 5 and speed == 0.2"});
  EXPECT_EQ(done.code, kExitDone);
  EXPECT_EQ(done.out, "1-4 speed=0.2 seed=4\n1-6 speed=0.2 seed=6\n");
  EXPECT_THAT(done.err, ContainsRegex("^2 runs: 2 points, 3 seeds\nestimate: [0-9.e-]+ s a run, [0-9]+ s with 2 at a "
                                      "time, [0-9.]+ kB on disk\n$"));
  EXPECT_FALSE(std::filesystem::exists(Out()));
  EXPECT_EQ(Swept({.study = study, .dry_run = true, .only = "seed > 6"}).err, "0 runs: 2 points, 3 seeds\n");
  EXPECT_EQ(Swept({.study = StudyFile("", "seeds='3'", "one.xml"), .dry_run = true}).out, "0-3 seed=3\n");
  EXPECT_THAT(Swept({.study = study, .dry_run = true, .only = "sed > 1"}).err, HasSubstr("--only: "));

  const LoadedStudy loaded = LoadStudyFile(study);
  const Design design(*loaded.study);
  const StudyEstimate estimate = EstimateOf(*loaded.study, design);
  EXPECT_EQ(estimate.failure, "");
  EXPECT_GT(estimate.seconds_of_run, 0);
  EXPECT_LT(estimate.seconds_of_run, 60);
  // Eleven rows with one metric, and what belongs to a run.
  EXPECT_NEAR(estimate.bytes_of_run, 300 + 11 * (85 + 28), 1e-9);
  {
    const FaultsAreOn faults;
    const LoadedStudy failing = LoadStudyFile(StudyFile(Factor("fault", "values='throws'"), "seeds='3'", "f.xml"));
    EXPECT_THAT(EstimateOf(*failing.study, Design(*failing.study)).failure,
                testing::MatchesRegex("a run of [1-9][0-9]* ticks failed: .*no way.*"));
  }
}

TEST(StudyEstimates, HaveSizesAndTimesInReadableUnits)
{
  EXPECT_EQ(RoughSize(0), "0.0 bytes");
  EXPECT_EQ(RoughSize(9.94), "9.9 bytes");
  EXPECT_EQ(RoughSize(10), "10 bytes");
  EXPECT_EQ(RoughSize(999), "999 bytes");
  EXPECT_EQ(RoughSize(1000), "1.0 kB");
  EXPECT_EQ(RoughSize(12'345), "12 kB");
  EXPECT_EQ(RoughSize(2.54e6), "2.5 MB");
  EXPECT_EQ(RoughSize(3e10), "30 GB");
  EXPECT_EQ(RoughSize(4.2e12), "4.2 TB");
  EXPECT_EQ(RoughTime(0.4), "0 s");
  EXPECT_EQ(RoughTime(89), "89 s");
  EXPECT_EQ(RoughTime(90), "2 min");
  EXPECT_EQ(RoughTime(5399), "90 min");
  EXPECT_EQ(RoughTime(5400), "1.5 h");
}

TEST_F(WholeStudy, OptionsThatDoNotFitAreRefused)
{
  const std::string study = StudyFile(kWayAtEnd), hosts = folder.Write("hosts.txt", "runs = here\n");
  const auto refusal = [&](SweepOptions options)
  {
    if (options.study.empty()) options.study = study;
    const Done done = Swept(options);
    EXPECT_EQ(done.code, kExitUsage);
    return done.err;
  };
  EXPECT_THAT(refusal({.hosts = hosts, .slurm = {""}}), HasSubstr("--hosts and --slurm: runs are either"));
  EXPECT_THAT(refusal({.runs_per_task = 3}), HasSubstr("--runs-per-task: only Slurm has tasks"));
  EXPECT_THAT(refusal({.jobs = 2, .hosts = hosts}), HasSubstr("--jobs and --hosts: each machine has runs of its own"));
  EXPECT_THAT(refusal({.hosts = folder.Write("none.txt", "engine = alpha\n")}), HasSubstr("names no machine for runs"));
  EXPECT_THAT(refusal({.slurm = {"--array=3"}}), HasSubstr("is given by the study itself"));
  EXPECT_THAT(refusal({.study = folder.Path(), .resume = true}), HasSubstr("is no folder of a study"));
  EXPECT_THAT(refusal({.output = folder.Path()}), HasSubstr("is no empty folder"));
  const std::string searching = StudyFile(
      Factor("speed", "from='0' to='1'") + kWayAtEnd + "<search metric='way.mean' runs='4'/>", "seeds='1'", "f.xml");
  EXPECT_THAT(refusal({.study = searching, .only = "seed > 1"}), HasSubstr("leave --only and --until-ci out"));
  EXPECT_THAT(refusal({.study = searching, .until_ci = "way.mean=5%"}), HasSubstr("leave --only and --until-ci out"));
  EXPECT_THAT(refusal({.study = searching, .hosts = hosts}), HasSubstr("leave --hosts and --slurm out"));
  EXPECT_THAT(refusal({.study = searching, .slurm = {""}}), HasSubstr("leave --hosts and --slurm out"));
  EXPECT_FALSE(std::filesystem::exists(Out()));
  EXPECT_EQ(Swept({.study = study, .quiet = true}).code, kExitDone);
  EXPECT_THAT(refusal({}), HasSubstr("is no empty folder"));
  // Runs of two experiments do not go together.
  WriteExperiment("e.xml", "<speed>0.2</speed>");
  EXPECT_THAT(refusal({.study = Out(), .resume = true}), HasSubstr("has changed since '" + Out() + "' was begun"));
}

TEST_F(WholeStudy, MistakesAreToldBeforeAnyRun)
{
  const auto mistakes = [&](const std::string& inside, const std::string& attributes = "seeds='1'")
  {
    const Done done = Swept({.study = StudyFile(inside, attributes)});
    EXPECT_EQ(done.code, kExitInvalidFile);
    EXPECT_FALSE(std::filesystem::exists(Out()));
    return done.err;
  };
  EXPECT_THAT(mistakes("<factor id='v' path='arena.footbot.position' values='5,5,0; 99,5,0'/>"),
              ContainsRegex("s.xml:2:[0-9]+: the value 99,5,0 of 'v', at arena.footbot.position: "));
  EXPECT_THAT(mistakes("<set path='controlers.x' value='1'/>"), HasSubstr("did you mean 'controllers'?"));
  EXPECT_THAT(mistakes("<metrics><distance id='d' of='fb*'/></metrics>"), HasSubstr("s.xml:2:"));
  EXPECT_THAT(mistakes("<factr/>"), HasSubstr("s.xml:2:1: <study> has no element <factr>"));
  WriteExperiment("e.xml", "<speed>0.1</speed>", "<maxclock>0</maxclock>");
  EXPECT_THAT(mistakes(kWayAtEnd), HasSubstr("e.xml: its runs would never end; give <study> 'ticks'"));
  EXPECT_EQ(Swept({.study = StudyFile(kWayAtEnd, "seeds='1' ticks='2'"), .quiet = true}).code, kExitDone);
}

TEST_F(WholeStudy, DamagedResultsRunAgain)
{
  const Done done = Swept({.study = StudyFile(Factor("speed", "values='0.1 0.2'") + kWay), .quiet = true});
  ASSERT_EQ(done.code, kExitDone) << done.err;
  const std::string table = folder.Read("out/table.csv");
  StudyStore::RequireWhole(Out());
  for (const char* damage : {"UPDATE samples SET time_s = time_s + 1 WHERE point = 1 AND seed = 2 AND tick = 5",
                             "UPDATE samples SET \"way.mean\" = 3 WHERE point = 1 AND seed = 2 AND tick = 10",
                             "UPDATE runs SET hash = 'f' || substr(hash, 2) || 'x' WHERE point = 1 AND seed = 2",
                             "UPDATE runs SET wall_s = wall_s + 1 WHERE point = 1 AND seed = 2",
                             "DELETE FROM samples WHERE point = 1 AND seed = 2"})
  {
    Execute(damage);
    EXPECT_THAT(test::MessageOf<StudyStoreError>([&] { StudyStore::RequireWhole(Out()); }),
                HasSubstr("the result of run 1-2 does not fit its checksum;"))
        << damage;
    const Done again = Swept({.study = Out(), .resume = true, .quiet = true});
    EXPECT_EQ(again.code, kExitDone);
    EXPECT_THAT(again.err, HasSubstr("the result of run 1-2 does not fit its checksum; it runs again")) << damage;
    EXPECT_EQ(folder.Read("out/table.csv"), table) << damage;
    StudyStore::RequireWhole(Out());
  }
  Execute("DELETE FROM samples");
  EXPECT_THAT(test::MessageOf<StudyStoreError>([&] { StudyStore::RequireWhole(Out()); }),
              HasSubstr("the result of run 0-1 does not fit its checksum, nor do those of 3 more runs"));
  Execute("UPDATE runs SET speed = 0.5 WHERE point = 1 AND seed = 2");
  EXPECT_THAT(test::MessageOf<StudyStoreError>([&] { StudyStore::RequireWhole(Out()); }),
              HasSubstr("the runs of point 1 have different values of the factor 'speed'"));
  Execute("UPDATE study SET value = 'x' WHERE name = 'name'");
  EXPECT_THAT(test::MessageOf<StudyStoreError>([&] { StudyStore::Open(Out()); }),
              HasSubstr("what it says of the study does not fit its checksum"));
  Execute("UPDATE study SET value = '1' WHERE name = 'format'");
  EXPECT_THAT(test::MessageOf<StudyStoreError>([&] { StudyStore::Open(Out()); }),
              HasSubstr("is of another version of Swarmanoid"));
}

TEST_F(WholeStudy, StoreHasRunsPointsAndLastValues)
{
  const LoadedStudy loaded = LoadStudyFile(
      StudyFile(Factor("speed", "values='0.5 0.25'") + "<variants id='v'><variant id='x y'/></variants>" + kWay));
  const Design design(*loaded.study);
  folder.Write("out/study.sqlite.new", "torn");  // of a study that did not begin
  folder.Write("out/lock", "");
  {
    const auto store = StudyStore::Create(Out(), *loaded.study, design);
    EXPECT_EQ(store->Folder(), Out());
    EXPECT_THAT(store->Columns(), ElementsAre("way.mean"));
    EXPECT_EQ(store->Fact("name"), "s");
    EXPECT_EQ(store->Fact("nothing"), "");
    EXPECT_EQ(store->Fact("seeds"), "1 2");
    EXPECT_EQ(store->Fact("experiments"), design.ExperimentsHash());
    EXPECT_THAT(store->StartsOfPaths(), ElementsAre(folder.Path() + "/", folder.Path()));
    EXPECT_EQ(store->Runs().size(), 4U);
    EXPECT_FALSE(store->IsDone({0, 1}));
    using Values = std::vector<std::pair<std::uint32_t, std::vector<ExpressionValue>>>;
    EXPECT_EQ(store->PointValues(), (Values{{0, {0.5, "x y"}}, {1, {0.25, "x y"}}}));
    RunOutcome outcome;
    outcome.name = {1, 2};
    outcome.ticks = 10;
    outcome.samples.tick_s = 0.1;
    outcome.samples.ticks = {0, 10};
    outcome.samples.values = {1, 2};
    store->Add(outcome);
    outcome.name = {0, 2};
    outcome.samples.values = {3, std::nan("")};
    outcome.exit_code = 1;  // it failed by its own measure
    store->Add(outcome);
    outcome.name = {0, 1};
    outcome.exit_code = 4;
    store->Add(outcome);
    store->AddRun({1, 7});
    store->AddPoint(5, {0.75, "z"}, {3, 4});
    store->Commit();
    store->WriteTable();
  }
  const auto store = StudyStore::Open(Out());
  EXPECT_TRUE(store->IsDone({1, 2}));
  EXPECT_TRUE(store->IsDone({0, 2}));
  EXPECT_FALSE(store->IsDone({0, 1}));
  EXPECT_THAT(store->LastValues(1, "way.mean"), ElementsAre(2));
  EXPECT_THAT(store->LastValues(0, "way.mean"), IsEmpty());
  const auto last = store->LastValues("way.mean");
  EXPECT_EQ(last.size(), 2U);
  EXPECT_EQ(last.at({1, 2}), 2);
  EXPECT_TRUE(std::isnan(last.at({0, 2})));
  std::vector<std::string> runs;
  for (const StudyStore::RunState& run : store->Runs())
    runs.push_back(run.name.Text() + (run.is_done ? " done" : run.has_failed ? " failed" : " waits"));
  EXPECT_THAT(runs,
              ElementsAre("0-1 failed", "0-2 done", "1-1 waits", "1-2 done", "1-7 waits", "5-3 waits", "5-4 waits"));
  EXPECT_EQ(store->PointValues().back().first, 5U);
  EXPECT_THAT(Rows(), ElementsAre("point,speed,v,seed,tick,time_s,way.mean,exit", "0,0.5,x y,2,0,0,3,1",
                                  "0,0.5,x y,2,10,1,,1", "1,0.25,x y,2,0,0,1,0", "1,0.25,x y,2,10,1,2,0"));
}

TEST_F(WholeStudy, SearchGoesOnAfterAFailedRunAsIfItHadNotFailed)
{
  // The best speed is the largest one; faults come above 0.15.
  const std::string study =
      StudyFile(Factor("speed", "from='0' to='0.2'") + Factor("fault", "values='speeds'") + kWayAtEnd +
                    "<search metric='way.mean' runs='24' algorithm='sbplx' fresh_seeds='2'/>",
                "seeds='1-2'");
  Done done;
  {
    const FaultsAreOn faults;
    done = Swept({.study = study, .quiet = true, .retries = 1});
  }
  EXPECT_EQ(done.code, kExitProcessFailed);
  EXPECT_THAT(done.err, ContainsRegex("run [0-9]+-[12] \\(fault=speeds speed=0\\.[0-9]+\\) failed with exit code 4: "));
  EXPECT_THAT(done.err,
              ContainsRegex("\n[0-9]+ runs of the search are done; to go on: swarmanoid sweep .*out --resume\n"));
  EXPECT_THAT(done.out, Not(HasSubstr("best:")));
  unsigned most = 0;
  for (const StudyStore::RunState& run : RunsIn()) most = std::max(most, run.attempts);
  EXPECT_EQ(most, 2U);

  done = Swept({.study = Out(), .resume = true});
  EXPECT_EQ(done.code, kExitDone) << done.err;
  EXPECT_THAT(done.err, ContainsRegex("study s: a search of at most 12 points, 2 seeds each, in .*out\n"));
  // Which points it shows depends on the time that runs take.
  EXPECT_THAT(done.err, ContainsRegex("point [0-9]+ of at most 12, [0-9]+ runs; best way\\.mean 0\\.[12][0-9]* "
                                      "\\(fault=speeds speed=0\\.[12]"));
  EXPECT_EQ(Swept({.study = study, .output = folder.Path() + "/whole", .quiet = true}).code, kExitDone);
  EXPECT_EQ(folder.Read("out/table.csv"), folder.Read("whole/table.csv"));

  EXPECT_THAT(done.out,
              ContainsRegex("^the search ended after [0-9]+ points: .*\nbest: point [0-9]+, "
                            "fault=speeds speed=0\\.2\nway\\.mean \\(mean of 2 seeds\\): 0\\.2 in the search, "
                            ".*\nway\\.mean with 2 fresh "
                            "seeds: mean 0\\.2[0]* ± .* \\(95 %\\)\nswarmanoid run .*e\\.xml --single-process "
                            "--set controllers\\.go\\.parameters\\.fault=speeds --set "
                            "controllers\\.go\\.parameters\\.speed=0\\.2\nfinished: [0-9]+ runs, 0 failed, "));
  // The fresh seeds follow those of the study.
  std::vector<std::uint64_t> fresh;
  for (const StudyStore::RunState& run : RunsIn())
    if (run.name.seed > 2) fresh.push_back(run.name.seed);
  EXPECT_THAT(fresh, ElementsAre(3, 4));
}

TEST_F(WholeStudy, SearchForTheLeastEndsByPatience)
{
  const std::string study =
      StudyFile(Factor("speed", "from='0.1' to='0.2'") + kWayAtEnd +
                    "<search metric='way.mean' goal='min' runs='400' algorithm='crs' patience='6' fresh_seeds='0'/>",
                "seeds='3'");
  const Done done = Swept({.study = study, .quiet = true});
  EXPECT_EQ(done.code, kExitDone) << done.err;
  EXPECT_THAT(done.out, HasSubstr("6 points in a row were no better"));
  EXPECT_THAT(done.out, ContainsRegex("way\\.mean \\(mean of 1 seed\\): 0\\.1[0-9]* in the search"));
  EXPECT_THAT(done.out, Not(HasSubstr("fresh")));
  const Done plan = Swept({.study = study, .dry_run = true});
  EXPECT_EQ(plan.out, "speed: 0.1 to 0.2\nbegins at speed=0.15\nleast of way.mean (mean of 1 seeds), by crs\n");
  EXPECT_EQ(plan.err, "at most 400 points, 400 runs, and 0 with fresh seeds\n");
}

TEST_F(WholeStudy, ARaceChoosesAmongValues)
{
  const std::string study =
      StudyFile(Factor("speed", "values='0.05 0.1 0.2'") + Factor("noise", "values='0.02'") + kWayAtEnd +
                    "<search metric='way.mean' runs='60' algorithm='race' fresh_seeds='2'/>",
                "seeds='1-12'");
  const Done done = Swept({.study = study});
  EXPECT_EQ(done.code, kExitDone) << done.err;
  EXPECT_THAT(done.err, ContainsRegex("study s: races of at most 60 runs, over at most 12 seeds, in "));
  EXPECT_THAT(done.err, ContainsRegex("race 1, 3 candidates left, [0-9]+ of at most 60 runs"));
  EXPECT_THAT(done.out,
              ContainsRegex("[0-9]+ races used [0-9]+ of 60 runs\nbest: point [0-9]+, speed=0\\.2 noise=0.02\n"));
  const Done plan = Swept({.study = study, .dry_run = true});
  EXPECT_THAT(plan.out, HasSubstr("speed: 0.05, 0.1, 0.2\n"));
  EXPECT_EQ(plan.err, "races of at most 60 runs, over at most 12 seeds, and 2 with fresh seeds\n");
}

TEST_F(WholeStudy, ARunOfACopyHasItsOutcome)
{
  const LoadedStudy loaded = LoadStudyFile(StudyFile(kWay));
  const auto run = [&](const StudySettings& settings) {
    return RunInCopy(*loaded.study, Out(), {{3, 9}, folder.Path() + "/e.xml", settings});
  };
  const RunOutcome done = run({});
  EXPECT_TRUE(done.IsDone());
  EXPECT_EQ(done.name, (RunName{3, 9}));
  EXPECT_EQ(done.ticks, 10U);
  EXPECT_NE(done.hash, 0U);
  EXPECT_EQ(done.failure, "");
  EXPECT_GT(done.wall_s, 0);
  EXPECT_GT(done.peak_bytes, 1U << 20U);
  EXPECT_EQ(done.samples.ticks, (std::vector<std::uint64_t>{0, 5, 10}));
  EXPECT_EQ(run({}).hash, done.hash);
  EXPECT_NE(run({{"controllers.go.parameters.speed", "0.2"}}).hash, done.hash);
  EXPECT_EQ(RunInCopy(*loaded.study, Out(), {{3, 8}, folder.Path() + "/e.xml", {}}).samples.values, done.samples.values)
      << "the seed changes no run without random numbers";
  EXPECT_FALSE(std::filesystem::exists(Out() + "/runs/3-9"));

  // The first of two mistakes is the reason.
  const RunOutcome wrong = run({{"framework.maxclok", "3"}, {"framework.clocktick", "0"}});
  EXPECT_EQ(wrong.exit_code, kExitInvalidFile);
  EXPECT_THAT(wrong.failure, HasSubstr("'clocktick' of <framework> is 0 ms"));
  EXPECT_EQ(wrong.name, (RunName{3, 9}));
  const RunOutcome missing = RunInCopy(*loaded.study, Out(), {{3, 9}, "/nowhere.xml", {}});
  EXPECT_EQ(missing.exit_code, kExitInvalidFile);
  EXPECT_THAT(missing.failure, HasSubstr("/nowhere.xml"));
  folder.Write("file", "");
  const RunOutcome blocked = RunInCopy(*loaded.study, folder.Path() + "/file", {{3, 9}, folder.Path() + "/e.xml", {}});
  EXPECT_EQ(blocked.exit_code, kExitProcessFailed);
  EXPECT_THAT(blocked.failure, HasSubstr("cannot make the folder"));
  const FaultsAreOn faults;
  const RunOutcome killed = run({{"controllers.go.parameters.fault", "kills"}});
  EXPECT_EQ(killed.exit_code, 137);
  EXPECT_EQ(killed.failure, "the process was killed by signal 9 (Killed)");
  EXPECT_FALSE(killed.IsDone());
  const RunOutcome failed = run({{"controllers.go.parameters.fault", "throws"}});
  EXPECT_EQ(failed.exit_code, kExitProcessFailed);
  EXPECT_THAT(failed.failure, HasSubstr("no way"));
}

TEST_F(WholeStudy, ASetupIsTakenUpWhereEverythingIsTheSame)
{
  const LoadedStudy loaded = LoadStudyFile(StudyFile(kWay, "seeds='4-5'"));
  const Design design(*loaded.study);
  std::vector<char> setup = SetupOf(*loaded.study, design);
  const std::unique_ptr<Study> taken = TakeUp(setup);
  EXPECT_EQ(taken->name, "s");
  EXPECT_EQ(taken->seeds, loaded.study->seeds);
  EXPECT_EQ(taken->text, loaded.study->text);
  const auto refusal = [&] { return test::MessageOf<StudyRefused>([&] { TakeUp(setup); }); };
  WriteExperiment("e.xml", "<speed>0.2</speed>");
  EXPECT_THAT(refusal(), HasSubstr("e.xml' is another one than that of the study; copy that one"));
  std::filesystem::remove(folder / "e.xml");
  EXPECT_THAT(refusal(), HasSubstr("a study needs its files under the same path on each machine"));
  WriteExperiment("e.xml");
  EXPECT_EQ(refusal(), "");
  // The version comes first.
  setup[8] = 'x';
  EXPECT_THAT(refusal(), testing::StartsWith("its Swarmanoid has version "));
  EXPECT_NE(NameOfThisHost(), "");
}

// An executor with two runs in progress, of which one is on another machine.
class BusyExecutor : public Executor
{
public:
  bool HasRoom() const override { return false; }
  void Give(RunOrder) override {}
  bool IsIdle() const override { return false; }
  std::vector<RunOutcome> Wait(std::chrono::milliseconds) override { return {}; }
  std::vector<RunningRun> Running() const override { return running; }
  unsigned Slots() const override { return slots; }

  std::vector<RunningRun> running{{{0, 3}, ""}, {{1, 4}, "alpha"}};
  unsigned slots = 4;
};

TEST_F(WholeStudy, ProgressTellsWhatIsLeft)
{
  const LoadedStudy loaded = LoadStudyFile(StudyFile(Factor("speed", "values='0.1 0.2'")));
  const Design design(*loaded.study);
  const BusyExecutor place;
  const auto shown = [&](SweepProgress& progress, const std::map<std::uint32_t, std::size_t>& waiting, int seconds)
  {
    testing::internal::CaptureStderr();
    progress.Show(place, waiting, SweepProgress::Clock::now() + std::chrono::seconds(seconds));
    return testing::internal::GetCapturedStderr();
  };
  testing::internal::CaptureStderr();
  SweepProgress progress(design, 8, 1, false);
  testing::internal::GetCapturedStderr();
  EXPECT_EQ(shown(progress, {}, 0), "1 of 8 runs (12 %); running 0-3 (speed=0.1), 1-4 on alpha (speed=0.2)\n");
  EXPECT_EQ(shown(progress, {}, 1), "") << "a line in ten seconds is enough for a file";
  progress.Done();
  progress.AddRuns(2);
  // Two runs of point 0 took 20 s on average, so that three more take 60 s; the mean of all is 30 s.
  progress.AddTime(0, 10);
  progress.AddTime(0, 30);
  progress.AddTime(7, 50);
  // Two halves of a run in progress, and the point 1 without a known time: (30 + 60 + 2 * 30) / 4.
  EXPECT_THAT(shown(progress, {{0, 3}, {1, 2}}, 11),
              testing::StartsWith("2 of 10 runs (20 %), about 38 s left; running"));
  SweepProgress quiet(design, 8, 1, true);
  EXPECT_EQ(shown(quiet, {}, 20), "");
  testing::internal::CaptureStderr();
  quiet.Say("still");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "still\n");
}

}  // namespace
}  // namespace swarmanoid
