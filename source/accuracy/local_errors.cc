#include <snug/accuracy/contact_pressure.h>
#include <snug/accuracy/local_errors.h>
#include <snug/elasticity/cell_point.h>
#include <snug/mesh/face_nodes.h>
#include <snug/mesh/shared_nodes.h>

#include <cmath>
#include <numeric>

namespace snug::accuracy {
namespace {
/// Correction factor of the products of mixed elements of degree 2. These products measure only
/// 0.5 to 0.8 of the errors, because the errors of displacements and of pressures nearly cancel.
const double mixed_of_degree_2 = 1.6;

/// Correction factor of the products in cells of quadratic elements (mesh::QuadraticElements).
/// Their functions are a part of degree 2 on the cells, whereas the local problems measure what
/// degree 3 adds to all of degree 2. Measured: 5.6 to 7.1 on shells and beams, see doc/choices.md.
const double quadratic_elements = 6.8;

/// Return the correction factor for quadratic elements. The node in the middle of a cell hangs only
/// in these elements.
template <int dim>
double correction(const mesh::BodyMesh<dim> &mesh, const unsigned int cell)
{
  const auto &nodes = mesh.cells()[cell].nodes;
  return mesh.degree() == 2 && mesh.is_hanging(nodes[nodes.size() / 2]) ? quadratic_elements : 1.;
}

/// Return the row @p axis of det J J^-1 from the tangents, the columns of J.
dealii::Tensor<1, 2> normal(const dealii::Tensor<2, 2> &tangents, const unsigned int axis)
{
  const dealii::Tensor<1, 2> along = tangents[1 - axis];
  return axis == 0 ? dealii::cross_product_2d(along) : -dealii::cross_product_2d(along);
}

dealii::Tensor<1, 3> normal(const dealii::Tensor<2, 3> &tangents, const unsigned int axis)
{
  return dealii::cross_product_3d(tangents[(axis + 1) % 3], tangents[(axis + 2) % 3]);
}
} // namespace

template <int dim>
LocalErrors<dim>::LocalErrors(const state::StateSolver<dim>  &solver,
                              const state::ContactState<dim> &state)
  : solver(solver)
  , state(state)
  , mesh(solver.mesh())
  , fields(solver, state)
  , applied(solver, state)
  , held(mesh.cells().size())
{
  for (const auto &body : solver.model().bodies)
    spaces.emplace_back(mesh.degree(), mesh.idealization(), body.formulation);
  const auto gauss = mesh::lagrange_gauss_points<dim - 1>(mesh.degree() + 1);
  for (unsigned int face = 0; face < 2 * dim; ++face)
    {
      std::vector<dealii::Point<dim>> at(gauss.size());
      for (unsigned int q = 0; q < gauss.size(); ++q)
        for (unsigned int axis = 0, along = 0; axis < dim; ++axis)
          at[q][axis] = axis == face / 2 ? face % 2 : gauss[q].point[along++];
      face_points[face] = points(at);
      for (unsigned int q = 0; q < gauss.size(); ++q)
        face_points[face].shapes[q].weight = gauss[q].weight;
    }
  for (const auto &face : mesh.interior_faces())
    if (auto &there = beyond[placing(face)]; there.shapes.empty())
      {
        std::vector<dealii::Point<dim>> at;
        for (const auto &shape : face_points[face.face].shapes)
          at.push_back(face.in_neighbour(shape.point));
        there = points(at);
      }
  find_held();
}

/// Return shapes and functions at points. All bodies share the functions, whatever their materials.
template <int dim>
typename LocalErrors<dim>::FaceShapes
LocalErrors<dim>::points(const std::vector<dealii::Point<dim>> &at) const
{
  FaceShapes result;
  for (const auto &point : at)
    {
      result.shapes.push_back(mesh::lagrange_point<dim>(mesh.degree(), point));
      result.functions.push_back(spaces[0].functions.at(point));
    }
  return result;
}

/// Return a key with one byte per number.
template <int dim>
std::uint64_t LocalErrors<dim>::placing(const mesh::InteriorFace<dim> &face)
{
  std::uint64_t result = face.face;
  for (const unsigned char number : {face.child, face.origin})
    result = 256 * result + number;
  for (const unsigned char axis : face.axes)
    result = 256 * result + axis;
  return result;
}

/// Return n dA out of the cell: det J J^-T times the area vector of the reference cell, which is
/// the product of the tangents, times the weight of the section.
template <int dim>
dealii::Tensor<1, dim> LocalErrors<dim>::area_vector(const mesh::LagrangePoint<dim> &shape,
                                                     const unsigned int              face,
                                                     const Nodes                    &X) const
{
  const auto   J      = elasticity::jacobian(shape, X);
  const double factor = (face % 2 == 0 ? -1. : 1.) * shape.weight *
                        (dim == 3 ? 1. : mesh.idealization().weight(elasticity::value(shape, X)));
  return factor * normal(transpose(J), face / 2);
}

/// Collect the directions that are held at the center of a face. The axis of revolution holds the
/// radius.
template <int dim>
void LocalErrors<dim>::find_held()
{
  for (const auto &face : mesh.boundary_faces())
    {
      auto                  &directions = held[face.cell][face.number];
      const auto             X          = fields.positions(face.cell);
      dealii::Tensor<1, dim> centre, normal;
      for (const unsigned int node : face.nodes)
        centre += fields.local_positions[node] / double(face.nodes.size());
      for (const auto &shape : face_points[face.number].shapes)
        normal += area_vector(shape, face.number, X);
      const auto hold = [&](dealii::Tensor<1, dim> v) {
        for (const auto &other : directions)
          v -= (v * other) * other;
        if (v.norm() > 1e-6)
          directions.push_back(v / v.norm());
      };
      for (const auto &support : solver.model().supports)
        if (support.body == face.body && support.boundary == face.boundary)
          hold(support.component.direction(centre, normal / normal.norm()));
      if (solver.points().moves(face.body, face.boundary))
        for (unsigned int c = 0; c < dim; ++c)
          hold(dealii::Point<dim>::unit_vector(c));
      bool on_axis = mesh.idealization().is_axisymmetric();
      for (const unsigned int node : face.nodes)
        on_axis = on_axis && fields.local_positions[node][0] == 0.;
      if (on_axis)
        hold(dealii::Point<dim>::unit_vector(0));
    }
}

/// Return the forces at the quadrature points; empty if there are none.
template <int dim>
typename LocalErrors<dim>::Nodes LocalErrors<dim>::body_forces(const unsigned int cell,
                                                               const Loaded      &of) const
{
  const auto &the_cell = mesh.cells()[cell];
  Nodes       b;
  if (!applied.act_in(the_cell, of))
    return b;
  const auto reference = fields.at_cell(cell, mesh.reference_positions());
  for (const auto &shape : spaces[the_cell.body].quadrature)
    b.push_back(applied.by_volume(the_cell, elasticity::value(shape, reference), of));
  return b;
}

/// Add the mean of both stresses to both cells, so that the tractions of neighboring cells are
/// opposite.
template <int dim>
void LocalErrors<dim>::add_interior_faces(const std::vector<Loaded> &of, Residuals &r) const
{
  const unsigned int n_owned = mesh.cells().size();
  for (const auto &face : mesh.interior_faces())
    {
      const auto &at           = face_points[face.face];
      const auto &at_neighbour = beyond.at(placing(face));
      const auto  X            = fields.positions(face.cell);
      const auto  here         = fields.fluxes(face.cell, of, at.shapes);
      const auto  there        = fields.fluxes(face.neighbour, of, at_neighbour.shapes);
      for (unsigned int q = 0; q < at.shapes.size(); ++q)
        {
          const auto area = area_vector(at.shapes[q], face.face, X);
          for (unsigned int i = 0; i < of.size(); ++i)
            {
              const auto force = traction<dim>(0.5 * (here[i][q] + there[i][q]), area);
              if (face.cell < n_owned)
                elasticity::add_force<dim>(at.functions[q], force, r[i][face.cell]);
              if (face.neighbour < n_owned)
                elasticity::add_force<dim>(at_neighbour.functions[q], -force, r[i][face.neighbour]);
            }
        }
    }
}

template <int dim>
void LocalErrors<dim>::add_loads(const Loaded &of, std::vector<Residual> &r) const
{
  for (unsigned int f = 0; f < mesh.boundary_faces().size(); ++f)
    if (const auto &face = mesh.boundary_faces()[f]; applied.act_on(face, of))
      {
        const auto  X         = fields.positions(face.cell);
        const auto  reference = fields.at_cell(face.cell, mesh.reference_positions());
        const auto &on_face   = face_points[face.number];
        for (unsigned int q = 0; q < on_face.shapes.size(); ++q)
          {
            const auto          &shape = on_face.shapes[q];
            const FacePoint<dim> point{elasticity::value(shape, reference),
                                       elasticity::value(shape, X),
                                       area_vector(shape, face.number, X)};
            elasticity::add_force<dim>(on_face.functions[q],
                                       applied.by_area(face, point, of) +
                                         applied.spread(face, point, of),
                                       r[face.cell]);
          }
        Nodes at_nodes;
        for (const unsigned int node : face.nodes)
          at_nodes.push_back(fields.local_positions[node]);
        for (const auto &force : solver.concentrated().on_face(state.load_case, f))
          elasticity::add_force<dim>(spaces[0].functions.at(
                                       mesh::point_on_face<dim>(face.number, force.shape.point)),
                                     of.loads * force.total(at_nodes), r[face.cell]);
      }
}

/// Add the tractions -k (q . v) q of springs for the displacement v. Springs at points are left to
/// the solution, whose stress is singular there.
template <int dim>
void LocalErrors<dim>::add_springs(const Loaded &of, std::vector<Residual> &r) const
{
  for (unsigned int f = 0; f < mesh.boundary_faces().size(); ++f)
    for (const auto &spring : solver.model().springs)
      {
        const auto &face = mesh.boundary_faces()[f];
        if (spring.place || spring.body != face.body || spring.boundary != face.boundary)
          continue;
        const auto  X         = fields.positions(face.cell);
        const auto  reference = fields.at_cell(face.cell, mesh.reference_positions());
        const auto  v         = fields.at_cell(face.cell, of.displacement);
        const auto &on_face   = face_points[face.number];
        for (unsigned int q = 0; q < on_face.shapes.size(); ++q)
          {
            const auto &shape = on_face.shapes[q];
            const auto  area  = area_vector(shape, face.number, X);
            const auto  direction =
              spring.component.direction(elasticity::value(shape, X), area / area.norm());
            const double force =
              spring.stiffness(dealii::Point<dim>(elasticity::value(shape, reference))) *
              area.norm() * (direction * elasticity::value(shape, v));
            elasticity::add_force<dim>(on_face.functions[q], -force * direction, r[face.cell]);
          }
      }
}

namespace {
/// Pressures and tractions of rows at the nodes of the pairs; empty: none.
template <int dim>
struct NodalTractions
{
  PairValues                  pressures;
  std::array<PairValues, dim> tractions; ///< components in space of the tractions

