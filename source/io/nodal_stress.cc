#include <snug/base/assertions.h>
#include <snug/elasticity/element.h>
#include <snug/io/nodal_stress.h>
#include <snug/mesh/shared_nodes.h>
#include <snug/state/thermal.h>

#include <algorithm>
#include <cmath>

namespace snug::io {
namespace {
/// Points of a cell where its stress is evaluated, and weights of the extrapolation to the nodes.
/// The weights of a node add up to 1.
template <int dim>
struct StressSampling
{
  std::vector<dealii::Point<dim>>  points;  ///< p^dim Gauss points
  std::vector<std::vector<double>> weights; ///< [node][point]
};

template <int dim>
StressSampling<dim> stress_sampling(unsigned int degree)
{
  StressSampling<dim> sampling;
  for (const auto &at : mesh::lagrange_gauss_points<dim>(degree - 1))
    sampling.points.push_back(at.point);
  // In the coordinates 1/2 + sqrt(3) (x - 1/2) the two Gauss points per axis are 0 and 1, so that
  // the functions of degree p - 1 interpolate between them.
  for (const auto &node : mesh::lagrange_nodes<dim>(degree))
    {
      const auto centre = geometry::unit_centre<dim>();
      sampling.weights.push_back(
        mesh::lagrange_point<dim>(degree - 1, centre + std::sqrt(3.) * (node.point - centre))
          .value);
    }
  return sampling;
}

constexpr unsigned int n_stress = dealii::SymmetricTensor<2, 3>::n_independent_components;

using Stress = dealii::SymmetricTensor<2, 3>;

/// A mesh with the fields on it.
template <int dim>
struct Solved
{
  using Field = typename mesh::BodyMesh<dim>::Field;
  using Nodes = typename elasticity::Element<dim>::Nodes;

  const mesh::BodyMesh<dim>                &mesh;
  const std::vector<state::BodyModel<dim>> &bodies;
  const std::vector<state::BodyLoads<dim>> &loads;
  const Field                              &positions, &displacement;
  const unsigned int                        n_regions = n_stress_regions(mesh);

  Nodes at_nodes(const typename mesh::BodyMesh<dim>::Cell &cell, const Field &field) const
  {
    Nodes values;
    for (const unsigned int node : cell.nodes)
      values.push_back(field[node]);
    return values;
  }

  elasticity::ThermalStrain<dim>
  thermal_strain(const typename mesh::BodyMesh<dim>::Cell &cell) const
  {
    if (loads.empty())
      return {};
    return state::thermal_strain<dim>(loads[cell.body], bodies[cell.body].material(cell),
                                      at_nodes(cell, mesh.reference_positions()));
  }

  std::size_t index(const typename mesh::BodyMesh<dim>::Cell &cell, unsigned int node) const
  {
    return std::size_t(cell.nodes[node]) * n_regions + cell.region;
  }
};

/// Return the stress at the points of all cells, with the points of a cell one after the other.
template <int dim>
std::vector<Stress> sampled_stress(const Solved<dim> &solved, const StressSampling<dim> &sampling)
{
  const auto                           &mesh = solved.mesh;
  std::vector<elasticity::Element<dim>> elements;
  for (const auto &body : solved.bodies)
    elements.emplace_back(mesh.degree(), mesh.idealization(), body.formulation);
  std::vector<mesh::LagrangePoint<dim>> shapes;
  for (const auto &point : sampling.points)
    shapes.push_back(mesh::lagrange_point<dim>(mesh.degree(), point));
  std::vector<Stress> result;
  for (const auto &cell : mesh.cells())
    {
      const auto &material = solved.bodies[cell.body].material(cell);
      const auto  of_cell =
        elements[cell.body].stresses(solved.at_nodes(cell, solved.positions), material,
                                     solved.at_nodes(cell, solved.displacement), shapes,
                                     solved.thermal_strain(cell));
      result.insert(result.end(), of_cell.begin(), of_cell.end());
    }
  return result;
}

/// Sums of y y' and y stress with y = (1, x_i - o), over cells with centers x_i, from an origin o.
template <int dim>
struct Moments
{
  static constexpr unsigned int n_numbers = (dim + 1) * (dim + 2) / 2 + (dim + 1) * n_stress;

  dealii::Tensor<2, dim + 1>  squares;
  std::array<Stress, dim + 1> stress;

  /// Call visit(number) for all different numbers.
  template <typename Visit>
  void visit_numbers(const Visit &visit)
  {
    for (int i = 0; i <= dim; ++i)
      {
        for (int j = 0; j <= i; ++j)
          visit(squares[i][j]);
        for (unsigned int c = 0; c < n_stress; ++c)
          visit(stress[i].access_raw_entry(c));
      }
    for (int i = 0; i <= dim; ++i)
      for (int j = 0; j < i; ++j)
        squares[j][i] = squares[i][j];
  }

