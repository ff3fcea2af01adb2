#include <snug/base/errors.h>
#include <snug/base/run_context.h>
#include <snug/shape/entries.h>
#include <snug/shape/formula_modes.h>
#include <snug/shape/spline_box.h>

#include <deal.II/base/mpi.h>

namespace snug::shape {
namespace {
/// sum_i alpha_i modes_i.
template <typename Field>
Field combined(const std::vector<Field> &modes, const std::vector<double> &alpha)
{
  AssertDimension(alpha.size(), modes.size());
  // There is at least one mode: FormulaFields throws else.
  Field result(modes[0].size());
  for (unsigned int i = 0; i < modes.size(); ++i)
    for (unsigned int node = 0; node < result.size(); ++node)
      result[node] += alpha[i] * modes[i][node];
  return result;
}

/// modes_i . gradient for every i.
template <typename Field>
std::vector<double> products(const std::vector<Field> &modes, const Field &gradient)
{
  std::vector<double> result(modes.size(), 0.);
  for (unsigned int i = 0; i < modes.size(); ++i)
    for (unsigned int node = 0; node < gradient.size(); ++node)
      result[i] += modes[i][node] * gradient[node];
  return result;
}
} // namespace

template <int dim>
FormulaFields<dim>::FormulaFields(const ShapeParameters &parameters)
{
  const std::string entry = parameters.path("Modes");
  if (parameters.modes.empty())
    throw bad_entry(entry, "", "must hold at least one mode");
  for (const auto &components : parameters.modes)
    {
      if (components.size() != dim)
        throw bad_entry(entry, to_text(components),
                        "must be " + std::to_string(dim) + " formulas separated by commas");
      formulas.emplace_back();
      for (const auto &text : components)
        formulas.back().emplace_back(entry, text);
    }
}

template <int dim>
unsigned int FormulaFields<dim>::n() const
{
  return formulas.size();
}

template <int dim>
dealii::Tensor<1, dim> FormulaFields<dim>::value(const unsigned int            i,
                                                 const dealii::Tensor<1, dim> &x) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int c = 0; c < dim; ++c)
    result[c] = formulas[i][c].value(dealii::Point<dim>(x));
  return result;
}

/// Formulas are evaluated once, at the reference: positions are linear in the design.
template <int dim>
FormulaFace<dim>::FormulaFace(const ShapedFace<dim> &face, const ShapeParameters &parameters)
{
  const FormulaFields<dim> fields(parameters);
  for (unsigned int i = 0; i < fields.n(); ++i)
    {
      modes.emplace_back();
      for (const auto &position : face.positions())
        // All ranks have all nodes of the face: the same values and the same errors everywhere.
        modes.back().push_back(fields.value(i, position));
    }
}

template <int dim>
unsigned int FormulaFace<dim>::n_variables() const
{
  return modes.size();
}

template <int dim>
typename FormulaFace<dim>::FaceField FormulaFace<dim>::apply(const std::vector<double> &alpha) const
{
  return combined(modes, alpha);
}

template <int dim>
std::vector<double> FormulaFace<dim>::transpose(const FaceField &gradient) const
{
  return products(modes, gradient);
}

/// Amplitudes of fields have no place.
template <int dim>
std::vector<Control<dim>> FormulaFace<dim>::controls() const
{
  return {};
}

template <int dim>
FormulaBodies<dim>::FormulaBodies(const mesh::BodyMesh<dim> &mesh,
                                  const BodyNames           &bodies,
                                  const ShapeParameters     &parameters)
  : mesh(mesh)
{
  const auto               is_wanted = wanted_bodies(bodies, parameters);
  const FormulaFields<dim> fields(parameters);
  modes.assign(fields.n(), Field(mesh.n_local_nodes()));
  // A formula may be without a value at a node that only one rank has: all have to throw then.
  everywhere(mesh.communicator(), [&]() {
    for (unsigned int i = 0; i < modes.size(); ++i)
      for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
        // Hanging nodes follow their masters instead, in apply().
        if (is_wanted[mesh.body_of_node(node)] && !mesh.is_hanging(node))
          modes[i][node] = fields.value(i, mesh.reference_positions()[node]);
  });
}

template <int dim>
unsigned int FormulaBodies<dim>::n_variables() const
{
  return modes.size();
}

template <int dim>
typename FormulaBodies<dim>::Field FormulaBodies<dim>::apply(const std::vector<double> &alpha) const
{
  Field result = combined(modes, alpha);
  mesh.interpolate_hanging(result);
  return result;
}

template <int dim>
std::vector<double> FormulaBodies<dim>::transpose(const Field &gradient) const
{
  Field free = gradient;
  // The transpose of interpolate_hanging() in apply().
  mesh.distribute_hanging(free);
  std::vector<double> result = products(modes, free);
  // The gradient at a node comes in shares of several ranks, and each rank has the modes at all its
  // local nodes: the products add up.
  dealii::Utilities::MPI::sum(result, mesh.communicator(), result);
  return result;
}

template <int dim>
std::vector<Control<dim>> FormulaBodies<dim>::controls() const
{
  return {};
}

/// Boundaries on which some mode is not zero.
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>> FormulaBodies<dim>::faces() const
{
  std::vector<bool> moves(mesh.n_local_nodes(), false);
  for (const Field &mode : modes)
    for (unsigned int node = 0; node < mode.size(); ++node)
      moves[node] = moves[node] || mode[node].norm() > 0.;
  return boundaries_of(mesh, moves);
}

template class FormulaFields<2>;
template class FormulaFields<3>;
template class FormulaFace<2>;
template class FormulaFace<3>;
template class FormulaBodies<2>;
template class FormulaBodies<3>;
} // namespace snug::shape
