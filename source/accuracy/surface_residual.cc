#include <snug/accuracy/surface_residual.h>
#include <snug/base/run_context.h>
#include <snug/contact/pair_geometry.h>
#include <snug/mesh/face_nodes.h>
#include <snug/mesh/refined_cells.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace snug::accuracy {
namespace {
/// Differences of positions up to this share of their size are rounding.
const double position_round_off = 1e-11;

/// Gaps below 0 by less than this share of the face size are closed gaps, not overlaps.
const double closed_part = 1e-9;

/// Degree of gaps between curved bodies where faces are small enough for their contact. A higher
/// degree would treat a narrow crest on a single face as smooth.
constexpr unsigned int rough_degree = 2;

/// Faces below this share of the contact area are not refined for roughness. Steps, which have no
/// pressure that a mesh could resolve, would otherwise be refined to the last level.
const double small_face = 1. / 4096.;

/// Exponent of peaks of pressure, which count more than their force: a measure of the peak raises
/// them to a power. A power above 4 would refine kinks, where the pressure is unbounded but no
/// measure is, to the last level.
const double peak_power = 4.;

/// Points of a face, with the shape functions of its nodes and of its samples at the points.
template <int dim>
struct FacePoints
{
  unsigned int n; ///< number per direction, the first direction fastest
  std::vector<typename faces::FaceShape<dim>::Values> nodes, samples;

  /// Use nonuniform distances, which are in resonance with no formula.
  FacePoints(const faces::FaceShape<dim> &shape, const unsigned int degree, const unsigned int n)
    : n(n)
  {
    const auto coordinate = [&](const unsigned int j) {
      const double part = j * 0.6180339887498949;
      return (j + 0.25 + 0.5 * (part - std::floor(part))) / n;
    };
    for (unsigned int i = 0; i < (dim == 2 ? n : n * n); ++i)
      {
        dealii::Point<dim - 1> xi;
        for (unsigned int d = 0, rest = i; d < dim - 1; ++d, rest /= n)
          xi[d] = coordinate(rest % n);
        nodes.push_back(shape.at(xi));
        samples.push_back(mesh::lagrange_point<dim - 1>(degree, xi));
      }
  }
};

/// Deviation of a function of the position on a face from a polynomial through it.
struct Oscillation
{
  double mean = 0., slope = 0.; ///< mean of the absolute value, maximum of the gradient
  /// minimum gap: function minus its nodal interpolation, plus the gap at the nodes
  double least = std::numeric_limits<double>::infinity();
};

template <int dim>
class FaceSampler
{
public:
  using Face     = typename mesh::BodyMesh<dim>::Face;
  using Field    = mesh::Field<dim>;
  using Function = std::function<double(const dealii::Tensor<1, dim> &)>;

  /// @p degree is the degree of the polynomial. References must outlive this object. Collective.
  FaceSampler(const mesh::BodyMesh<dim> &mesh, const Field &positions, const unsigned int degree)
    : mesh(mesh)
    , positions(positions)
    , shape(mesh.degree())
    , degree(degree)
    , lattice_points(mesh::lagrange_nodes<dim - 1>(degree))
    , n_of(samples_of_level(mesh, Sampling::search))
  {}

  /// Return n dA at the center of the face, for the area of the reference face.
  dealii::Tensor<1, dim> area(const Face &face) const
  {
    const auto centre = shape.at(geometry::unit_centre<dim - 1>());
    return faces::area_vector(faces::tangents<dim>(centre, face.nodes, positions));
  }

  dealii::Tensor<1, dim> centre(const Face &face) const
  {
    return interpolated(shape.at(geometry::unit_centre<dim - 1>()), face, positions);
  }

