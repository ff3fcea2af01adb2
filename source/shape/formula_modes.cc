#include <snug/base/errors.h>
#include <snug/base/run_context.h>
#include <snug/shape/entries.h>
#include <snug/shape/formula_modes.h>

namespace snug::shape {
namespace {
/// Return modes with the rows of the fields at those @p positions for which @p is_wanted is true.
/// Formulas are evaluated once, at the reference positions, because positions are linear in the
/// design. The modes have no controls, because amplitudes of fields have no position.
template <int dim, typename Wanted>
Modes<dim> modes_at(const std::vector<dealii::Tensor<1, dim>> &positions,
                    const Wanted                              &is_wanted,
                    const ShapeParameters                     &parameters)
{
  const FormulaFields<dim>              fields(parameters);
  std::vector<typename Modes<dim>::Row> rows(positions.size());
  for (unsigned int i = 0; i < fields.n(); ++i)
    for (unsigned int node = 0; node < rows.size(); ++node)
      if (is_wanted(node))
        {
          const auto value = fields.value(i, positions[node]);
          if (value.norm() > 0.)
            rows[node].emplace_back(i, value);
        }
  const unsigned int n_nodes = rows.size();
  return {fields.n(),
          n_nodes,
          [rows = std::move(rows)](unsigned int node) { return rows[node]; },
          {}};
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
dealii::Tensor<1, dim> FormulaFields<dim>::value(const unsigned int            i,
                                                 const dealii::Tensor<1, dim> &x) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int c = 0; c < dim; ++c)
    result[c] = formulas[i][c].value(dealii::Point<dim>(x));
  return result;
}

template <int dim>
Modes<dim> formula_modes(const ShapedFace<dim> &face, const ShapeParameters &parameters)
{
  return modes_at<dim>(face.positions(), [](unsigned int) { return true; }, parameters);
}

template <int dim>
Modes<dim> formula_modes(const mesh::BodyMesh<dim> &mesh,
                         const BodyNames           &bodies,
                         const ShapeParameters     &parameters)
{
  const auto is_wanted = wanted_bodies(bodies, parameters);
  Modes<dim> modes;
  // A formula may have no finite value at a node that only one rank has. All ranks must throw then.
  throw_collectively(mesh.communicator(), [&]() {
    modes = modes_at<dim>(
      mesh.reference_positions(),
      [&](unsigned int node) {
        return is_wanted[mesh.body_of_node(node)] && !mesh.is_hanging(node);
      },
      parameters);
  });
  return modes;
}

#define SNUG_INSTANTIATE(dim)                                                          \
  template class FormulaFields<dim>;                                                   \
  template Modes<dim> formula_modes(const ShapedFace<dim> &, const ShapeParameters &); \
  template Modes<dim> formula_modes(const mesh::BodyMesh<dim> &, const BodyNames &,    \
                                    const ShapeParameters &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::shape
