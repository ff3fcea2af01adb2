#include <snug/base/errors.h>
#include <snug/optimization/journal.h>
#include <snug/optimization/minimize.h>

#include <gtest/gtest.h>

#include "warm_problem.h"

using namespace snug;
using namespace snug::optimization;

namespace {
void expect_same_bits(const Evaluation &a, const Evaluation &b)
{
  EXPECT_TRUE(same_bits({a.objective}, {b.objective}));
  EXPECT_TRUE(same_bits(a.gradient, b.gradient));
  EXPECT_TRUE(same_bits(a.constraints, b.constraints));
  EXPECT_EQ(a.active_contacts, b.active_contacts);
  EXPECT_EQ(a.f_mults, b.f_mults);
  EXPECT_TRUE(
    same_bits({a.least_scaled_jacobian, a.seconds}, {b.least_scaled_jacobian, b.seconds}));
  ASSERT_EQ(a.jacobian.size(), b.jacobian.size());
  for (unsigned int j = 0; j < a.jacobian.size(); ++j)
    EXPECT_TRUE(same_bits(a.jacobian[j], b.jacobian[j]));
}

void expect_same_path(const WarmProblem &a, const WarmProblem &b)
{
  ASSERT_EQ(a.path.size(), b.path.size());
  for (unsigned int i = 0; i < a.path.size(); ++i)
    {
      EXPECT_TRUE(same_bits(a.path[i].x, b.path[i].x)) << i;
      EXPECT_EQ(a.path[i].evaluations, b.path[i].evaluations);
      expect_same_bits(a.path[i].evaluation, b.path[i].evaluation);
    }
}

void run_until_killed(WarmProblem &problem, WarmProblem::Where where, unsigned int when)
{
  problem.where = where;
  problem.when  = when;
  EXPECT_THROW(problem.run(), std::runtime_error);
}
} // namespace

TEST(Journal, ARunWithoutRestartDiffersInNothing)
{
  Folder      folder;
  WarmProblem journaled(folder.path);
  journaled.run();
  // the scene tests what it should: failures and a long enough path
  EXPECT_NE(folder.text().find("tangled cell 5"), std::string::npos);
  EXPECT_GE(journaled.n_live, 10u);
  EXPECT_EQ(journaled.n_replayed, 0u);

  WarmProblem replayed(folder.path, true);
  const auto  before = folder.text();
  const auto  result = replayed.run();
  EXPECT_EQ(replayed.n_live, 0u);
  EXPECT_EQ(replayed.n_replayed, result.evaluations);
  EXPECT_EQ(folder.text(), before);
  expect_same_path(journaled, replayed);

  // not a restart: from the beginning
  WarmProblem again(folder.path);
  again.run();
  EXPECT_EQ(again.n_live, journaled.n_live);
  EXPECT_EQ(folder.text(), before);
}

TEST(Journal, KilledAnywhereTheRestartTakesTheSamePathBitForBit)
{
  Folder      folder;
  WarmProblem whole(folder.path);
  whole.run();
  const std::string text = folder.text();

  using Where = WarmProblem::Where;
  for (const Where where : {Where::evaluating, Where::saving})
    for (unsigned int kill = 0; kill < whole.n_live; ++kill)
      {
        WarmProblem first(folder.path);
        run_until_killed(first, where, kill);
        WarmProblem second(folder.path, true);
        second.run();
        EXPECT_EQ(second.n_replayed, kill);
        EXPECT_EQ(second.n_live, whole.n_live - kill);
        EXPECT_EQ(folder.text(), text);
        expect_same_path(whole, second);
      }
}

TEST(Journal, KilledWhileWritingTheRecordTheRestartIsTheSameToo)
{
  Folder      folder;
  WarmProblem whole(folder.path);
  whole.run();
  const std::string text = folder.text();
  for (unsigned int kill = 1; kill < whole.n_live; ++kill)
    for (const double kept : {0., 0.3, 0.99})
      {
        WarmProblem first(folder.path);
        run_until_killed(first, WarmProblem::Where::evaluating, kill);
        const std::string complete = folder.text();
        const std::size_t begin    = complete.find("record " + std::to_string(kill - 1) + " on");
        folder.write(complete.substr(0, begin + std::size_t(kept * (complete.size() - begin))));
        WarmProblem second(folder.path, true);
        second.run();
        EXPECT_EQ(second.n_replayed, kill - 1);
        EXPECT_EQ(folder.text(), text);
        expect_same_path(whole, second);
      }
}