  void add(const Moments &other, const dealii::Tensor<2, dim + 1> &map)
  {
    squares += map * other.squares * transpose(map);
    for (int i = 0; i <= dim; ++i)
      for (int j = 0; j <= dim; ++j)
        stress[i] += map[i][j] * other.stress[j];
  }

  /// Return the slopes of the linear field that fits best, along axes in which the centers spread.
  std::array<Stress, dim> slopes() const
  {
    // In units of a cell, neighbors lie at -1 and 1. Centers of a single bent layer do not
    // determine the variation across the layer.
    const double                    least_spread = 0.03;
    const double                    n            = squares[0][0];
    dealii::SymmetricTensor<2, dim> spread;
    std::array<Stress, dim>         along, result;
    for (int i = 0; i < dim; ++i)
      {
        for (int j = 0; j <= i; ++j)
          spread[i][j] = squares[i + 1][j + 1] / n - squares[i + 1][0] / n * squares[j + 1][0] / n;
        along[i] = stress[i + 1] / n - squares[i + 1][0] / n * stress[0] / n;
      }
    for (const auto &[value, axis] : eigenvectors(spread))
      if (value > least_spread)
        {
          Stress slope;
          for (int i = 0; i < dim; ++i)
            slope += axis[i] / value * along[i];
          for (int i = 0; i < dim; ++i)
            result[i] += axis[i] * slope;
        }
    return result;
  }
};

/// A cell of degree 1 as a box: x = center + axes z.
template <int dim>
struct CellFrame
{
  dealii::Tensor<1, dim> centre;
  dealii::Tensor<2, dim> to_cell; ///< z = to_cell (x - centre)

  explicit CellFrame(const typename elasticity::Element<dim>::Nodes &X)
  {
    dealii::Tensor<2, dim> axes;
    for (unsigned int a = 0; a < X.size(); ++a)
      {
        centre += X[a] / double(X.size());
        for (int i = 0; i < dim; ++i)
          for (int k = 0; k < dim; ++k)
            axes[i][k] += (a >> k & 1 ? 2. : -2.) / X.size() * X[a][i];
      }
    to_cell = invert(axes);
  }
};

/// Return the slopes of cells of degree 1 along the axes of their frames. They are slopes of the
/// linear field that best fits the stresses of the cells around each cell, with larger weights
/// for cells that share more of its nodes. The constant stress of a cell alone would cause
/// first-order errors at nodes of the surface of a body. Collective.
template <int dim>
std::vector<std::array<Stress, dim>> stress_slopes(const Solved<dim>         &solved,
                                                   const std::vector<Stress> &of_cells)
{
  const auto                 &mesh = solved.mesh;
  std::vector<Moments<dim>>   at_nodes(mesh.n_local_nodes() * solved.n_regions);
  std::vector<CellFrame<dim>> frames;
  for (unsigned int c = 0; c < mesh.cells().size(); ++c)
    {
      const auto &cell = mesh.cells()[c];
      frames.emplace_back(solved.at_nodes(cell, solved.positions));
      for (unsigned int a = 0; a < cell.nodes.size(); ++a)
        {
          dealii::Tensor<1, dim + 1> y;
          y[0] = 1.;
          for (int i = 0; i < dim; ++i)
            y[i + 1] = frames.back().centre[i] - solved.positions[cell.nodes[a]][i];
          auto &moments = at_nodes[solved.index(cell, a)];
          moments.squares += outer_product(y, y);
          for (int i = 0; i <= dim; ++i)
            moments.stress[i] += y[i] * of_cells[c];
        }
    }
  std::vector<double> numbers;
  for (auto &moments : at_nodes)
    moments.visit_numbers([&](const double number) { numbers.push_back(number); });
  mesh::sum_at_shared_nodes(mesh, Moments<dim>::n_numbers * solved.n_regions, numbers);
  auto next = numbers.begin();
  for (auto &moments : at_nodes)
    moments.visit_numbers([&](double &number) { number = *next++; });

  std::vector<std::array<Stress, dim>> result;
  for (unsigned int c = 0; c < mesh.cells().size(); ++c)
    {
      const auto  &cell = mesh.cells()[c];
      Moments<dim> around;
      for (unsigned int a = 0; a < cell.nodes.size(); ++a)
        {
          // Shift from the node to the frame of the cell.
          const auto shift =
            frames[c].to_cell * (solved.positions[cell.nodes[a]] - frames[c].centre);
          dealii::Tensor<2, dim + 1> map;
          map[0][0] = 1.;
          for (int i = 0; i < dim; ++i)
            {
              map[i + 1][0] = shift[i];
              for (int j = 0; j < dim; ++j)
                map[i + 1][j + 1] = frames[c].to_cell[i][j];
            }
          around.add(at_nodes[solved.index(cell, a)], map);
        }
      auto       slopes = around.slopes();
      const auto axes   = frames[c].to_cell;
      // The slopes with respect to positions follow from sum_k slope_k z_k = sum_i (sum_k slope_k
      // axes_ki) (x - centre)_i.
      result.emplace_back();
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k)
          result.back()[i] += axes[k][i] * slopes[k];
    }
  return result;
}

/// Return, per local node and region, the weighted sums of the components of stress and the sum
/// of weights, over this rank's cells. Collective.
template <int dim>
std::vector<double> stress_sums(const Solved<dim> &solved)
{
  const auto &mesh     = solved.mesh;
  const auto  sampling = stress_sampling<dim>(mesh.degree());
  const auto  sampled  = sampled_stress(solved, sampling);
  const auto  slopes =
    mesh.degree() == 1 ? stress_slopes(solved, sampled) : std::vector<std::array<Stress, dim>>();
  // Use a plane section, because weights by the radius or thickness would spoil the mean of a
  // linear field.
  const elasticity::Element<dim> flat(mesh.degree());
  const std::size_t              n_sums = n_stress + 1;
  std::vector<double>            sums(n_sums * solved.n_regions * mesh.n_local_nodes());
  for (unsigned int c = 0; c < mesh.cells().size(); ++c)
    {
      const auto            &cell   = mesh.cells()[c];
      const auto             X      = solved.at_nodes(cell, solved.positions);
      const double           weight = 1. / flat.volume(X); // of the section
      dealii::Tensor<1, dim> centre;
      for (const auto &x : X)
        centre += x / double(X.size());
      for (unsigned int a = 0; a < X.size(); ++a)
        {
          Stress stress;
          for (unsigned int q = 0; q < sampling.points.size(); ++q)
            stress += sampling.weights[a][q] * sampled[c * sampling.points.size() + q];
          for (int i = 0; i < dim && !slopes.empty(); ++i)
            stress += (X[a] - centre)[i] * slopes[c][i];
          double *sum = &sums[(n_stress + 1) * solved.index(cell, a)];
          for (unsigned int component = 0; component < n_stress; ++component)
            sum[component] += weight * stress.access_raw_entry(component);
          sum[n_stress] += weight;
        }
    }
  return sums;
}
} // namespace