  Oscillation operator()(const Face &face, const Function &of, const std::vector<double> &gaps)
  {
    const unsigned int n =
      std::max(2 * mesh::surface_degree, n_of(mesh::level(mesh.cell_id(face.cell))));
    auto &points = by_n[n];
    if (!points)
      points = std::make_unique<FacePoints<dim>>(shape, degree, n);
    std::vector<double> lattice, at_nodes;
    for (const auto &sample : lattice_points)
      lattice.push_back(of(place(face, sample.point, shape.at(sample.point))));
    const double length = area(face).norm();
    for (const unsigned int node : face.nodes)
      at_nodes.push_back(of(positions[node]));
    std::vector<dealii::Tensor<1, dim>> x;
    std::vector<double>                 r;
    Oscillation                         result;
    for (unsigned int i = 0; i < points->nodes.size(); ++i)
      {
        x.push_back(place(face, points->nodes[i].point, points->nodes[i]));
        const double value = of(x[i]);
        r.push_back(value);
        for (unsigned int k = 0; k < lattice.size(); ++k)
          r[i] -= points->samples[i].value[k] * lattice[k];
        if (std::abs(r[i]) <= position_round_off * std::max(x[i].norm(), length))
          r[i] = 0.;
        result.mean += std::abs(r[i]) / points->nodes.size();
        double gap = value;
        for (unsigned int a = 0; a < gaps.size(); ++a)
          gap += points->nodes[i].value[a] * (gaps[a] - at_nodes[a]);
        if (!gaps.empty())
          result.least = std::min(result.least, gap);
      }
    for (unsigned int i = 0; i < r.size(); ++i)
      for (unsigned int d = 0, step = 1; d < dim - 1; ++d, step *= n)
        if (i / step % n + 1 < n && r[i] != r[i + step])
          result.slope =
            std::max(result.slope, std::abs(r[i + step] - r[i]) / (x[i + step] - x[i]).norm());
    for (const double gap : gaps)
      result.least = std::min(result.least, gap);
    return result;
  }

private:
  const mesh::BodyMesh<dim>                               &mesh;
  const Field                                             &positions;
  const faces::FaceShape<dim>                              shape;
  const unsigned int                                       degree;
  const std::vector<mesh::LagrangePoint<dim - 1>>          lattice_points;
  std::function<unsigned int(unsigned int)>                n_of;
  std::map<unsigned int, std::unique_ptr<FacePoints<dim>>> by_n;

  static dealii::Tensor<1, dim> interpolated(const typename faces::FaceShape<dim>::Values &at,
                                             const Face                                   &face,
                                             const Field                                  &field)
  {
    dealii::Tensor<1, dim> sum;
    for (unsigned int a = 0; a < face.nodes.size(); ++a)
      sum += at.value[a] * field[face.nodes[a]];
    return sum;
  }

  /// Return a position on the true surface, moved with the mesh.
  dealii::Tensor<1, dim> place(const Face                                   &face,
                               const dealii::Point<dim - 1>                 &xi,
                               const typename faces::FaceShape<dim>::Values &at) const
  {
    return mesh.true_position(face.cell, mesh::point_on_face<dim>(face.number, xi)) +
           interpolated(at, face, positions) - interpolated(at, face, mesh.reference_positions());
  }
};
} // namespace

namespace {
/// Return the volumes of bodies and add the volumes between the faces and their interpolation.
template <int dim>
std::vector<double> add_volumes(const mesh::BodyMesh<dim> &mesh, std::vector<UnseenVolume> &unseen)
{
  std::vector<double> volumes(mesh.n_bodies(), 0.);
  FaceSampler<dim>    sampler(mesh, mesh.reference_positions(), mesh::surface_degree);
  // Call throw_collectively(), because a formula may fail at a position that only one rank has.
  throw_collectively(mesh.communicator(), [&]() {
    for (const auto &face : mesh.boundary_faces())
      {
        const auto area = sampler.area(face);
        volumes[face.body] += area * sampler.centre(face) / dim;
        unseen[face.body].of_cells[face.cell] +=
          area.norm() *
          sampler(face, [&](const auto &x) { return area * x / area.norm(); }, {}).mean;
      }
  });
  dealii::Utilities::MPI::sum(volumes, mesh.communicator(), volumes);
  return volumes;
}
} // namespace

