#include <snug/base/run_context.h>
#include <snug/elasticity/stress.h>
#include <snug/io/fields.h>
#include <snug/io/nodal_stress.h>
#include <snug/io/state_files.h>
#include <snug/io/text_file.h>
#include <snug/io/vtu_grid.h>
#include <snug/mesh/shared_nodes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <unordered_map>

namespace snug::io {
namespace {
/// Return the shares of a node gradient summed over ranks, with shares of hanging nodes
/// distributed to their masters. The result is zero if @p gradient is null. Shares are given on
/// the ranks of the cells, but a picture needs the sum at every node. Collective.
template <int dim>
std::vector<double> summed(const mesh::BodyMesh<dim>                 &mesh,
                           const typename mesh::BodyMesh<dim>::Field *gradient)
{
  std::vector<double> values(dim * mesh.n_local_nodes());
  // The pointer is null on all ranks or on none, because the sum below is collective.
  if (gradient == nullptr)
    return values;
  auto field = *gradient;
  // Distribute the gradient of samples to the nodes of their faces, and of hanging nodes to their
  // masters.
  mesh.distribute_samples(field);
  mesh.distribute_hanging(field);
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      values[dim * node + c] = field[node][c];
  mesh::sum_at_shared_nodes(mesh, dim, values);
  return values;
}

/// A quantity of points and the function that appends its components to a list.
struct PointField
{
  Quantity                                                                           quantity;
  std::function<void(unsigned int node, unsigned int region, std::vector<double> &)> append;
};

struct CellField
{
  Quantity                                 quantity;
  std::function<double(unsigned int cell)> value;
};

template <typename Field>
std::vector<Quantity> quantities(const std::vector<Field> &fields)
{
  std::vector<Quantity> result;
  for (const auto &field : fields)
    result.push_back(field.quantity);
  return result;
}

/// Return the fields that @p parameters request, and the fields that every picture needs.
template <typename Field>
std::vector<Field> written(const std::vector<Field>      &fields,
                           const scene::OutputParameters &parameters)
{
  std::vector<Field> result;
  for (const auto &field : fields)
    if (const auto &name = field.quantity.name;
        name == "displacement" || name == "body" || parameters.has(name))
      result.push_back(field);
  return result;
}

/// The fields and positions of a state, from which grids of bodies and boundaries are made.
template <int dim>
struct DrawnState
{
  const mesh::BodyMesh<dim>          &mesh;
  typename mesh::BodyMesh<dim>::Field positions;
  std::vector<PointField>             point_fields;
  std::vector<CellField>              cell_fields;
};

/// This class makes the grid of one block. Cells share points. A node has one point in each region
/// that meets there.
template <int d, int dim>
class BlockGrid
{
public:
  explicit BlockGrid(const DrawnState<dim> &state)
    : state(state)
    , n_regions(n_stress_regions(state.mesh))
    , grid(quantities(state.point_fields), quantities(state.cell_fields))
  {}

  /// Add the nodes of a cell, or of a boundary face of the cell. Both show the values of the cell.
  void add(const std::vector<unsigned int> &nodes, const unsigned int cell)
  {
    grid.add_cell(points_of(nodes, cell), values_of(cell));
  }

  /// Add the nodes of a tetrahedron with the cell, or of one of its faces.
  void add_simplex(const std::vector<unsigned int> &nodes, const unsigned int cell)
  {
    grid.add_simplex(points_of(nodes, cell), values_of(cell));
  }

  std::string declarations() const { return grid.declarations(); }

  /// Return the piece of the text of a VTU file, which is empty if there is no cell.
  std::string piece(const unsigned int compression) const
  {
    return grid.is_empty() ? std::string() : grid.piece(compression);
  }

private:
  const DrawnState<dim>                        &state;
  unsigned int                                  n_regions;
  VtuGrid<d, dim>                               grid;
  std::unordered_map<std::size_t, unsigned int> number; ///< of the point of (node, region)

  std::vector<unsigned int> points_of(const std::vector<unsigned int> &nodes,
                                      const unsigned int               cell)
  {
    const unsigned int        region = state.mesh.cells()[cell].region;
    std::vector<unsigned int> points;
    std::vector<double>       values;
    for (const unsigned int node : nodes)
      {
        const auto [place, is_new] = number.try_emplace(std::size_t(node) * n_regions + region, 0);
        if (is_new)
          {
            values.clear();
            for (const auto &field : state.point_fields)
              field.append(node, region, values);
            place->second = grid.add_point(state.positions[node], values);
          }
        points.push_back(place->second);
      }
    return points;
  }

  std::vector<double> values_of(const unsigned int cell) const
  {
    std::vector<double> values;
    for (const auto &field : state.cell_fields)
      values.push_back(field.value(cell));
    return values;
  }
};

/// This class draws boundary faces: three faces on a tetrahedron as one triangle.
template <int dim>
class Triangles
{
public:
  using Face = typename mesh::BodyMesh<dim>::Face;

