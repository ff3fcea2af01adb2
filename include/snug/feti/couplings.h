#ifndef snug_feti_couplings_h
#define snug_feti_couplings_h

#include <snug/feti/csr_matrix.h>

#include <mpi.h>

#include <tuple>
#include <vector>

namespace snug::feti {
/// Row and column of an entry in the pattern of a replicated matrix.
struct Coupling
{
  unsigned int row, column;

  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive & row & column;
  }

  bool operator<(const Coupling &other) const
  {
    return std::tie(row, column) < std::tie(other.row, other.column);
  }
  bool operator==(const Coupling &other) const
  {
    return row == other.row && column == other.column;
  }
};

/// Couplings of a rank. They are inserted many times and stored about once, in one array.
class Couplings
{
public:
  void insert(const Coupling &pair);

  /// Return the pattern of the couplings of all ranks in an @p n x @p n matrix. Collective.
  CsrPattern unite(unsigned int n, MPI_Comm comm);

private:
  std::vector<Coupling> pairs;
};

/// Sum @p values over ranks. The order of the summation depends on the number of ranks, and with it
/// the last digits of the result. Collective.
void sum_over_ranks(std::vector<double> &values, MPI_Comm comm);
void sum_over_ranks(qp::MultiVector &values, MPI_Comm comm);
} // namespace snug::feti

#endif
