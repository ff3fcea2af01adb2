#include <snug/mesh/cell_shape.h>
#include <snug/state/assembler.h>
#include <snug/state/rigid_modes.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::state {
namespace {
/// Maximum number of nodes of a compact subdomain over those of a cube of as many cells. Slabs of 5
/// x 5 x 2 cells have 1.05, and parts of METIS have 1.1 and more.
const double most_nodes_of_cube = 1.025;

/// Maximum number of nodes in the plane over those of a square. Parts of METIS have 1.02.
const double most_nodes_of_square = 1.01;
} // namespace

template <int dim>
Assembler<dim>::Assembler(const mesh::BodyMesh<dim>       &mesh,
                          const mesh::Subdomain           &subdomain,
                          const Model<dim>                &model,
                          const elasticity::Element<dim>  &element,
                          const elasticity::FaceLoad<dim> &face_load,
                          const ConcentratedLoads<dim>    &concentrated)
  : mesh(mesh)
  , subdomain(subdomain)
  , model(model)
  , the_element(element)
  , face_load(face_load)
  , concentrated(concentrated)
{
  for (const unsigned int cell : subdomain.cells)
    cell_reach.push_back(mesh::NodeReach<dim>::of_cell(mesh, cell, subdomain.nodes));
  std::vector<unsigned int> cells = subdomain.cells;
  std::sort(cells.begin(), cells.end());
  for (unsigned int f = 0; f < mesh.boundary_faces().size(); ++f)
    {
      const auto &face      = mesh.boundary_faces()[f];
      const auto  is_loaded = [&](const LoadCase<dim> &load_case) {
        return load_case.bodies[subdomain.body].boundaries.count(face.boundary) == 1;
      };
      if (std::binary_search(cells.begin(), cells.end(), face.cell) &&
          std::any_of(model.load_cases.begin(), model.load_cases.end(), is_loaded))
        {
          // Keep faces with a load in any load case, so that one index serves all load cases.
          faces.push_back(f);
          face_reach.emplace_back(mesh, face.nodes, subdomain.nodes);
        }
    }
  collect_pieces();
  build_pattern();
}

/// Find the neighbours of each node. Nodes are neighbours if a cell reaches both nodes. Through a
/// hanging node a cell also reaches masters that are not among its own nodes.
template <int dim>
void Assembler<dim>::build_pattern()
{
  node_neighbours.resize(subdomain.nodes.size());
  for (const Piece &piece : pieces)
    {
      const auto &slots = cell_reach[piece.cell].slots();
      for (const unsigned int a : slots)
        node_neighbours[a].insert(node_neighbours[a].end(), slots.begin(), slots.end());
    }
  for (auto &neighbours : node_neighbours)
    {
      std::sort(neighbours.begin(), neighbours.end());
      neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
      neighbours.shrink_to_fit();
    }
  for (Piece &piece : pieces)
    {
      // Look the places up once, because K is assembled for each design with the same pattern.
      const auto &slots = cell_reach[piece.cell].slots();
      piece.places.reserve(slots.size() * slots.size());
      for (const unsigned int a : slots)
        for (const unsigned int b : slots)
          piece.places.push_back(
            std::lower_bound(node_neighbours[a].begin(), node_neighbours[a].end(), b) -
            node_neighbours[a].begin());
    }
}

/// Return no rows for hanging nodes, because Subdomain::nodes contains their masters instead.
template <int dim>
feti::CsrMatrix Assembler<dim>::sparsity() const
{
  std::vector<std::vector<PetscInt>> rows;
  if (is_point())
    rows.resize(n_dofs());
  for (const auto &neighbours : node_neighbours)
    for (unsigned int c = 0; c < dim; ++c)
      {
        // All dim rows of a node have the same columns, dim per neighbour, as stiffness() expects.
        rows.emplace_back();
        for (const unsigned int b : neighbours)
          for (unsigned int d = 0; d < dim; ++d)
            rows.back().push_back(dim * b + d);
      }
  return feti::CsrMatrix::from_rows(rows, n_dofs());
}

template <int dim>
void Assembler<dim>::stiffness(const Field &positions, feti::CsrMatrix &K) const
{
  // Compute the values only, because K has the pattern of sparsity().
  std::fill(K.values.begin(), K.values.end(), 0.);
  std::vector<double> matrix;
  for (const Piece &piece : pieces)
    {
      const auto        &slots = cell_reach[piece.cell].slots();
      const unsigned int m     = slots.size();
      compute_stiffness(piece, positions, matrix);
      for (unsigned int a = 0; a < m; ++a)
        for (unsigned int c = 0; c < dim; ++c)
          {
            double             *row   = K.values.data() + K.row_start()[dim * slots[a] + c];
            const double       *from  = matrix.data() + std::size_t(a * dim + c) * m * dim;
            const unsigned int *place = piece.places.data() + a * m;
            for (unsigned int b = 0; b < m; ++b)
              for (unsigned int d = 0; d < dim; ++d)
                row[dim * place[b] + d] += from[b * dim + d];
          }
    }
}

