// Measure the cost of the coarse problem G G' on a rank that keeps it, and on a group of all ranks:
// subdomains in a cube, each coupled with its 26 neighbours, six rigid modes each. Prints CSV:
// seconds of the numeric factorization and of a solve with one column, and the megabytes of the
// factor on rank 0, medians of the repeats given.

#include <snug/base/narrow.h>
#include <snug/feti/sparse_factor.h>

#include <deal.II/base/mpi.h>

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>

namespace {
using namespace snug;

const unsigned int n_modes = 6;

/// Diagonally dominant, as only its pattern matters.
feti::CsrMatrix coarse_matrix(const unsigned int n)
{
  const auto near = [n](unsigned int i) {
    return std::pair(i == 0 ? 0 : i - 1, std::min(i + 1, n - 1));
  };
  std::vector<std::vector<PetscInt>> columns;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < n; ++k)
        {
          std::vector<PetscInt> row;
          for (unsigned int a = near(i).first; a <= near(i).second; ++a)
            for (unsigned int b = near(j).first; b <= near(j).second; ++b)
              for (unsigned int c = near(k).first; c <= near(k).second; ++c)
                for (unsigned int mode = 0; mode < n_modes; ++mode)
                  row.push_back(narrow<PetscInt>(((a * n + b) * n + c) * n_modes + mode));
          columns.insert(columns.end(), n_modes, row);
        }
  auto matrix = feti::CsrMatrix::from_rows(columns, narrow<unsigned int>(columns.size()));
  for (unsigned int i = 0; i < matrix.n_rows(); ++i)
    for (PetscInt p = matrix.row_start()[i]; p < matrix.row_start()[i + 1]; ++p)
      matrix.values[p] = matrix.columns()[p] == PetscInt(i) ? 200. : -1.;
  return matrix;
}

template <class Work>
double seconds(const unsigned int repeats, const Work &work)
{
  std::vector<double> times;
  for (unsigned int r = 0; r < repeats; ++r)
    {
      const auto start = std::chrono::steady_clock::now();
      work();
      times.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// In use, and mapped for large arrays.
double megabytes()
{
  const auto info = mallinfo2();
  return double(info.uordblks + info.hblkhd) / (1 << 20);
}
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 3)
    {
      std::cerr << "usage: benchmark.coarse REPEATS SUBDOMAINS_PER_EDGE..." << std::endl;
      return 2;
    }
  const auto n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const auto group =
    n_ranks > 1 ? std::make_shared<const feti::CoarseGroup>(MPI_COMM_WORLD, n_ranks) : nullptr;
  const bool prints  = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  const auto repeats = narrow<unsigned int>(std::strtoul(argv[1], nullptr, 10));
  if (prints)
    std::cout << "ranks,subdomains,modes,factorization,solve,MB" << std::endl;
  for (int i = 2; i < argc; ++i)
    {
      const auto         n      = narrow<unsigned int>(std::strtoul(argv[i], nullptr, 10));
      const auto         matrix = coarse_matrix(n);
      const double       before = megabytes();
      feti::SparseFactor factor(matrix, feti::MatrixKind::coarse, feti::Factorization::CHOLMOD,
                                nullptr, group);
      const double    factorization = seconds(repeats, [&]() { factor.factorize(matrix, "G G'"); });
      const double    held          = megabytes() - before;
      qp::MultiVector b(matrix.n_rows()), x(matrix.n_rows());
      std::fill(b.column(0), b.column(0) + b.n_rows(), 1.);
      const double solve = seconds(10 * repeats, [&]() { factor.solve(b, x); });
      if (prints)
        std::cout << n_ranks << ',' << n * n * n << ',' << matrix.n_rows() << ',' << factorization
                  << ',' << solve << ',' << held << std::endl;
    }
  return 0;
}