  explicit Triangles(const mesh::BodyMesh<dim> &mesh) : mesh(mesh)
  {
    for (const auto &face : mesh.boundary_faces())
      if (mesh.tetrahedron(face.cell) != nullptr)
        ++n_faces[key(face)];
  }

  void draw(const Face &face, BlockGrid<dim - 1, dim> &grid) const
  {
    const auto *tetrahedron = mesh.tetrahedron(face.cell);
    // Formulas may divide a triangle into several boundaries.
    if (tetrahedron == nullptr || n_faces.at(key(face)) < 3)
      grid.add(face.nodes, face.cell);
    else if (const auto nodes = tetrahedron->face(opposite(face)); nodes[0] == corner_node(face))
      grid.add_simplex({nodes.begin(), nodes.end()}, face.cell);
  }

private:
  const mesh::BodyMesh<dim>                          &mesh;
  std::map<std::array<unsigned int, 3>, unsigned int> n_faces;

  unsigned int corner_node(const Face &face) const { return mesh.cells()[face.cell].nodes[0]; }

  /// Return the corner of the tetrahedron that is not on the triangle of a face.
  unsigned int opposite(const Face &face) const
  {
    const auto &cells = mesh.tetrahedron(face.cell)->cells;
    return mesh::tetrahedron_axes[std::find(cells.begin(), cells.end(), face.cell) - cells.begin()]
                                 [face.number / 2];
  }

