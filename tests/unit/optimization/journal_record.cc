#include <snug/base/errors.h>
#include <snug/optimization/journal_record.h>

#include <gtest/gtest.h>

#include "warm_problem.h"

#include <cmath>
#include <limits>

using namespace snug;
using namespace snug::optimization;

TEST(JournalRecord, IsReadBackBitForBit)
{
  const double  denormal = std::numeric_limits<double>::denorm_min();
  const double  nan      = std::numeric_limits<double>::quiet_NaN();
  JournalRecord value;
  value.x                                = {1. / 3., -0., 1e-308, denormal};
  value.evaluation.objective             = -std::sqrt(2.);
  value.evaluation.gradient              = {1e300, -1e-300, 0.1, 3.};
  value.evaluation.constraints           = {1e-17, nan};
  value.evaluation.jacobian              = {{1., 2., 3., 4.}, {0.1, 0.2, 0.3, 0.4}};
  value.evaluation.linearization         = {denormal, -0.3, 7.};
  value.evaluation.active_contacts       = 17;
  value.evaluation.f_mults               = 123456789012ul;
  value.evaluation.seconds               = 1. / 3.;
  value.evaluation.least_scaled_jacobian = 0.7;
  value.n_ranks                          = 12;
  JournalRecord tangled;
  tangled.x       = {1.};
  tangled.outcome = JournalRecord::Outcome::tangled;
  tangled.message = "cell 3\nend 1";

  const std::string text =
    journal_header("a = 1") + journal_text(value, 0) + journal_text(tangled, 1);
  const auto contents = parse_journal(text, "a = 1", "journal.txt");
  ASSERT_EQ(contents.records.size(), 2u);
  const auto &read = contents.records[0];
  EXPECT_TRUE(same_bits(read.x, value.x));
  EXPECT_EQ(read.n_ranks, 12);
  EXPECT_TRUE(same_bits(read.evaluation.linearization, value.evaluation.linearization));
  EXPECT_EQ(read.evaluation.active_contacts, 17u);
  EXPECT_EQ(read.evaluation.f_mults, 123456789012ul);
  EXPECT_EQ(read.evaluation.seconds, 1. / 3.);
  EXPECT_EQ(read.evaluation.least_scaled_jacobian, 0.7);
  EXPECT_TRUE(std::isnan(read.evaluation.constraints[1]));
  EXPECT_EQ(journal_text(read, 0), journal_text(value, 0));
  EXPECT_EQ(contents.records[1].outcome, JournalRecord::Outcome::tangled);
  EXPECT_EQ(contents.records[1].message, "cell 3 end 1");
  EXPECT_EQ(contents.records[1].end, text.size());
}

TEST(JournalRecord, TornAnywhereKeepsTheCompleteRecords)
{
  JournalRecord record;
  record.x                   = {0.1, 0.2};
  record.evaluation.gradient = {0.3, 0.4};
  const std::string header   = journal_header("a = 1");
  const std::string first    = journal_text(record, 0);
  const std::string text     = header + first + journal_text(record, 1);
  for (std::size_t size = 0; size < text.size(); ++size)
    {
      const auto contents = parse_journal(text.substr(0, size), "a = 1", "journal.txt");
      EXPECT_EQ(contents.header_end, size < header.size() ? 0 : header.size());
      EXPECT_EQ(contents.records.size(), size < header.size() + first.size() ? 0u : 1u);
    }
}

TEST(JournalRecord, DamageInTheMiddleAndForeignFilesAreErrors)
{
  JournalRecord record;
  record.x                 = {0.1};
  const std::string header = journal_header("a = 1");
  std::string       text   = header + journal_text(record, 0) + journal_text(record, 1);
  text.replace(text.find("objective"), 9, "obj%ctive");
  EXPECT_THROW(parse_journal(text, "a = 1", "journal.txt"), InputError);
  EXPECT_THROW(parse_journal("snug journal 9\n", "a = 1", "j"), InputError);
  EXPECT_THROW(parse_journal("a,b\n1,2\n", "a = 1", "j"), InputError);
  EXPECT_THROW(parse_journal("x", "a = 1", "j"), InputError);
}