/// Assemble the load of this subdomain alone. A node with several copies has parts of its load on
/// all copies, and B'lambda balances the copies.
template <int dim>
std::vector<double> Assembler<dim>::load(const Field     &positions,
                                         unsigned int     load_case,
                                         const Tractions &tractions) const
{
  if (is_point())
    return point_load(load_case);
  std::vector<double> f(n_dofs(), 0.);
  Nodes               r;
  if (has_cell_loads(load_case))
    for (unsigned int i = 0; i < cell_reach.size(); ++i)
      add_cell_vector(i, 1., cell_load(i, cell_field(i, positions), load_case), f.data());
  for (unsigned int i = 0; i < faces.size(); ++i)
    {
      face_load.force(face_field(i, positions), face_load_values(i, load_case, tractions), r);
      add_face_vector(i, 1., r, f.data());
    }
  return f;
}

/// Return force and moment, divided by the length by which rotations are multiplied.
template <int dim>
std::vector<double> Assembler<dim>::point_load(const unsigned int load_case) const
{
  std::vector<double> f(n_dofs(), 0.);
  const unsigned int  p = subdomain.body - mesh.n_bodies();
  if (const auto &points = model.load_cases[load_case].points; !points.empty())
    std::copy(points[p].wrench.begin(), points[p].wrench.end(), f.begin());
  for (unsigned int k = dim; k < f.size(); ++k)
    f[k] /= model.points[p].length;
  return f;
}

/// Compute the modes about the centre of the subdomain, because about a far centre a rotation is
/// nearly a translation, and orthogonalization would lose digits. Divided by the radius, all modes
/// are of size one.
template <int dim>
void Assembler<dim>::rigid_modes(const Field                  &positions,
                                 const dealii::Tensor<1, dim> &centre,
                                 double                        length,
                                 qp::MultiVector              &R,
                                 qp::MultiVector              &Z) const
{
  if (is_point())
    {
      R = qp::MultiVector(n_dofs(), n_dofs());
      for (unsigned int k = 0; k < n_dofs(); ++k)
        R(k, k) = 1.;
      Z = R;
      return;
    }
  Nodes                  x;
  dealii::Tensor<1, dim> mean;
  for (const unsigned int node : subdomain.nodes)
    {
      x.push_back(positions[node]);
      mean += positions[node] / double(subdomain.nodes.size());
    }
  double radius = 0.;
  for (const auto &point : x)
    radius = std::max(radius, (point - mean).norm());
  R = rigid_motions<dim>(mesh.idealization(), x, mean, radius);
  orthonormalise(R);
  const auto whole = rigid_motions<dim>(mesh.idealization(), x, centre, length);
  // R is orthonormal and also spans the modes of the body, so R Z = whole gives Z = R'whole.
  Z = qp::inner_products(R, whole, MPI_COMM_SELF);
}

/// Choose nodes by farthest point sampling: each next node is the one farthest from all chosen
/// nodes. Close nodes or, in space, collinear nodes would make R_f'R_f nearly or exactly singular.
template <int dim>
std::vector<unsigned int> Assembler<dim>::fixing_dofs(const Field &positions) const
{
  const unsigned int n_fixing = dim == 2 ? 4 : 6;
  // The only rigid motion of a body of revolution is along the axis, component 1.
  const unsigned int     first = mesh.idealization().is_axisymmetric() ? 1 : 0;
  const unsigned int     n     = subdomain.nodes.size();
  dealii::Tensor<1, dim> mean;
  for (const unsigned int node : subdomain.nodes)
    mean += positions[node] / double(n);
  std::vector<double> distance(n);
  for (unsigned int a = 0; a < n; ++a)
    distance[a] = (positions[subdomain.nodes[a]] - mean).norm();
  std::vector<unsigned int> dofs;
  for (unsigned int k = 0; is_point() && k < n_dofs(); ++k)
    dofs.push_back(k);
  for (unsigned int k = 0; k < std::min(n_fixing, n); ++k)
    {
      // Take the first of the nodes that are equally far up to round-off, so that congruent
      // subdomains choose the same nodes.
      const double       least = (1. - 1e-9) * *std::max_element(distance.begin(), distance.end());
      const unsigned int farthest =
        std::find_if(distance.begin(), distance.end(), [&](const double d) { return d >= least; }) -
        distance.begin();
      for (unsigned int c = first; c < dim; ++c)
        dofs.push_back(dim * farthest + c);
      for (unsigned int a = 0; a < n; ++a)
        {
          const double d =
            (positions[subdomain.nodes[a]] - positions[subdomain.nodes[farthest]]).norm();
          // The mean only serves to choose the first node.
          distance[a] = k == 0 ? d : std::min(distance[a], d);
        }
    }
  std::sort(dofs.begin(), dofs.end());
  return dofs;
}

