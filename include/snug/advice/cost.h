#ifndef snug_advice_cost_h
#define snug_advice_cost_h

#include <snug/mesh/body_mesh.h>
#include <snug/scene/scene.h>

#include <iosfwd>

namespace snug::advice {
/// Numbers of a mesh that determine the cost of a run.
struct Counts
{
  double cells = 0., nodes = 0.;  ///< nodes without hanging nodes
  double coarse_cells       = 0.; ///< of refined meshes, which every rank has
  double contact_rows       = 0.; ///< at most: nodes of the slave sides
  double subdomains         = 0.;
  double subdomains_by_size = 0.;   ///< number that 'Subdomains' = auto makes on few ranks
  bool   has_layers         = true; ///< of cells, so that subdomains are boxes
};

/// Return the counts of @p mesh. Collective.
template <int dim>
Counts count(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);

/// Estimated cost of a run. Times are wall times [s] of this machine without other processes.
struct Cost
{
  Counts       counts;
  unsigned int dimension, ranks, n_designs = 0;
  /// of all ranks, and of the largest rank [MB]
  double memory_total, memory_largest;
  double start, setup, factorization, solve, accuracy, output;
  double gradient = 0.; ///< of one design
  double design   = 0.; ///< a state, warm, with the gradient
  double total;         ///< of optimizations, with as many designs as may be evaluated
};

/// Return the cost of a run on @p ranks ranks by the cost model of doc/advice.md. @p counts are
/// those of a mesh on any number of ranks, @p speed is that of machine_speed().
Cost estimate_cost(const scene::Scene &scene, Counts counts, unsigned int ranks, double speed);

/// Return the speed of this machine relative to the machine to which the constants of the model
/// are fitted. The function measures it by making stiffness matrices, in less than 0.1 s.
double machine_speed();

/// Print two lines; with @p stages, also the time of each stage.
void print(const Cost &cost, bool stages, std::ostream &out);
} // namespace snug::advice

#endif