template <int dim>
std::vector<UnseenVolume> unseen_volumes(const mesh::BodyMesh<dim> &mesh)
{
  std::vector<UnseenVolume> result(mesh.n_bodies());
  for (auto &body : result)
    body.of_cells.assign(mesh.cells().size(), 0.);
  const auto volumes = add_volumes(mesh, result);
  for (unsigned int body = 0; body < result.size(); ++body)
    {
      for (double &part : result[body].of_cells)
        {
          part /= std::abs(volumes[body]);
          result[body].missed += part;
        }
      result[body].missed = dealii::Utilities::MPI::sum(result[body].missed, mesh.communicator());
    }
  return result;
}

namespace {
using Boundaries = std::set<std::pair<unsigned int, unsigned int>>; ///< body, boundary

/// A pair in a state.
template <int dim>
class PairInState
{
public:
  PairInState(const state::StateSolver<dim>        &solver,
              const state::ContactState<dim>       &state,
              const std::vector<contact::Row<dim>> &rows,
              const unsigned int                    p)
    : mesh(solver.mesh())
    , surface(solver.surface())
    , pair(solver.contact(state.load_case).pairs()[p])
    , gaps(surface.n_nodes(), std::numeric_limits<double>::infinity())
  {
    for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
      motions.push_back(solver.motion(state.load_case, body));
    double compliance = 0.;
    slave             = side(solver, contact::faces_of(surface, pair.slave), compliance);
    if (!pair.obstacle)
      master = side(solver, contact::faces_of(surface, pair.master), compliance);
    modulus = 1. / compliance;
    for (unsigned int i = 0; i < rows.size(); ++i)
      if (solver.contact(state.load_case).places()[i].pair == p)
        {
          const auto &of = state.contact[i];
          force += std::max(0., of.force);
          contact_area += of.active ? of.area : 0.;
          for (const auto &[node, c] : rows[i].coefficients)
            if (c.norm() > 0.)
              gaps[node] = std::min(gaps[node], of.active ? 0. : std::max(0., of.gap));
        }
  }

  /// Add the contributions of the faces of this rank.
  void add(const contact::PointGaps<dim> &given, FaceSampler<dim> &sampler, RoughPressure &to) const
  {
    for (const auto &face : mesh.boundary_faces())
      {
        const bool is_slave = slave.count({face.body, face.boundary}) > 0;
        if (!is_slave && master.count({face.body, face.boundary}) == 0)
          continue;
        const auto at_nodes = gaps_at(face.nodes);
        if (at_nodes.empty())
          continue;
        const bool is_smooth =
          pair.obstacle || face.known_surface != geometry::BodyGeometry<dim>::no_surface;
        const auto   area  = sampler.area(face);
        const double dA    = area.norm() * mesh.idealization().weight(sampler.centre(face));
        const auto   found = sampler(
          face,
          [&](const dealii::Tensor<1, dim> &x) {
            return (is_slave ? given.given(motions[face.body].point(x), {face.body, face.boundary})
                               : 0.) -
                   (is_smooth ? 0. : area * x / area.norm());
          },
          at_nodes);
        const double part = this->part(found, std::pow(area.norm(), 1. / (dim - 1)), dA);
        to.of_cells[face.cell] += part;
        to.to_refine[face.cell] += dA > small_face * contact_area ? part : 0.;
        to.missed += part;
      }
  }

private:
  const mesh::BodyMesh<dim>              &mesh;
  const mesh::Surface<dim>               &surface;
  const contact::Pair                    &pair;
  std::vector<geometry::RigidMotion<dim>> motions; ///< of the bodies
  Boundaries                              slave, master;
  double                                  modulus;
  double                                  force = 0., contact_area = 0.; ///< of rows that push
  std::vector<double> gaps; ///< at surface nodes: minimum over their rows, or infinite

