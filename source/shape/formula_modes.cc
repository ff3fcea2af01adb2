#include <snug/base/errors.h>
#include <snug/base/run_context.h>
#include <snug/shape/entries.h>
#include <snug/shape/face_coordinates.h>
#include <snug/shape/formula_modes.h>

#include <algorithm>

namespace snug::shape {
namespace {
/// Return modes with the rows of the fields at those @p positions for which @p is_wanted is true.
/// @p on_face returns the variables of a point other than x, y, z.
/// Formulas are evaluated once, at the reference positions, because positions are linear in the
/// design. The modes have no controls, because amplitudes of fields have no position.
template <int dim, typename Wanted, typename OnFace>
Modes<dim> modes_at(const FormulaFields<dim>                  &fields,
                    const std::vector<dealii::Tensor<1, dim>> &positions,
                    const Wanted                              &is_wanted,
                    const OnFace                              &on_face)
{
  std::vector<typename Modes<dim>::Row> rows(positions.size());
  for (unsigned int i = 0; i < fields.n(); ++i)
    for (unsigned int node = 0; node < rows.size(); ++node)
      if (is_wanted(node))
        {
          const auto value = fields.value(i, positions[node], on_face(node));
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
  : variables(dim == 2 ? std::vector<std::string>{"x", "y"}
                       : std::vector<std::string>{"x", "y", "z"})
{
  if (!parameters.face.empty())
    for (const auto *name : {"s", "t", "angle", "length"})
      if (dim == 3 || std::string(name) != "t")
        variables.emplace_back(name);
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
        formulas.back().emplace_back(entry, text, variables);
    }
}

template <int dim>
bool FormulaFields<dim>::contain(const std::string &name) const
{
  const unsigned int variable =
    std::find(variables.begin(), variables.end(), name) - variables.begin();
  for (const auto &components : formulas)
    for (const auto &formula : components)
      if (formula.contains(variable))
        return true;
  return false;
}

template <int dim>
bool FormulaFields<dim>::need_coordinates() const
{
  return contain("s") || contain("t") || contain("angle") || contain("length");
}

template <int dim>
dealii::Tensor<1, dim> FormulaFields<dim>::value(const unsigned int            i,
                                                 const dealii::Tensor<1, dim> &x,
                                                 const std::vector<double>    &on_face) const
{
  dealii::Tensor<1, 3> place;
  std::vector<double>  values;
  for (unsigned int d = 0; d < dim; ++d)
    {
      place[d] = x[d];
      values.push_back(x[d]);
    }
  values.insert(values.end(), on_face.begin(), on_face.end());
  dealii::Tensor<1, dim> result;
  for (unsigned int c = 0; c < dim; ++c)
    result[c] = formulas[i][c].value(values, place);
  return result;
}

template <int dim>
Modes<dim> formula_modes(const ShapedFace<dim> &face, const ShapeParameters &parameters)
{
  const FormulaFields<dim>   fields(parameters);
  const auto                 points = face.needed_points();
  typename Modes<dim>::Field positions;
  for (const unsigned int point : points)
    positions.push_back(face.positions()[point]);
  // A formula may have no finite value at a sample that only one rank has. All ranks must throw
  // then.
  const auto make = [&](const auto &on_face) {
    Modes<dim> modes;
    throw_collectively(face.mesh().communicator(), [&]() {
      modes = modes_at<dim>(fields, positions, [](unsigned int) { return true; }, on_face);
    });
    return modes;
  };
  if (!fields.need_coordinates())
    return make([](unsigned int) { return std::vector<double>(); });
  const FaceCoordinates<dim> coordinates(face, parameters);
  const bool                 has_angle = coordinates.kind() == Coordinates::angle;
  if (fields.contain("angle") && !has_angle)
    throw bad_entry(parameters.path("Coordinates"), to_text(parameters.coordinates),
                    "must be angle for formulas that contain the angle");
  const auto  &first  = coordinates.axis(0);
  const auto  &along  = coordinates.axis(has_angle ? dim - 2 : 0);
  const double length = along.range * along.unit;
  return make([&](unsigned int i) {
    std::vector<double> values;
    for (unsigned int a = 0; a < dim - 1; ++a)
      values.push_back(coordinates.axis(a).values[points[i]]);
    values.push_back(first.lower + first.values[points[i]]);
    values.push_back(length);
    return values;
  });
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
      FormulaFields<dim>(parameters), mesh.reference_positions(),
      [&](unsigned int node) {
        return is_wanted[mesh.body_of_node(node)] && !mesh.is_hanging(node);
      },
      [](unsigned int) { return std::vector<double>(); });
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
