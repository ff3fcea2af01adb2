#ifndef snug_tests_gradient_sensitivity_curved_scene_h
#define snug_tests_gradient_sensitivity_curved_scene_h

#include <gradient/sensitivity/check_derivatives.h>

namespace snug::test {
/// Two blocks of @p n_cells per edge with a curved contact and a design with heights.
template <int dim>
TestScene<dim> curved_scene(unsigned int n_cells, unsigned int n_heights, double bound)
{
  auto scene = two_blocks<dim>(n_cells, n_cells, 3.);
  set_design(scene, n_heights, bound);
  scene.solver.relative_tolerance = 1e-12;
  return scene;
}

/// Smooth velocities of all nodes, none of which is of the basis.
template <int dim>
typename mesh::BodyMesh<dim>::Field waves(const mesh::BodyMesh<dim> &mesh)
{
  auto V = mesh.reference_positions();
  for (auto &v : V)
    {
      const auto x = v;
      for (unsigned int c = 0; c < dim; ++c)
        v[c] = std::sin(1. + c + 2. * x[0] + x[1]) * std::cos(x[dim - 1]);
    }
  mesh.interpolate_hanging(V);
  return V;
}

/// dJ/dX of the adjoint method along any velocity of the nodes.
template <int dim>
void check_shape_gradients(GradientScene<dim> &scene)
{
  const auto                      V      = waves(scene.problem.mesh);
  auto                           &solver = scene.problem.solver;
  const auto                      state  = scene.solve(scene.design);
  sensitivity::GradientParameters parameters;
  parameters.method         = sensitivity::Method::adjoint;
  parameters.shape_gradient = true;
  std::vector<std::string> names;
  std::vector<double>      slopes, sizes, differences;
  for (const auto &[name, response] : scene.responses)
    names.push_back(name);
  for (const auto &gradient : scene.gradients(state, names, parameters).of_response)
    {
      double product = 0., size = 0.;
      for (unsigned int node = 0; node < V.size(); ++node)
        {
          product += (*gradient.shape)[node] * V[node];
          size += std::abs((*gradient.shape)[node] * V[node]);
        }
      slopes.push_back(dealii::Utilities::MPI::sum(product, MPI_COMM_WORLD));
      sizes.push_back(dealii::Utilities::MPI::sum(size, MPI_COMM_WORLD));
    }
  differences.resize(names.size());
  const double step     = 1e-4;
  const int    place[]  = {-2, -1, 1, 2};
  const double weight[] = {1. / 12., -8. / 12., 8. / 12., -1. / 12.};
  for (unsigned int k = 0; k < 4; ++k)
    {
      auto x = state.positions;
      for (unsigned int node = 0; node < x.size(); ++node)
        x[node] += place[k] * step * V[node];
      const auto there = solver.solve(x, qp::WarmStart());
      for (unsigned int i = 0; i < names.size(); ++i)
        differences[i] += weight[k] / step * scene.responses.at(names[i])->value(solver, there);
    }
  for (unsigned int i = 0; i < names.size(); ++i)
    EXPECT_NEAR(slopes[i], differences[i], direct_tolerance * sizes[i]) << names[i];
}
} // namespace snug::test

#endif