/// Killed before a gradient the state it is of has to be made again, from the memory before it.
TEST(Journal, GradientsOnDemandAreRestartedBitForBitToo)
{
  Folder      folder;
  WarmProblem whole(folder.path, false, true);
  whole.run();
  const std::string text = folder.text();
  // the scene tests what it should: designs that need no gradient, and many that do
  EXPECT_GE(whole.n_differentiated, 5u);
  EXPECT_LT(whole.n_differentiated, whole.n_live);

  using Where = WarmProblem::Where;
  for (const Where where : {Where::evaluating, Where::differentiating, Where::saving})
    for (unsigned int kill = 0;
         kill < (where == Where::differentiating ? whole.n_differentiated : whole.n_live); ++kill)
      for (const double kept : {0.3, 1.})
        {
          WarmProblem first(folder.path, false, true);
          run_until_killed(first, where, kill);
          const std::string complete = folder.text();
          const auto        begin    = complete.rfind("record ");
          if (begin != std::string::npos)
            folder.write(complete.substr(0, begin + std::size_t(kept * (complete.size() - begin))));
          WarmProblem second(folder.path, true, true);
          second.run();
          EXPECT_EQ(folder.text(), text);
          expect_same_path(whole, second);
        }
}

TEST(Journal, KilledAgainAndAgainItStillArrives)
{
  Folder      folder;
  WarmProblem whole(folder.path);
  whole.run();
  const std::string text = folder.text();
  folder.write("");
  for (unsigned int kill = 1; kill < whole.n_live; kill += 2)
    {
      WarmProblem part(folder.path, true);
      run_until_killed(part, WarmProblem::Where::evaluating, kill);
    }
  WarmProblem last(folder.path, true);
  last.run();
  EXPECT_EQ(folder.text(), text);
  expect_same_path(whole, last);
}

TEST(Journal, ASolveErrorIsReplayedAsOneAndOthersAreNotRecorded)
{
  Folder       folder;
  unsigned int calls    = 0;
  const auto   evaluate = [&](const std::vector<double> &x) -> Evaluation {
    ++calls;
    if (x[0] > 0.)
      throw SolveError("no equilibrium");
    throw Interrupted("SIGTERM");
  };
  DesignProblem problem;
  problem.evaluate = evaluate;
  JournalSettings settings;
  settings.directory    = folder.path;
  settings.communicator = MPI_COMM_WORLD;
  {
    Journal    journal(settings);
    const auto journaled = journal.journaled(problem);
    EXPECT_THROW(journaled.evaluate({1.}), SolveError);
    EXPECT_THROW(journaled.evaluate({-1.}), Interrupted);
  }
  settings.restart = true;
  Journal    journal(settings);
  const auto journaled = journal.journaled(problem);
  EXPECT_EQ(journal.n_records(), 1u);
  try
    {
      journaled.evaluate({1.});
      FAIL();
    }
  catch (const TangledMesh &)
    {
      FAIL();
    }
  catch (const SolveError &error)
    {
      EXPECT_STREQ(error.what(), "no equilibrium");
    }
  EXPECT_EQ(calls, 2u);
}

TEST(Journal, AnotherDesignCutsTheRecordAndStartsCold)
{
  Folder      folder;
  WarmProblem first(folder.path);
  first.run();
  WarmProblem second(folder.path, true);
  {
    Journal    journal(second.settings);
    const auto journaled = journal.journaled(second.problem);
    journaled.evaluate({0.1, 0.9});
    journaled.evaluate({0.2, 0.8});
    EXPECT_EQ(journal.n_replayed(), 1u);
    EXPECT_EQ(journal.n_records(), 2u);
  }
  EXPECT_NE(second.log.find("another design"), std::string::npos);
  EXPECT_EQ(second.n_loads, 0u);
  const auto contents = parse_journal(folder.text(), second.settings.fingerprint, "journal.txt");
  ASSERT_EQ(contents.records.size(), 2u);
  EXPECT_EQ(contents.records[1].x, (std::vector<double>{0.2, 0.8}));
}

/// Requested designs differ by rounding, like those on another number of ranks.
TEST(Journal, DesignsThatAgreeToTheToleranceAreReplayed)
{
  Folder      folder;
  WarmProblem first(folder.path);
  first.run();
  const auto before = folder.text();
  for (const double distance : {0.5 * replay_tolerance, 2. * replay_tolerance})
    {
      folder.write(before);
      WarmProblem second(folder.path, true);
      {
        Journal      journal(second.settings);
        const auto   journaled = journal.journaled(second.problem);
        unsigned int n         = 0;
        for (const auto &record : parse_journal(before, second.settings.fingerprint, "").records)
          {
            auto x = record.x;
            x[0] -= distance * std::max(std::abs(x[0]), std::abs(x[1])) * (n == 0 ? 0. : 1.);
            Evaluation found = record.evaluation;
            try
              {
                found = journaled.evaluate(x);
              }
            catch (const TangledMesh &)
              {
                EXPECT_EQ(record.outcome, JournalRecord::Outcome::tangled);
              }
            if (distance < replay_tolerance && record.outcome == JournalRecord::Outcome::value)
              expect_same_bits(found, record.evaluation);
            ++n;
          }
        EXPECT_EQ(journal.n_replayed(), distance < replay_tolerance ? n : 1u);
      }
      EXPECT_EQ(folder.text() == before, distance < replay_tolerance);
    }
}