  std::array<unsigned int, 3> key(const Face &face) const
  {
    return {{mesh.tetrahedron(face.cell)->cells[0], opposite(face), face.boundary}};
  }
};

/// Return the blocks of the bodies, then of their boundaries.
template <int dim>
std::vector<Block> blocks_of(const DrawnState<dim>          &state,
                             const std::vector<std::string> &body_names,
                             const unsigned int              compression)
{
  const auto                                       &mesh = state.mesh;
  std::vector<BlockGrid<dim, dim>>                  bodies;
  std::vector<std::vector<BlockGrid<dim - 1, dim>>> boundaries;
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    {
      bodies.emplace_back(state);
      boundaries.emplace_back(mesh.geometry(body).boundary_names().size(),
                              BlockGrid<dim - 1, dim>(state));
    }
  for (unsigned int k = 0; k < mesh.cells().size(); ++k)
    if (const auto *tetrahedron = mesh.tetrahedron(k); tetrahedron == nullptr)
      bodies[mesh.cells()[k].body].add(mesh.cells()[k].nodes, k);
    else if (tetrahedron->cells[0] == k)
      bodies[mesh.cells()[k].body].add_simplex({tetrahedron->nodes.begin(),
                                                tetrahedron->nodes.end()},
                                               k);
  const Triangles<dim> triangles(mesh);
  for (const auto &face : mesh.boundary_faces())
    triangles.draw(face, boundaries[face.body][face.boundary]);

  std::vector<Block> result;
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    result.push_back({"bodies", body_names[body], bodies[body].piece(compression)});
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    for (unsigned int b = 0; b < boundaries[body].size(); ++b)
      result.push_back({"boundaries",
                        body_names[body] + '.' + mesh.geometry(body).boundary_names()[b],
                        boundaries[body][b].piece(compression)});
  return result;
}

/// Return global ids, so that subdomains of different ranks get different colors.
template <int dim>
std::vector<unsigned int> subdomain_of_cell(const mesh::BodyMesh<dim> &mesh,
                                            const mesh::Tearing       &tearing)
{
  std::vector<unsigned int> result(mesh.cells().size());
  for (unsigned int s = 0; s < tearing.subdomains.size(); ++s)
    for (const unsigned int cell : tearing.subdomains[s].cells)
      result[cell] = tearing.first_id + s;
  return result;
}
/// Return the field of vectors with @p dim components at the nodes.
template <int dim, typename Value>
PointField vector_field(const std::string &name, const Value &value)
{
  return {{name, dim}, [value](const unsigned int node, unsigned int, std::vector<double> &to) {
            const dealii::Tensor<1, dim> v = value(node);
            to.insert(to.end(), v.begin_raw(), v.end_raw());
          }};
}

/// Motions of the bodies to their positions.
template <int dim>
using Motions = std::vector<geometry::RigidMotion<dim>>;

/// Return the smoothed stress, also of sections with the components across them, and the von Mises
/// stress and the principal stresses of the smoothed stress, not the means over the cells. If none
/// of them is written, nothing is computed.
template <int dim>
std::vector<PointField> stress_fields(const typename FieldOutput<dim>::Sources &of,
                                      const Motions<dim>                       &motions,
                                      const state::ContactState<dim>           &state,
                                      const scene::OutputParameters            &parameters)
{
  if (!parameters.has("stress") && !parameters.has("von_mises") &&
      !parameters.has("principal_stress"))
    return {};
  using Stresses               = std::vector<dealii::SymmetricTensor<2, 3>>;
  const unsigned int n_regions = n_stress_regions(of.mesh);
  auto               in_bodies =
    nodal_stress(of.mesh, of.bodies, state.positions, state.displacement, of.load_case.bodies);
  for (unsigned int i = 0; i < in_bodies.size(); ++i)
    if (const auto &motion = motions[of.mesh.body_of_node(i / n_regions)]; !motion.is_identity())
      {
        // The axis across a section does not turn.
        dealii::Tensor<2, 3> Q = dealii::unit_symmetric_tensor<3>();
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            Q[c][d] = motion.Q[c][d];
        in_bodies[i] = symmetrize(Q * dealii::Tensor<2, 3>(in_bodies[i]) * transpose(Q));
      }
  const auto stresses = std::make_shared<const Stresses>(std::move(in_bodies));
  const auto stress   = [stresses, n_regions](const unsigned int node, const unsigned int region) {
    return (*stresses)[std::size_t(node) * n_regions + region];
  };
  return {{{"stress", 6},
           [stress](const unsigned int node, const unsigned int region, std::vector<double> &to) {
             const auto s = stress(node, region);
             to.insert(to.end(), {s[0][0], s[1][1], s[2][2], s[0][1], s[1][2], s[0][2]});
           }},
          {{"von_mises", 1},
           [stress](const unsigned int node, const unsigned int region, std::vector<double> &to) {
             to.push_back(elasticity::von_mises(stress(node, region)));
           }},
          {{"principal_stress", 3, {"maximum", "middle", "minimum"}},
           [stress](const unsigned int node, const unsigned int region, std::vector<double> &to) {
             const auto values = eigenvalues(stress(node, region)); // in descending order
             to.insert(to.end(), values.begin(), values.end());
           }}};
}
} // namespace

template <int dim>
std::string FieldOutput<dim>::write(const Sources                             &of,
                                    double                                     time,
                                    const state::ContactState<dim>            &state,
                                    const typename mesh::BodyMesh<dim>::Field *shape_gradient,
                                    const std::vector<double>                 *errors)
{
  const auto  &mesh      = of.mesh;
  const auto   subdomain = subdomain_of_cell(mesh, of.tearing);
  const auto   gradient = summed(mesh, parameters.has("shape_gradient") ? shape_gradient : nullptr);
  Motions<dim> motions;
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    motions.push_back(of.load_case.position.of_body(body));
  const auto motion = [&](const unsigned int node) -> const geometry::RigidMotion<dim> & {
    return motions[mesh.body_of_node(node)];
  };
  std::vector<PointField> at_points = stress_fields<dim>(of, motions, state, parameters);
  at_points.push_back({{"body", 1}, [&](const unsigned int node, unsigned int, auto &to) {
                         to.push_back(mesh.body_of_node(node));
                       }});
  at_points.push_back(vector_field<dim>("displacement", [&](const unsigned int node) {
    return motion(node).vector(state.displacement[node]);
  }));
  at_points.push_back(vector_field<dim>("design_displacement", [&](const unsigned int node) {
    return motion(node).vector(state.positions[node] - mesh.reference_positions()[node]);
  }));
  if (shape_gradient)
    at_points.push_back(vector_field<dim>("shape_gradient", [&](const unsigned int node) {
      dealii::Tensor<1, dim> v;
      for (unsigned int c = 0; c < dim; ++c)
        v[c] = gradient[std::size_t(dim) * node + c];
      return motion(node).vector(v);
    }));
  std::vector<CellField> of_cells = {
    {{"region", 1}, [&](const unsigned int cell) { return mesh.cells()[cell].region; }},
    {{"subdomain", 1}, [&](const unsigned int cell) { return subdomain[cell]; }}};
  if (errors)
    of_cells.push_back({{"error", 1}, [&](const unsigned int cell) {
                          const auto *tetrahedron = mesh.tetrahedron(cell);
                          if (tetrahedron == nullptr)
                            return (*errors)[cell];
                          double squares = 0.;
                          for (const unsigned int part : tetrahedron->cells)
                            squares += (*errors)[part] * (*errors)[part];
                          return std::sqrt(squares);
                        }});
  auto positions = state.positions;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    positions[node] = motion(node).point(positions[node]);
  const DrawnState<dim> drawn{mesh, positions, written(at_points, parameters),
                              written(of_cells, parameters)};
  const std::string     stem = "solution-" + padded(series.size(), 4);
  series.emplace_back(time, stem + ".vtm");
  const MPI_Comm comm = mesh.communicator();
  write_state(comm, directory, stem, blocks_of(drawn, body_names, parameters.compression),
              BlockGrid<dim, dim>(drawn).declarations(), parameters.ranks_per_file);
  throw_collectively(comm, [&] {
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      write_text_file(directory + "/solution.pvd", pvd(series));
  });
  return series.back().second;
}

template class FieldOutput<2>;
template class FieldOutput<3>;
} // namespace snug::io