  /// Return the force on a point of a body with the rigid @p motion. @p area is n dA.
  template <typename Motion>
  dealii::Tensor<1, dim> force(const std::vector<NodeShare> &shares,
                               const dealii::Tensor<1, dim> &area,
                               const Motion                 &motion) const
  {
    dealii::Tensor<1, dim> result;
    if (!pressures.empty())
      result -= value(shares, pressures) * area;
    if (tractions[0].empty())
      return result;
    dealii::Tensor<1, dim> traction;
    for (int d = 0; d < dim; ++d)
      traction[d] = value(shares, tractions[d], -1.);
    return result + area.norm() * motion.vector_back(traction);
  }
};
} // namespace

template <int dim>
void LocalErrors<dim>::add_rows(const contact::Contact<dim>     &contact,
                                const std::vector<RowTractions> &of,
                                Residuals                       &r) const
{
  const ContactSides<dim>          sides(solver, contact, state);
  std::vector<NodalTractions<dim>> nodal(of.size());
  for (unsigned int i = 0; i < of.size(); ++i)
    {
      nodal[i].pressures = sides.values(of[i].pressures);
      for (int d = 0; d < dim; ++d)
        {
          std::vector<double> component;
          for (const auto &traction : of[i].tractions)
            component.push_back(traction[d]);
          nodal[i].tractions[d] = sides.values(component);
        }
    }
  for (const auto &face : mesh.boundary_faces())
    if (sides.is_on(face))
      {
        const auto  X       = fields.positions(face.cell);
        const auto &on_face = face_points[face.number];
        const auto &motion  = contact.placement().of_body(face.body);
        for (unsigned int q = 0; q < on_face.shapes.size(); ++q)
          {
            const auto &shape  = on_face.shapes[q];
            const auto  area   = area_vector(shape, face.number, X);
            const auto  shares = sides.shares(face, shape.value, elasticity::value(shape, X));
            for (unsigned int i = 0; i < of.size(); ++i)
              if (const auto force = nodal[i].force(shares, area, motion);
                  force.norm_square() != 0.)
                elasticity::add_force<dim>(on_face.functions[q], force, r[i][face.cell]);
          }
      }
}

template <int dim>
typename LocalErrors<dim>::Residuals LocalErrors<dim>::on_faces(const std::vector<Loaded> &of) const
{
  Residuals r(of.size());
  for (auto &of_cells : r)
    for (const auto &cell : mesh.cells())
      of_cells.emplace_back(spaces[cell.body].size(), 0.);
  add_interior_faces(of, r);
  std::vector<RowTractions> of_contact, of_ties;
  bool                      has_ties = false;
  for (unsigned int i = 0; i < of.size(); ++i)
    {
      add_loads(of[i], r[i]);
      add_springs(of[i], r[i]);
      of_contact.push_back({of[i].pressures, of[i].shears});
      of_ties.push_back({{}, of[i].ties});
      has_ties = has_ties || !of[i].ties.empty();
    }
  if (const auto &contact = solver.contact(state.load_case); contact.n_rows() > 0)
    add_rows(contact, of_contact, r);
  if (has_ties)
    add_rows(*solver.ties().paired(), of_ties, r);
  return r;
}

/// Compute the products. Neighbors are often copies of the same cell and share one factorization.
template <int dim>
std::vector<CellErrors>
LocalErrors<dim>::products(const std::vector<LoadedDisplacement<dim>> &of) const
{
  const unsigned int                           n_cells = mesh.cells().size(), n = of.size();
  auto                                         residuals = on_faces(of);
  std::vector<CellErrors>                      result(n_cells);
  std::unique_ptr<elasticity::LocalError<dim>> problem;
  for (unsigned int cell = 0; cell < n_cells; ++cell)
    {
      const auto &the_cell = mesh.cells()[cell];
      const auto &space    = spaces[the_cell.body];
      const auto  X        = fields.positions(cell);
      const auto  fluxes   = fields.fluxes(cell, of, space.quadrature);
      if (!problem || !problem->fits(space, X, fields.material(cell), held[cell]))
        problem = std::make_unique<elasticity::LocalError<dim>>(space, X, fields.material(cell),
                                                                held[cell]);
      const double factor = correction(mesh, cell);
      const double part =
        factor * (space.formulation == elasticity::Formulation::B_bar && mesh.degree() == 2
                    ? mixed_of_degree_2
                    : 1.);
      std::vector<Residual>            errors;
      std::vector<std::vector<double>> dilatations;
      for (unsigned int i = 0; i < n; ++i)
        {
          auto &r = residuals[i][cell];
          problem->add_residual(fluxes[i], body_forces(cell, of[i]), r);
          dilatations.push_back(
            problem->missing_dilatation(fields.at_cell(cell, of[i].displacement)));
          problem->subtract_dilatation(dilatations[i], r);
          errors.push_back(r);
          problem->solve(errors.back());
        }
      const auto product = [](const std::vector<double> &a, const std::vector<double> &b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
      };
      for (unsigned int i = 0; i < n; ++i)
        // a(e_0, e_i) = r_0(e_i)
        result[cell].products.push_back(part * (product(residuals[0][cell], errors[i]) -
                                                product(dilatations[0], dilatations[i])));
      for (unsigned int i = 0; i < n; ++i)
        {
          const double of_pressures = 2. * problem->dilatation_work(dilatations[i], errors[i]) +
                                      product(dilatations[i], dilatations[i]);
          // Rounding may make the square of a cell without error negative.
          result[cell].norms.push_back(std::sqrt(
            std::max(0., factor * (product(residuals[i][cell], errors[i]) + of_pressures))));
        }
    }
  return result;
}

template class LocalErrors<2>;
template class LocalErrors<3>;
} // namespace snug::accuracy