TEST(Journal, CutAndKilledBeforeTheNextRecordItHasNoStaleWarmStart)
{
  Folder      folder;
  WarmProblem first(folder.path);
  run_until_killed(first, WarmProblem::Where::evaluating, 3);
  const auto cut_and_die = [&] {
    WarmProblem second(folder.path, true);
    Journal     journal(second.settings);
    second.problem.evaluate = [](const auto &) -> Evaluation { throw Killed(); };
    const auto journaled    = journal.journaled(second.problem);
    journaled.evaluate({0.1, 0.9});
    EXPECT_THROW(journaled.evaluate({0.2, 0.8}), Killed);
    return second.n_loads;
  };
  EXPECT_EQ(cut_and_die(), 0u);
  EXPECT_EQ(cut_and_die(), 0u);
}

TEST(Journal, RefusesTheJournalOfAnotherProblemSayingWhich)
{
  Folder      folder;
  WarmProblem first(folder.path);
  first.run();
  WarmProblem second(folder.path, true);
  second.settings.fingerprint = "variables = 2\nobjective = compliance";
  try
    {
      second.run();
      FAIL();
    }
  catch (const InputError &error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find("journal.txt"), std::string::npos) << message;
      EXPECT_NE(message.find("objective = energy"), std::string::npos);
      EXPECT_NE(message.find("objective = compliance"), std::string::npos);
      EXPECT_EQ(message.find("variables"), std::string::npos);
    }
}

TEST(Journal, OnAnotherNumberOfRanksItStartsColdAndSaysSo)
{
  Folder      folder;
  WarmProblem first(folder.path);
  run_until_killed(first, WarmProblem::Where::evaluating, 6);
  std::string       text  = folder.text();
  const std::string ranks = " on " + std::to_string(n_all_ranks()) + " ranks";
  for (auto at = text.find(ranks); at != std::string::npos; at = text.find(ranks, at + 1))
    text.replace(at, ranks.size(), " on 17 ranks");
  folder.write(text);
  for (unsigned int attempt = 0; attempt < 2; ++attempt)
    {
      WarmProblem second(folder.path, true);
      run_until_killed(second, WarmProblem::Where::evaluating, 6);
      EXPECT_EQ(second.n_loads, 0u);
      EXPECT_NE(second.log.find("17 ranks"), std::string::npos);
    }
  WarmProblem third(folder.path, true);
  EXPECT_NO_THROW(third.run());
  EXPECT_EQ(third.n_replayed, 6u);
}

/// Bytes that are kept of the warm-start file; -1: it is missing.
TEST(Journal, StartsColdIfTheWarmStartIsMissingOrCutShort)
{
  for (const int kept : {-1, 0, 3, 20})
    {
      Folder      folder;
      WarmProblem first(folder.path);
      run_until_killed(first, WarmProblem::Where::evaluating, 6);
      const std::string file = folder.path + "/warm-start.1";
      if (this_rank() == 0 && kept < 0)
        std::filesystem::remove(file);
      else if (this_rank() == 0)
        std::filesystem::resize_file(file, kept);
      WarmProblem second(folder.path, true);
      EXPECT_NO_THROW(second.run());
      EXPECT_TRUE(second.began_cold);
      EXPECT_NE(second.log.find("no warm-start data"), std::string::npos);
    }
}

/// A second problem on the same journal, as after pairing contact anew:
/// the memory of the first one is not for it.
TEST(Journal, ProblemsThatFollowOneAnotherHaveTheirOwnMemory)
{
  Folder folder;
  {
    WarmProblem first(folder.path);
    Journal     journal(first.settings);
    journal.journaled(first.problem).evaluate({0.1, 0.9});
  }
  WarmProblem again(folder.path, true);
  Journal     journal(again.settings);
  journal.journaled(again.problem).evaluate({0.1, 0.9});
  EXPECT_EQ(journal.n_replayed(), 1u);
  WarmProblem next(folder.path);
  journal.journaled(next.problem).evaluate({0.1, 0.9});
  EXPECT_EQ(next.n_loads, 0u);
  EXPECT_EQ(journal.n_records(), 2u);
}

TEST(Journal, SaysWhereItCannotWrite)
{
  WarmProblem problem("/nowhere/at/all");
  EXPECT_THROW(problem.run(), InputError);
}
