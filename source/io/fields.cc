#include <snug/base/narrow.h>
#include <snug/base/run_context.h>
#include <snug/elasticity/stress.h>
#include <snug/io/fields.h>
#include <snug/io/nodal_stress.h>
#include <snug/io/text_file.h>
#include <snug/io/vtu_grid.h>
#include <snug/mesh/shared_nodes.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <memory>

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

/// Return the grid of the cells of this rank, which share points. A node has one point in each
/// region that meets there.
template <int dim>
VtuGrid<dim, dim> grid_of(const mesh::BodyMesh<dim>                 &mesh,
                          const typename mesh::BodyMesh<dim>::Field &positions,
                          const std::vector<PointField>             &point_fields,
                          const std::vector<CellField>              &cell_fields)
{
  VtuGrid<dim, dim>         grid(quantities(point_fields), quantities(cell_fields));
  const unsigned int        n_regions = n_stress_regions(mesh), none = -1;
  std::vector<unsigned int> number(std::size_t(mesh.n_local_nodes()) * n_regions, none);
  for (unsigned int k = 0; k < mesh.cells().size(); ++k)
    {
      const auto               &cell = mesh.cells()[k];
      std::vector<unsigned int> points;
      std::vector<double>       values;
      for (const unsigned int node : cell.nodes)
        {
          unsigned int &point = number[std::size_t(node) * n_regions + cell.region];
          if (point == none)
            {
              values.clear();
              for (const auto &field : point_fields)
                field.append(node, cell.region, values);
              point = grid.add_point(positions[node], values);
            }
          points.push_back(point);
        }
      values.clear();
      for (const auto &field : cell_fields)
        values.push_back(field.value(k));
      grid.add_cell(points, values);
    }
  return grid;
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

/// Return the smoothed stress, also of sections with 3 x 3 components, and the von Mises stress
/// of the smoothed stress, not the mean of the von Mises stresses of the cells. If neither is
/// written, nothing is computed.
template <int dim>
std::vector<PointField> stress_fields(const typename FieldOutput<dim>::Sources &of,
                                      const Motions<dim>                       &motions,
                                      const state::ContactState<dim>           &state,
                                      const scene::OutputParameters            &parameters)
{
  if (!parameters.has("stress") && !parameters.has("von_mises"))
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
  return {{{"stress", 9},
           [stress](const unsigned int node, const unsigned int region, std::vector<double> &to) {
             for (unsigned int i = 0; i < 9; ++i)
               to.push_back(stress(node, region)[i / 3][i % 3]);
           }},
          {{"von_mises", 1},
           [stress](const unsigned int node, const unsigned int region, std::vector<double> &to) {
             to.push_back(elasticity::von_mises(stress(node, region)));
           }}};
}

/// Return the texts of @p n ranks on the first of them, nothing on the other ranks. Collective.
std::vector<std::string> of_ranks(MPI_Comm all, const unsigned int n, const std::string &text)
{
  const int rank = narrow<int>(dealii::Utilities::MPI::this_mpi_process(all));
  MPI_Comm  some;
  MPI_Comm_split(all, rank / narrow<int>(n), rank, &some);
  auto texts = dealii::Utilities::MPI::gather(some, text);
  MPI_Comm_free(&some);
  return texts;
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
    of_cells.push_back({{"error", 1}, [&](const unsigned int cell) { return (*errors)[cell]; }});
  auto positions = state.positions;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    positions[node] = motion(node).point(positions[node]);
  const auto grid =
    grid_of(mesh, positions, written(at_points, parameters), written(of_cells, parameters));

  const MPI_Comm           comm     = mesh.communicator();
  const auto               rank     = dealii::Utilities::MPI::this_mpi_process(comm);
  const std::string        stem     = "solution-" + padded(series.size(), 4);
  const unsigned int       per_file = parameters.ranks_per_file;
  std::vector<std::string> files;
  for (unsigned int r = 0; r < dealii::Utilities::MPI::n_mpi_processes(comm); r += per_file)
    // The .pvtu file names the files of all ranks.
    files.push_back(stem + "." + padded(r / per_file, 4) + ".vtu");
  series.emplace_back(time, stem + ".pvtu");
  const auto pieces = of_ranks(comm, per_file, grid.piece(parameters.compression));
  throw_collectively(comm, [&] {
    if (!pieces.empty())
      write_text_file(directory + "/" + files[rank / per_file], vtu(pieces));
    if (rank != 0)
      return;
    write_text_file(directory + "/" + stem + ".pvtu", grid.pvtu(files));
    write_text_file(directory + "/solution.pvd", pvd(series));
  });
  return series.back().second;
}

template class FieldOutput<2>;
template class FieldOutput<3>;
} // namespace snug::io
