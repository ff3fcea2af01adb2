#ifndef snug_advice_cost_h
#define snug_advice_cost_h

#include <snug/scene/scene.h>

#include <iosfwd>

namespace snug::advice {
/// The mesh and the rows a scene will have, from its numbers alone.
struct Counts
{
  double cells = 0., nodes = 0.; ///< nodes without hanging ones
  double coarse_cells = 0.;      ///< which every rank has
  double contact_rows = 0.;      ///< at most: nodes of the finer sides
  double subdomains   = 0.;
  bool   has_layers   = true; ///< of cells, so that subdomains are boxes
};

/// Return the counts of a run on @p ranks ranks. Cells of 'Refine where' are counted on samples.
/// Only the coarse cells of the mesh are made.
Counts count(const scene::Scene &scene, unsigned int ranks);

/// Estimated cost of a run. Times are wall times [s] of this machine without other processes.
struct Cost
{
  Counts       counts;
  unsigned int dimension, ranks, n_designs = 0;
  /// of all ranks, and the largest of one [MB]
  double memory_total, memory_largest;
  double start, setup, factorization, solve, accuracy, output;
  double gradient = 0.; ///< of one design
  double design   = 0.; ///< a state, warm, with the gradient
  double total;         ///< of optimizations, with as many designs as may be evaluated
};

/// The cost model of doc/advice.md; @p speed: of this machine, see machine_speed().
Cost estimate_cost(const scene::Scene &scene, unsigned int ranks, double speed);

/// How many times as fast as the machine whose times the model has this one makes stiffness
/// matrices; takes less than 0.1 s.
double machine_speed();

/// Two lines; or, with @p stages, a table.
void print(const Cost &cost, bool stages, std::ostream &out);
} // namespace snug::advice

#endif