  /// Add (1 - nu^2) / E, the minimum over the cells of the side, to @p compliance. Collective.
  static Boundaries side(const state::StateSolver<dim>   &solver,
                         const std::vector<unsigned int> &faces,
                         double                          &compliance)
  {
    Boundaries result;
    for (const unsigned int face : faces)
      result.emplace(solver.surface().faces()[face].body, solver.surface().faces()[face].boundary);
    double least = std::numeric_limits<double>::max();
    for (const auto &face : solver.mesh().boundary_faces())
      if (result.count({face.body, face.boundary}) > 0)
        {
          const auto &material =
            solver.model().bodies[face.body].material(solver.mesh().cells()[face.cell]);
          const double nu = material.poissons_ratio;
          least           = std::min(least, (1. - nu * nu) / material.youngs_modulus);
        }
    compliance += dealii::Utilities::MPI::min(least, solver.mesh().communicator());
    return result;
  }

  /// Return the gaps at the nodes. A node without a row takes the maximum gap of the nodes with a
  /// row. Empty if no node has a row.
  std::vector<double> gaps_at(const std::vector<unsigned int> &local_nodes) const
  {
    std::vector<double> result;
    double              largest = -1.;
    for (const unsigned int node : local_nodes)
      {
        result.push_back(gaps[surface.find(mesh.global_node(node))]);
        if (std::isfinite(result.back()))
          largest = std::max(largest, result.back());
      }
    for (double &gap : result)
      gap = std::min(gap, largest);
    return largest < 0. ? std::vector<double>() : result;
  }

  /// Return the contribution of a face. For a pair without a force it is 1 if the gap is closed
  /// between nodes, because the mesh then misses a force.
  double part(const Oscillation &found, const double size, const double dA) const
  {
    if (force == 0.)
      return found.least < -closed_part * size ? 1. : 0.;
    if (found.least > closed_part * size)
      return 0.;
    const double q = modulus / 2. * found.slope / (force / contact_area);
    return (std::pow(1. + q, peak_power) - 1.) / peak_power * dA / contact_area;
  }
};
} // namespace

template <int dim>
std::vector<RoughPressure> rough_pressures(const state::StateSolver<dim>  &solver,
                                           const state::ContactState<dim> &state)
{
  const auto      &mesh    = solver.mesh();
  const auto      &surface = solver.surface();
  const auto      &contact = solver.contact(state.load_case);
  const auto      &placed  = contact.placed_surface();
  const auto      &pairs   = contact.pairs();
  const auto      &at      = state.surface_positions;
  const auto       x       = placed.to_space(at);
  const auto       held    = placed.turned(solver.held().directions(surface, state.positions));
  const auto       rows    = contact.rows(at);
  FaceSampler<dim> sampler(mesh, state.positions, rough_degree);
  const std::vector<double>  none(mesh.cells().size(), 0.);
  std::vector<RoughPressure> result;
  for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      const PairInState<dim> pair(solver, state, rows, p);
      const auto             given = contact.point_gaps(p, x, held);
      RoughPressure          rough{pairs[p].name(), 0., none, none};
      throw_collectively(mesh.communicator(),
                         std::bind(&PairInState<dim>::add, &pair, std::cref(*given),
                                   std::ref(sampler), std::ref(rough)));
      rough.missed = dealii::Utilities::MPI::sum(rough.missed, mesh.communicator());
      result.push_back(std::move(rough));
    }
  return result;
}

template <int dim>
Unresolved unresolved_gaps(const state::StateSolver<dim>  &solver,
                           const state::ContactState<dim> &state,
                           const double                    share)
{
  Unresolved result;
  for (const auto &rough : rough_pressures(solver, state))
    if (rough.missed > share)
      {
        add_cells(solver.mesh(), rough.to_refine, rough.missed, share, result);
        result.lines.push_back("the mesh does not resolve the gap of '" + rough.pair +
                               "': details smaller than its faces would change the pressure by " +
                               percent(rough.missed));
      }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                            \
  template std::vector<UnseenVolume>  unseen_volumes(const mesh::BodyMesh<dim> &);       \
  template std::vector<RoughPressure> rough_pressures(const state::StateSolver<dim> &,   \
                                                      const state::ContactState<dim> &); \
  template Unresolved                 unresolved_gaps(const state::StateSolver<dim> &,   \
                                                      const state::ContactState<dim> &, double);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::accuracy