template <int dim>
bool Assembler<dim>::is_compact(const Field &positions) const
{
  if (is_point())
    return true;
  // Cubes of m^dim cells of degree p have (m p + 1)^dim nodes; ragged parts have more nodes.
  const double edge  = std::pow(cells().size(), 1. / dim) * mesh.degree() + 1.;
  const double usual = std::pow(edge, dim);
  if (subdomain.nodes.size() > (dim == 2 ? most_nodes_of_square : most_nodes_of_cube) * usual)
    return false;
  double smallest = std::numeric_limits<double>::max(), largest = 0.;
  for (unsigned int i = 0; i < cells().size(); ++i)
    {
      const auto X = cell_field(i, positions);
      if (&material(i) != &material(0) || the_element.aspect(X) > mesh::compact_aspect)
        return false;
      smallest = std::min(smallest, the_element.volume(X));
      largest  = std::max(largest, the_element.volume(X));
    }
  return largest <= std::pow(mesh::compact_aspect, dim) * smallest;
}

template <int dim>
typename Assembler<dim>::Nodes Assembler<dim>::cell_field(unsigned int i, const Field &field) const
{
  Nodes result;
  for (const unsigned int node : mesh.cells()[subdomain.cells[i]].nodes)
    result.push_back(field[node]);
  return result;
}

template <int dim>
typename Assembler<dim>::Nodes Assembler<dim>::face_field(unsigned int i, const Field &field) const
{
  Nodes result;
  for (const unsigned int node : mesh.boundary_faces()[faces[i]].nodes)
    result.push_back(field[node]);
  return result;
}

template <int dim>
void Assembler<dim>::add_cell_vector(unsigned int i, double factor, const Nodes &r, double *u) const
{
  cell_reach[i].add(factor, r, u);
}

template <int dim>
void Assembler<dim>::add_face_vector(unsigned int i, double factor, const Nodes &r, double *u) const
{
  face_reach[i].add(factor, r, u);
}

template <int dim>
const BoundaryLoad<dim> *Assembler<dim>::boundary_load(unsigned int i, unsigned int load_case) const
{
  const auto &boundaries = loads(load_case).boundaries;
  const auto  found      = boundaries.find(mesh.boundary_faces()[faces[i]].boundary);
  // nullptr: the face is loaded in other load cases only
  return found == boundaries.end() ? nullptr : &found->second;
}

template <int dim>
elasticity::FaceLoadValues<dim> Assembler<dim>::face_load_values(unsigned int     i,
                                                                 unsigned int     load_case,
                                                                 const Tractions &tractions) const
{
  elasticity::FaceLoadValues<dim> values;
  const auto                     *load = boundary_load(i, load_case);
  if (load == nullptr)
    return values;
  // Formulas depend on the reference position, so the value moves with the material point.
  const auto reference = face_load.quadrature_points(face_field(i, mesh.reference_positions()));
  for (const auto &x : reference)
    {
      if (load->pressure)
        values.pressure.push_back(load->pressure(dealii::Point<dim>(x)));
      if (load->traction)
        values.traction.push_back(load->traction(dealii::Point<dim>(x)));
    }
  // The traction of a resultant depends on the positions of the whole loaded boundary, also on
  // other ranks, and comes from ResultantLoads.
  values.linear       = linear_traction(i, load_case, tractions);
  values.concentrated = concentrated.on_face(load_case, faces[i]);
  return values;
}

template <int dim>
elasticity::LinearTraction<dim> Assembler<dim>::linear_traction(unsigned int     i,
                                                                unsigned int     load_case,
                                                                const Tractions &tractions) const
{
  const auto &face  = mesh.boundary_faces()[faces[i]];
  const auto  found = tractions[load_case].find({face.body, face.boundary});
  return found == tractions[load_case].end() ? elasticity::LinearTraction<dim>() : found->second;
}

/// Return whether the load must be assembled again even if no node of this subdomain has moved.
template <int dim>
bool Assembler<dim>::has_resultants() const
{
  for (unsigned int c = 0; c < model.load_cases.size(); ++c)
    for (unsigned int i = 0; i < faces.size(); ++i)
      {
        const auto *load = boundary_load(i, c);
        if (load != nullptr && load->has_resultant())
          return true;
      }
  return false;
}

template <int dim>
const elasticity::Material &Assembler<dim>::material(unsigned int i) const
{
  return model.bodies[subdomain.body].material(mesh.cells()[subdomain.cells[i]]);
}

template class Assembler<2>;
template class Assembler<3>;
} // namespace snug::state
