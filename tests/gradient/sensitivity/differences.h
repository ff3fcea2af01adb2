#ifndef snug_tests_gradient_sensitivity_differences_h
#define snug_tests_gradient_sensitivity_differences_h

#include <snug/sensitivity/gradient.h>
#include <snug/sensitivity/methods.h>
#include <snug/shape/shapes.h>

#include <deal.II/base/mpi.h>

#include <gradient/sensitivity/all_responses.h>
#include <gradient/sensitivity/probe.h>
#include <gtest/gtest.h>

namespace snug::test {
/// Values to be differentiated: responses by name and the displacement of the local nodes.
template <int dim>
struct Values
{
  std::map<std::string, double>       responses;
  typename mesh::BodyMesh<dim>::Field displacement;
  std::vector<bool>                   strong;
};

/// A scene with a shape, as a rule a Bézier patch on the foundation's top,
/// that moves along an axis; solved to 1e-12.
template <int dim>
class GradientScene
{
public:
  using Field = typename mesh::BodyMesh<dim>::Field;

  /// @p scene.design gives the heights where derivatives are taken.
  GradientScene(const TestScene<dim> &scene,
                double                bound,
                const std::string    &face = "foundation.top",
                unsigned int          axis = dim - 1)
    : GradientScene(scene, patch(scene, bound, face, axis))
  {}

  GradientScene(const TestScene<dim> &scene, const shape::ShapeParameters &shape)
    : problem(scene)
    , basis(std::make_unique<shape::Shapes<dim>>(problem.mesh,
                                                 shape::BodyNames{problem.model.body_names},
                                                 std::vector<shape::ShapeParameters>{shape}))
    , design(scene.design)
    , widths(basis->n_variables(), shape.bounds[1] - shape.bounds[0])
  {
    // bases have their own numbers of variables
    if (design.size() != basis->n_variables())
      design = random_heights(basis->n_variables(), shape.bounds[1]);
    const auto known = all_responses<dim>();
    for (const std::string name : {"potential energy", "compliance", "strain energy", "volume"})
      responses[name] = response::make_response<dim>(known.at(name));
    responses["probe"] = std::make_unique<Probe<dim>>();
  }

  state::ContactState<dim> solve(const std::vector<double> &design)
  {
    // cold: a warm start would stop at once and hide the derivative
    return problem.solver.solve(shape::positions(problem.mesh, *basis, design), qp::WarmStart(),
                                load_case);
  }

  Values<dim> values(const std::vector<double> &design)
  {
    const auto  state = solve(design);
    Values<dim> result;
    for (const auto &[name, response] : responses)
      result.responses[name] = response->value(problem.solver, state);
    result.displacement = state.displacement;
    for (const auto &point : state.contact)
      result.strong.push_back(point.strong);
    return result;
  }

  /// Fourth-order central differences along @p direction; all four states
  /// must have the contacts of the middle one.
  Values<dim> differences(const std::vector<double> &direction, double step)
  {
    const auto   middle   = values(design);
    Values<dim>  result   = middle;
    const double weight[] = {1. / 12., -8. / 12., 8. / 12., -1. / 12.};
    const int    place[]  = {-2, -1, 1, 2};
    for (auto &[name, value] : result.responses)
      value = 0.;
    for (auto &value : result.displacement)
      value = dealii::Tensor<1, dim>();
    for (unsigned int k = 0; k < 4; ++k)
      {
        auto moved = design;
        for (unsigned int i = 0; i < moved.size(); ++i)
          moved[i] += place[k] * step * direction[i];
        const auto at = values(moved);
        EXPECT_EQ(at.strong, middle.strong);
        for (const auto &[name, value] : at.responses)
          result.responses[name] += weight[k] / step * value;
        for (unsigned int node = 0; node < at.displacement.size(); ++node)
          result.displacement[node] += weight[k] / step * at.displacement[node];
      }
    return result;
  }

  sensitivity::GradientProblem<dim> at(const state::ContactState<dim>        &state,
                                       const sensitivity::GradientParameters &parameters)
  {
    return {problem.solver, *basis, state, design, widths, parameters};
  }

  sensitivity::Gradients<dim> gradients(const state::ContactState<dim>        &state,
                                        const std::vector<std::string>        &names,
                                        const sensitivity::GradientParameters &parameters)
  {
    sensitivity::MeasuredResponses<dim> chosen;
    for (const auto &name : names)
      chosen.push_back({responses.at(name).get(), 0});
    return sensitivity::gradients<dim>({at(state, parameters)}, chosen);
  }

  Problem<dim>                                                    problem;
  std::unique_ptr<shape::Shapes<dim>>                             basis;
  std::vector<double>                                             design;
  std::vector<double>                                             widths;
  unsigned int                                                    load_case = 0;
  std::map<std::string, std::unique_ptr<response::Response<dim>>> responses;

private:
  static shape::ShapeParameters
  patch(const TestScene<dim> &scene, double bound, const std::string &face, unsigned int axis)
  {
    shape::ShapeParameters parameters;
    parameters.basis          = "Bezier patch";
    parameters.face           = face;
    parameters.control_points = scene.control_points;
    parameters.control_points.resize(dim - 1);
    parameters.direction.assign(dim, 0.);
    parameters.direction[axis] = 1.;
    parameters.bounds          = {-bound, bound};
    return parameters;
  }
};

/// Two random directions and two single components of n variables.
inline std::vector<std::vector<double>> test_directions(unsigned int n)
{
  std::mt19937                           generator(3);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  std::vector<std::vector<double>>       directions(4);
  for (auto &direction : directions)
    direction.assign(n, 0.);
  for (unsigned int i = 0; i < n; ++i)
    {
      directions[0][i] = uniform(generator);
      directions[1][i] = uniform(generator);
    }
  directions[2][0]     = 1.;
  directions[3][n / 2] = 1.;
  return directions;
}

inline double dot(const std::vector<double> &a, const std::vector<double> &b)
{
  double sum = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

inline double norm(const std::vector<double> &a)
{
  return std::sqrt(dot(a, a));
}

/// |a - b| / |b|
inline double relative_error(const std::vector<double> &a, const std::vector<double> &b)
{
  std::vector<double> difference;
  for (unsigned int i = 0; i < b.size(); ++i)
    difference.push_back(a[i] - b[i]);
  return norm(difference) / norm(b);
}
} // namespace snug::test

#endif
