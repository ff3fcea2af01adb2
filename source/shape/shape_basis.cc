#include <snug/base/assertions.h>
#include <snug/base/gather.h>
#include <snug/shape/formula_modes.h>
#include <snug/shape/make_modes.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <set>

namespace snug::shape {
namespace {
/// Return (body, boundary) of the boundary faces of all ranks that have a marked node, ascending.
/// @p is_marked has one value per local node. Collective.
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>> boundaries_of(const mesh::BodyMesh<dim> &mesh,
                                                                 const std::vector<bool> &is_marked)
{
  using Boundary = std::pair<unsigned int, unsigned int>;
  std::set<Boundary> found;
  for (const auto &face : mesh.boundary_faces())
    for (const unsigned int node : face.nodes)
      if (is_marked[node])
        found.insert({face.body, face.boundary});
  const std::vector<Boundary> mine(found.begin(), found.end());
  // The set holds each boundary once in ascending order, and is the same on all ranks.
  for (const auto &of_rank : all_gather(mesh.communicator(), mine))
    found.insert(of_rank.begin(), of_rank.end());
  return {found.begin(), found.end()};
}

/// Return the basis of the face of the entry Face with the modes @p make(face).
template <int dim, typename Make>
std::unique_ptr<Shape<dim>> on_face(const mesh::BodyMesh<dim> &mesh,
                                    const BodyNames           &bodies,
                                    const ShapeParameters     &parameters,
                                    const Make                &make)
{
  const ShapedFace<dim> face(mesh, bodies, parameters);
  auto                  modes    = make(face);
  auto                  resolved = parameters;
  if (resolved.interior == InteriorKind::automatic)
    resolved.interior = face.boundaries().size() == 1 &&
                            mesh.geometry(face.body()).is_box_side(face.boundaries().front())
                          ? InteriorKind::linear_blending
                          : InteriorKind::elasticity;
  auto interior = resolved.interior == InteriorKind::linear_blending
                    ? linear_blending(face, resolved)
                    : solved_interior(face, resolved);
  return std::make_unique<Shape<dim>>(face, std::move(modes), std::move(interior));
}

/// Make a shape of formula modes. Modes of whole bodies move the interior themselves, whereas
/// modes of a face need an Interior.
template <int dim>
std::unique_ptr<Shape<dim>> of_formulas(const mesh::BodyMesh<dim> &mesh,
                                        const BodyNames           &bodies,
                                        const ShapeParameters     &parameters)
{
  if (parameters.face.empty())
    return std::make_unique<Shape<dim>>(mesh, formula_modes(mesh, bodies, parameters));
  return on_face(mesh, bodies, parameters,
                 [&](const auto &face) { return formula_modes(face, parameters); });
}

template <int dim>
std::unique_ptr<Shape<dim>> patch(const mesh::BodyMesh<dim> &mesh,
                                  const BodyNames           &bodies,
                                  const ShapeParameters     &parameters,
                                  const unsigned int         degree)
{
  return on_face(mesh, bodies, parameters,
                 [&](const auto &face) { return spline_patch(face, parameters, degree); });
}
} // namespace

template <int dim>
typename Modes<dim>::Field Modes<dim>::apply(const std::vector<double> &alpha) const
{
  SNUG_ASSERT_EQUAL(alpha.size(), n_variables);
  Field moves(n_nodes);
  for (unsigned int node = 0; node < n_nodes; ++node)
    for (const auto &entry : row(node))
      moves[node] += alpha[entry.first] * entry.second;
  return moves;
}

/// The columns are cached, because V is constant and each apply() with a solved interior costs a
/// linear solve. Only the nodes that move are stored, because most columns move few nodes.
template <int dim>
const typename ShapeBasis<dim>::Moves &ShapeBasis<dim>::moves(const unsigned int i) const
{
  if (const auto known = kept.find(i); known != kept.end())
    return known->second;
  std::vector<double> alpha(n_variables(), 0.);
  alpha[i]         = 1.;
  const auto field = apply(alpha);
  n_nodes          = field.size();
  Moves &result    = kept[i];
  for (unsigned int node = 0; node < n_nodes; ++node)
    if (field[node].norm_square() > 0.)
      result.emplace_back(node, field[node]);
  return result;
}

template <int dim>
typename ShapeBasis<dim>::Field ShapeBasis<dim>::column(const unsigned int i) const
{
  const auto &of_variable = moves(i);
  Field       result(n_nodes);
  for (const auto &[node, move] : of_variable)
    result[node] = move;
  return result;
}

template <int dim>
typename ShapeBasis<dim>::Field ShapeBasis<dim>::moved(const std::vector<double> &alpha) const
{
  if (kept.empty() || kept.size() < n_variables())
    return apply(alpha);
  Field result(n_nodes);
  for (const auto &[i, of_variable] : kept)
    for (const auto &[node, move] : of_variable)
      result[node] += alpha[i] * move;
  return result;
}

template <int dim>
std::vector<double> ShapeBasis<dim>::transpose(const Field &gradient) const
{
  std::vector<double> result(n_variables(), 0.);
  for (unsigned int i = 0; i < result.size(); ++i)
    for (const auto &[node, move] : moves(i))
      if (node < gradient.size()) // nodes, or nodes and samples
        result[i] += move * gradient[node];
  dealii::Utilities::MPI::sum(result, communicator, result);
  return result;
}

template <int dim>
Shape<dim>::Shape(const mesh::BodyMesh<dim> &mesh, Modes<dim> modes)
  : ShapeBasis<dim>(mesh.communicator()), mesh(mesh), modes(std::move(modes))
{}

template <int dim>
Shape<dim>::Shape(const ShapedFace<dim>         &face,
                  Modes<dim>                     modes_of_face,
                  std::unique_ptr<Interior<dim>> interior)
  : ShapeBasis<dim>(face.mesh().communicator())
  , mesh(face.mesh())
  , modes(std::move(modes_of_face))
  , interior(std::move(interior))
{
  for (const unsigned int boundary : face.boundaries())
    boundaries.emplace_back(face.body(), boundary);
  std::sort(boundaries.begin(), boundaries.end());
  const auto &surface = face.surface();
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    if (face.is_hanging(node))
      hanging.push_back({node, surface.masters(node)});
  if (modes.n_nodes > surface.n_nodes())
    for (const auto &sample : surface.samples())
      samples.push_back(sample.second);
}

/// Modes that are defined anywhere on the face give the moves of nodes and samples. Other modes
/// give the moves of nodes only, and the moves of samples are interpolated from nodes. Modes may
/// move hanging nodes anywhere. C moves the hanging nodes of the face back to the lines or faces of
/// their masters, and H moves the hanging nodes of the mesh, because otherwise the mesh would have
/// gaps.
template <int dim>
typename Shape<dim>::Field Shape<dim>::apply(const std::vector<double> &alpha) const
{
  Field moves = modes.apply(alpha);
  if (!interior)
    {
      mesh.interpolate_hanging(moves);
      return moves;
    }
  const Field of_samples(moves.end() - samples.size(), moves.end());
  // Masters are never hanging.
  for (const auto &[node, masters] : hanging)
    {
      moves[node] = 0.;
      for (const auto &[master, weight] : masters)
        moves[node] += weight * moves[master];
    }
  moves = interior->extend(moves);
  moves.resize(mesh.n_points());
  mesh.interpolate_hanging(moves);
  mesh.interpolate_samples(moves);
  for (unsigned int k = 0; k < samples.size(); ++k)
    moves[samples[k]] = of_samples[k];
  return moves;
}

template <int dim>
dealii::Tensor<1, dim> Shape<dim>::move_at_point(const unsigned int         i,
                                                 const std::vector<double> &alpha) const
{
  dealii::Tensor<1, dim> move;
  for (const auto &[variable, direction] : modes.row_at_point(i))
    move += alpha[variable] * direction;
  return move;
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>> Shape<dim>::faces() const
{
  if (interior)
    return boundaries;
  // The row of a node that no variable moves is empty.
  std::vector<bool> moves;
  for (unsigned int node = 0; node < modes.n_nodes; ++node)
    moves.push_back(!modes.row(node).empty());
  return boundaries_of(mesh, moves);
}

template <int dim>
mesh::Field<dim> positions(const mesh::BodyMesh<dim> &mesh,
                           const ShapeBasis<dim>     &basis,
                           const std::vector<double> &design)
{
  auto       x = mesh.reference_positions();
  const auto v = basis.moved(design);
  for (unsigned int node = 0; node < x.size(); ++node)
    x[node] += v[node];
  return x;
}

template <int dim>
const ChoiceTable<MakeShape<dim>> &shape_basis_table()
{
  using Names     = std::vector<std::string>;
  const auto with = [](Names names, const Names &more) {
    names.insert(names.end(), more.begin(), more.end());
    return names;
  };
  const Names face_entries  = {"Face", "Interior", "Reach", "Direction", "Symmetry", "Fixed"};
  const Names coordinates   = {"Coordinates", "Axis", "Axis point", "Start angle"};
  const Names patch_entries = with(with(face_entries, coordinates),
                                   {"Control points", "Smooth across symmetry", "Only remove",
                                    "Maximum slope", "Convex", "Minimum tool radius"});
  const Names box_entries   = {"Bodies",    "Box corner", "Box size", "Control points",
                               "Direction", "Symmetry",   "Fixed"};
  // The degree 0 of spline_net() stands for Bernstein polynomials.
  static const ChoiceTable<MakeShape<dim>> table = {
    {"none", "no design variables",
     [](const auto &mesh, const auto &, const auto &) {
       Modes<dim> none;
       none.n_nodes = mesh.n_points();
       return std::make_unique<Shape<dim>>(mesh, none);
     }},
    {"Bezier patch", "heights [length] of Bézier control points over a face",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return patch(mesh, bodies, parameters, 0u);
     },
     patch_entries},
    {"B-spline patch", "heights [length] of B-spline control points over a face",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return patch(mesh, bodies, parameters, parameters.degree);
     },
     with(patch_entries, {"Degree"})},
    {"node-wise", "filtered displacements [length] of all nodes of a face",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return on_face(mesh, bodies, parameters,
                      [&](const auto &face) { return node_wise(face, parameters); });
     },
     with(face_entries, {"Filter radius", "Only remove"})},
    {"Bezier box", "displacements [length] of Bézier control points of a free-form deformation box",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return std::make_unique<Shape<dim>>(mesh, spline_box(mesh, bodies, parameters, 0u));
     },
     box_entries},
    {"B-spline box",
     "displacements [length] of B-spline control points of a free-form deformation box",
     [](const auto &mesh, const auto &bodies, const auto &parameters) {
       return std::make_unique<Shape<dim>>(mesh,
                                           spline_box(mesh, bodies, parameters, parameters.degree));
     },
     with(box_entries, {"Degree"})},
    {"formula modes", "amplitudes of vector fields on a face or on bodies", of_formulas<dim>,
     with({"Modes", "Bodies", "Face", "Interior", "Reach"}, coordinates)}};
  return table;
}

#define SNUG_INSTANTIATE(dim)                                                               \
  template struct Modes<dim>;                                                               \
  template class ShapeBasis<dim>;                                                           \
  template class Shape<dim>;                                                                \
  template mesh::Field<dim> positions(const mesh::BodyMesh<dim> &, const ShapeBasis<dim> &, \
                                      const std::vector<double> &);                         \
  template const ChoiceTable<MakeShape<dim>> &shape_basis_table();
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::shape
