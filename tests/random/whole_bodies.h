#ifndef snug_tests_random_whole_bodies_h
#define snug_tests_random_whole_bodies_h

#include <snug/scene/scene.h>
#include <snug/state/state_solver.h>

#include <random/dense_problem.h>

#include <array>
#include <map>
#include <memory>
#include <sstream>

namespace snug::test {
/**
 * The contact problem of a scene with each body in one piece, on this rank
 * alone: stiffness, loads, rows and gaps as the state problem gives them, with
 * rigid motions of the nodes' positions.
 */
template <int dim>
class WholeBodies
{
public:
  /// Node or slave node by body or pair and place.
  using Key = std::array<long, dim + 1>;

  static Key key(unsigned int index, const dealii::Tensor<1, dim> &x);

  explicit WholeBodies(scene::Scene scene);

  DenseProblem                problem;
  std::map<Key, unsigned int> unknown_of_node; ///< the first of dim
  std::map<Key, unsigned int> row_of_slave;    ///< among problem.contact

private:
  void collect(const state::StateProblem<dim>    &state,
               const mesh::BodyMesh<dim>         &mesh,
               const state::RowCoefficients<dim> &rows);
  void collect_body(const feti::SubdomainSystem               &system,
                    const std::vector<double>                 &f,
                    const std::vector<dealii::Tensor<1, dim>> &positions);
};
} // namespace snug::test

#endif