/// Return the number of regions, the same for all bodies, so that one index serves all nodes.
template <int dim>
unsigned int n_stress_regions(const mesh::BodyMesh<dim> &mesh)
{
  std::size_t n = 1;
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    n = std::max(n, mesh.geometry(body).region_names().size());
  return n;
}

template <int dim>
std::vector<dealii::SymmetricTensor<2, 3>>
nodal_stress(const mesh::BodyMesh<dim>                 &mesh,
             const std::vector<state::BodyModel<dim>>  &bodies,
             const typename mesh::BodyMesh<dim>::Field &positions,
             const typename mesh::BodyMesh<dim>::Field &displacement,
             const std::vector<state::BodyLoads<dim>>  &loads)
{
  SNUG_ASSERT_EQUAL(bodies.size(), mesh.n_bodies());
  const Solved<dim>  solved{mesh, bodies, loads, positions, displacement};
  auto               sums      = stress_sums(solved);
  const unsigned int n_regions = solved.n_regions;
  // Sum values and weights together, so that the mean is over the cells of all ranks.
  mesh::sum_at_shared_nodes(mesh, (n_stress + 1) * n_regions, sums);

  std::vector<dealii::SymmetricTensor<2, 3>> stress(n_regions * mesh.n_local_nodes());
  const auto                                 weight = [&](unsigned int i) {
    return sums[std::size_t(n_stress + 1) * i + n_stress];
  };
  for (unsigned int i = 0; i < stress.size(); ++i)
    // Without weight, no cell of this region has the node.
    if (weight(i) > 0.)
      for (unsigned int c = 0; c < n_stress; ++c)
        stress[i].access_raw_entry(c) = sums[std::size_t(n_stress + 1) * i + c] / weight(i);
  // Interpolate at hanging nodes, because only the cells on the fine side have them, and their
  // mean would jump across the face.
  for (const auto &hanging : mesh.hanging())
    for (unsigned int r = 0; r < n_regions; ++r)
      {
        dealii::SymmetricTensor<2, 3> sum;
        bool                          inside = true;
        for (const auto &[master, factor] : hanging.masters)
          {
            sum += factor * stress[master * n_regions + r];
            inside = inside && weight(master * n_regions + r) > 0.;
          }
        // If a master lies outside the region, keep the mean of the cells.
        if (inside)
          stress[hanging.node * n_regions + r] = sum;
      }
  return stress;
}

#define SNUG_INSTANTIATE(dim)                                                                        \
  template unsigned int                               n_stress_regions(const mesh::BodyMesh<dim> &); \
  template std::vector<dealii::SymmetricTensor<2, 3>> nodal_stress(                                  \
    const mesh::BodyMesh<dim> &, const std::vector<state::BodyModel<dim>> &,                         \
    const mesh::BodyMesh<dim>::Field &, const mesh::BodyMesh<dim>::Field &,                          \
    const std::vector<state::BodyLoads<dim>> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::io
