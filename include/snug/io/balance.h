#ifndef snug_io_balance_h
#define snug_io_balance_h

#include <snug/base/run_context.h>
#include <snug/feti/row_layout.h>
#include <snug/mesh/tearing.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace snug::io {
/// The stages of RunContext::seconds(), in the order of Summary::Times.
inline constexpr std::array<const char *, 8> stage_names = {
  {"setup", "assembly", "factorization", "soft modes", "solve", "gradient", "accuracy", "output"}};

/// A quantity over the ranks.
struct Spread
{
  double least = 0., mean = 0., largest = 0.;

  /// Return the largest over the mean value; 1 if all are zero.
  double ratio() const { return mean > 0. ? largest / mean : 1.; }
};

/// Work and messages of the ranks of a run.
struct Balance
{
  unsigned int n_ranks = 1, n_subdomains = 0; ///< subdomains with unknowns
  Spread       subdomains, cells, unknowns;   ///< unknowns of the torn bodies
  Spread       own_seconds;                   ///< of assembly, factorizations and subdomain solves
  /// of each stage that ran, and of the subdomain solves
  std::vector<std::pair<std::string, Spread>> seconds;
  /// what a rank sends to other ranks in a product with F, without collective calls, largest values
  unsigned long neighbours = 0, messages = 0, bytes = 0;
};

/// Return the work of the ranks up to the call. @param[in] layout The rows of a product with F.
/// Collective.
template <int dim>
Balance collect_balance(const RunContext          &context,
                        const mesh::BodyMesh<dim> &mesh,
                        const mesh::Tearing       &tearing,
                        const feti::RowLayout     &layout);

/// Return a line that tells what to do if one rank has more than 1.3 times the mean work; else
/// empty.
std::string balance_note(const Balance &balance);
} // namespace snug::io

#endif
