#include <snug/feti/row_layout.h>

#include <gtest/gtest.h>

#include <map>

namespace {
using namespace snug;

/// 4 subdomains over the ranks; row r of 11 has entries in subdomain s at
/// unknown r + 10 s if (r + s) is divisible by 2 or 3; 1, 2, .. rows a rank.
struct Example
{
  static const unsigned int n_rows = 11, n_subdomains = 4;

  int                                              rank, n_ranks;
  std::vector<unsigned int>                        first_row;
  std::vector<std::vector<feti::RowLayout::Entry>> entries;
  unsigned int                                     first_subdomain;
  std::unique_ptr<feti::RowLayout>                 layout;

  static bool touches(unsigned int row, unsigned int s)
  {
    return (row + s) % 2 == 0 || (row + s) % 3 == 0;
  }

  Example()
  {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
    for (int r = 0; r <= n_ranks; ++r)
      first_row.push_back(n_rows * r * (r + 1) / (n_ranks * (n_ranks + 1)));
    first_subdomain = n_subdomains * rank / n_ranks;
    for (unsigned int s = first_subdomain; s < n_subdomains * (rank + 1) / n_ranks; ++s)
      {
        entries.emplace_back();
        for (unsigned int row = n_rows; row-- > 0;)
          if (touches(row, s))
            entries.back().push_back({row, row + 10 * s});
      }
    qp::RowSet bounded;
    for (unsigned int row = first_row[rank]; row < first_row[rank + 1]; ++row)
      bounded.push_back(row % 2);
    layout = std::make_unique<feti::RowLayout>(MPI_COMM_WORLD, bounded, entries, first_subdomain);
  }
};

TEST(RowLayout, SendsOwnedValuesToLocalRows)
{
  Example         example;
  qp::MultiVector owned(example.layout->n_owned(), 2);
  for (unsigned int i = 0; i < owned.n_rows(); ++i)
    for (unsigned int k = 0; k < 2; ++k)
      owned(i, k) = 1. + example.first_row[example.rank] + i + 100. * k;
  const auto local = example.layout->to_local(owned);
  EXPECT_EQ(local.n_rows(), example.layout->n_local());
  for (const auto &of_subdomain : example.entries)
    for (const auto &entry : of_subdomain)
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_EQ(local(example.layout->local_row(entry.global_row), k),
                  1. + entry.global_row + 100. * k);
}

TEST(RowLayout, SumsLocalRowsAtTheOwner)
{
  // every rank adds its number of touching subdomains
  Example         example;
  qp::MultiVector local(example.layout->n_local(), 2);
  for (const auto &of_subdomain : example.entries)
    for (const auto &entry : of_subdomain)
      {
        local(example.layout->local_row(entry.global_row), 0) += 1.;
        local(example.layout->local_row(entry.global_row), 1) += 0.5;
      }
  const auto owned = example.layout->to_owned(local);
  ASSERT_EQ(owned.n_rows(), example.layout->n_owned());
  for (unsigned int i = 0; i < owned.n_rows(); ++i)
    {
      double expected = 0.;
      for (unsigned int s = 0; s < Example::n_subdomains; ++s)
        expected += Example::touches(example.first_row[example.rank] + i, s);
      EXPECT_EQ(owned(i, 0), expected);
      EXPECT_EQ(owned(i, 1), expected / 2);
    }
}

TEST(RowLayout, GathersEntriesInOrder)
{
  Example             example;
  std::vector<double> values;
  for (unsigned int s = 0; s < example.entries.size(); ++s)
    for (const auto &entry : example.entries[s])
      {
        values.push_back(entry.global_row);
        values.push_back(example.first_subdomain + s);
        values.push_back(entry.dof);
      }
  const auto  gathered = example.layout->gather_entries(3, values);
  const auto &start    = example.layout->entry_start();
  const auto &unknowns = example.layout->entry_unknowns();
  ASSERT_EQ(start.size(), example.layout->n_owned() + 1u);
  ASSERT_EQ(gathered.size(), 3 * start.back());
  unsigned int place = 0;
  for (unsigned int i = 0; i < example.layout->n_owned(); ++i)
    {
      const unsigned int row = example.first_row[example.rank] + i;
      EXPECT_EQ(start[i], place);
      for (unsigned int s = 0; s < Example::n_subdomains; ++s)
        if (Example::touches(row, s))
          {
            EXPECT_EQ(gathered[3 * place], row);
            EXPECT_EQ(gathered[3 * place + 1], s);
            EXPECT_EQ(gathered[3 * place + 2], row + 10 * s);
            EXPECT_EQ(unknowns[place].subdomain, s);
            EXPECT_EQ(unknowns[place].dof, row + 10 * s);
            ++place;
          }
    }
}

/// A rank sends a number for each row of its own that another rank has too, and for each row of
/// another rank that it has.
TEST(RowLayout, CountsWhatARankSends)
{
  const Example example;
  const auto    has = [&](const int of_rank, const unsigned int row) {
    for (unsigned int s = 0; s < Example::n_subdomains; ++s)
      if (static_cast<int>(s) >= int(Example::n_subdomains) * of_rank / example.n_ranks &&
          static_cast<int>(s) < int(Example::n_subdomains) * (of_rank + 1) / example.n_ranks &&
          Example::touches(row, s))
        return true;
    return false;
  };
  unsigned int neighbours = 0, messages = 0, numbers = 0;
  for (int other = 0; other < example.n_ranks; ++other)
    {
      unsigned int to_its_rows = 0, to_its_copies = 0;
      for (unsigned int row = 0; row < Example::n_rows && other != example.rank; ++row)
        {
          const auto owns = [&](const int r) {
            return row >= example.first_row[r] && row < example.first_row[r + 1];
          };
          to_its_rows += owns(other) && has(example.rank, row);
          to_its_copies += owns(example.rank) && has(other, row);
        }
      messages += (to_its_rows > 0) + (to_its_copies > 0);
      neighbours += to_its_rows + to_its_copies > 0;
      numbers += to_its_rows + to_its_copies;
    }
  const auto sent = example.layout->sent();
  EXPECT_EQ(sent.neighbours, neighbours);
  EXPECT_EQ(sent.messages, messages);
  EXPECT_EQ(sent.numbers, numbers);
}
} // namespace
