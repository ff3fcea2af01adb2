#ifndef snug_tests_unit_sensitivity_velocities_h
#define snug_tests_unit_sensitivity_velocities_h

#include <unit/state/test_scene.h>

namespace snug::test {
/// The velocities of all heights of the scene's design.
template <int dim>
std::vector<typename mesh::BodyMesh<dim>::Field> column_velocities(const Problem<dim> &problem)
{
  std::vector<typename mesh::BodyMesh<dim>::Field> columns;
  for (unsigned int j = 0; j < problem.scene.design.size(); ++j)
    {
      std::vector<double> unit(problem.scene.design.size(), 0.);
      unit[j] = 1.;
      columns.push_back(problem.positions(unit));
      const auto &reference = problem.mesh.reference_positions();
      for (unsigned int node = 0; node < reference.size(); ++node)
        columns.back()[node] -= reference[node];
    }
  return columns;
}
} // namespace snug::test

#endif
