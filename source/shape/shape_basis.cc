#include <snug/base/errors.h>
#include <snug/shape/face_basis.h>
#include <snug/shape/formula_modes.h>
#include <snug/shape/node_wise.h>
#include <snug/shape/spline_box.h>
#include <snug/shape/spline_patch.h>

namespace snug::shape {
namespace {
/// The basis of scenes whose shape is fixed.
template <int dim>
class NoBasis : public Shape<dim>
{
public:
  using Field = typename ShapeBasis<dim>::Field;

  explicit NoBasis(const mesh::BodyMesh<dim> &mesh) : mesh(mesh) {}

  unsigned int n_variables() const override { return 0; }

  Field apply(const std::vector<double> &) const override { return Field(mesh.n_local_nodes()); }

  std::vector<double> transpose(const Field &) const override { return {}; }

  std::vector<Control<dim>> controls() const override { return {}; }

  std::vector<std::pair<unsigned int, unsigned int>> faces() const override { return {}; }

private:
  const mesh::BodyMesh<dim> &mesh;
};

/// The basis of modes of the entry Face, made from @p arguments.
template <int dim, template <int> class Modes, typename... Arguments>
std::unique_ptr<Shape<dim>> on_face(const mesh::BodyMesh<dim> &mesh,
                                    const BodyNames           &bodies,
                                    const ShapeParameters     &parameters,
                                    const Arguments &...arguments)
{
  auto face = std::make_unique<ShapedFace<dim>>(mesh, bodies, parameters);
  // Modes and interior refer to the face, which keeps its place when the pointer moves.
  auto modes    = std::make_unique<Modes<dim>>(*face, parameters, arguments...);
  auto interior = choose(interior_table<dim>(), parameters.interior).make(*face, parameters);
  return std::make_unique<FaceBasis<dim>>(std::move(face), std::move(modes), std::move(interior));
}

/// Fields of whole bodies move the interior by themselves; on a face it has to follow.
template <int dim>
std::unique_ptr<Shape<dim>> formula_modes(const mesh::BodyMesh<dim> &mesh,
                                          const BodyNames           &bodies,
                                          const ShapeParameters     &parameters)
{
  if (parameters.face.empty())
    return std::make_unique<FormulaBodies<dim>>(mesh, bodies, parameters);
  return on_face<dim, FormulaFace>(mesh, bodies, parameters);
}
} // namespace

/// The velocity dX/dalpha_i, the same at every design since V is constant.
template <int dim>
typename ShapeBasis<dim>::Field ShapeBasis<dim>::column(unsigned int i) const
{
  std::vector<double> alpha(n_variables(), 0.);
  alpha[i] = 1.;
  return apply(alpha);
}

template <int dim>
typename mesh::BodyMesh<dim>::Field positions(const mesh::BodyMesh<dim> &mesh,
                                              const ShapeBasis<dim>     &basis,
                                              const std::vector<double> &design)
{
  auto       x = mesh.reference_positions();
  const auto v = basis.apply(design);
  for (unsigned int node = 0; node < x.size(); ++node)
    x[node] += v[node];
  return x;
}

template <int dim>
const ChoiceTable<MakeShape<dim>> &shape_basis_table()
{
  // Degree 0 of spline_net() stands for Bernstein polynomials.
  static const ChoiceTable<MakeShape<dim>> table = {
    {"none", "the shape is fixed",
     [](const auto &mesh, const auto &, const auto &) {
       return std::make_unique<NoBasis<dim>>(mesh);
     }},
    {"Bezier patch", "heights [length] of Bézier control points over a face",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return on_face<dim, SplinePatch>(mesh, bodies, parameters, 0u);
     }},
    {"B-spline patch", "heights [length] of B-spline control points over a face",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return on_face<dim, SplinePatch>(mesh, bodies, parameters, parameters.degree);
     }},
    {"node-wise", "smoothed moves [length] of all nodes of a face",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return on_face<dim, NodeWise>(mesh, bodies, parameters);
     }},
    {"Bezier box",
     "moves [length] of Bézier control points of a free-form deformation "
     "box",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return std::make_unique<SplineBox<dim>>(mesh, bodies, parameters, 0u);
     }},
    {"B-spline box", "the same with B-splines",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return std::make_unique<SplineBox<dim>>(mesh, bodies, parameters, parameters.degree);
     }},
    {"formula modes", "amplitudes of vector fields on a face or on bodies", formula_modes<dim>}};
  return table;
}

#define SNUG_INSTANTIATE(dim)                                                         \
  template class ShapeBasis<dim>;                                                     \
  template mesh::BodyMesh<dim>::Field         positions(const mesh::BodyMesh<dim> &,  \
                                                        const ShapeBasis<dim> &,      \
                                                        const std::vector<double> &); \
  template const ChoiceTable<MakeShape<dim>> &shape_basis_table<dim>();
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::shape
