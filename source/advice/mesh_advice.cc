#include <snug/advice/advice.h>
#include <snug/state/assumptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::advice {
namespace {
/// Whether the scene asks for what the estimate of the energy says nothing of.
bool asks_for_more(const scene::Scene &scene)
{
  std::vector<std::string> asked;
  for (const auto &response : scene.responses)
    asked.push_back(response.quantity);
  if (scene.task != scene::Task::state)
    asked.push_back(scene::response_called(scene, scene.optimization.objective)->quantity);
  return std::any_of(asked.begin(), asked.end(), [](const std::string &quantity) {
    return quantity.find("pressure") != std::string::npos ||
           quantity.find("Mises") != std::string::npos || quantity == "contact area";
  });
}

/// How many faces wide contact is where it is narrowest, of all load cases; all of a side: as many
/// as its rows say.
template <int dim>
double contact_width(const Subject<dim> &subject)
{
  double width = std::numeric_limits<double>::infinity();
  for (const auto &state : subject.states)
    {
      width = std::min(width, state.assumptions.width);
      for (const auto &pair : state.pairs)
        if (pair.active_contacts > 0)
          width = std::min(width, std::pow(pair.active_contacts, 1. / (dim - 1)));
    }
  return width;
}

/// Errors of energies are squares of those in the energy norm and grow by 4^p from mesh to mesh
/// where nothing is singular. The coarser mesh is to be trusted as well.
template <int dim>
void add_finer(const Subject<dim> &subject, std::vector<Advice> &advice)
{
  const double       relative = subject.largest_error();
  const unsigned int p        = subject.mesh().degree();
  const double       coarser  = std::pow(4., p) * relative * relative;
  if (relative == 0. || coarser > 0.8 * subject.target || asks_for_more(subject.scene) ||
      contact_width(subject) < 2. * subject.scene.accuracy.contact_faces * p)
    return;
  std::ostringstream text;
  text << "the estimated error of the energy is " << 100. * relative * relative
       << " %: cells of twice the size would do";
  advice.push_back({"mesh finer than needed", text.str(), std::pow(2., dim), coarser});
}

template <int dim>
void add_facets(const Subject<dim> &subject, std::vector<Advice> &advice)
{
  double height = 0., closed = 1.;
  for (const auto &state : subject.states)
    if (const auto &found = state.assumptions;
        found.facet_height * closed > height * found.closed_gap)
      {
        height = found.facet_height;
        closed = found.closed_gap;
      }
  if (height <= state::large_facets * closed)
    return;
  std::ostringstream text;
  text << "contact sees facets " << height << " high, and the largest gap or overlap it closes is "
       << closed
       << ": set 'Surface' = smooth for these boundaries of mesh files, or take a finer file";
  advice.push_back({"facets", text.str(), 1., height / closed});
}

/// Outer normals of the boundaries of this rank that meet at one of the nodes.
template <int dim>
std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>>
boundaries_at(const Subject<dim>                        &subject,
              const typename mesh::BodyMesh<dim>::Field &x,
              const contact::Side                       &side,
              const std::function<bool(unsigned int)>   &is_near)
{
  const auto               &mesh = subject.mesh();
  std::vector<unsigned int> nodes; // on the side
  const auto                for_faces = [&](const auto &act) {
    for (const auto &face : mesh.boundary_faces())
      if (face.body == side.body())
        act(face);
  };
  for_faces([&](const auto &face) {
    if (contact::is_on(face, side))
      std::copy_if(face.nodes.begin(), face.nodes.end(), std::back_inserter(nodes), is_near);
  });
  std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> result;
  for_faces([&](const auto &face) {
    if (std::none_of(face.nodes.begin(), face.nodes.end(), [&](unsigned int node) {
          return std::count(nodes.begin(), nodes.end(), node) > 0;
        }))
      return;
    const unsigned int           p = mesh.degree(), n = face.nodes.size();
    const dealii::Tensor<1, dim> t1 = x[face.nodes[p]] - x[face.nodes[0]];
    dealii::Tensor<1, dim>       normal;
    if constexpr (dim == 2)
      normal = dealii::Point<dim>(t1[1], -t1[0]);
    else
      normal = dealii::cross_product_3d(t1, x[face.nodes[n - p - 1]] - x[face.nodes[0]]);
    result.push_back({face.boundary, normal / normal.norm()});
  });
  return result;
}

/// Whether a side ends at the points that is_near() names in an edge of its body, and not where
/// a support, as of a symmetry plane, says that it goes on.
template <int dim>
bool has_edge(const Subject<dim>                        &subject,
              const typename mesh::BodyMesh<dim>::Field &x,
              const contact::Side                       &side,
              const std::function<bool(unsigned int)>   &is_near)
{
  const auto found   = boundaries_at(subject, x, side, is_near);
  const auto is_held = [&](const auto &boundary) {
    return std::any_of(subject.model().supports.begin(), subject.model().supports.end(),
                       [&](const auto &support) {
                         return support.body == side.body() && support.boundary == boundary.first &&
                                (support.component == dim ||
                                 std::abs(boundary.second[support.component]) > 0.9);
                       });
  };
  bool       result = false;
  const bool axis   = subject.mesh().idealization().is_axisymmetric();
  for (const auto &own : found)
    for (const auto &other : found)
      result =
        result ||
        (side.has({side.body(), own.first}) && !side.has({side.body(), other.first}) &&
         own.second * other.second < 0.8 && !is_held(other) && !(axis && other.second[0] < -0.9));
  return dealii::Utilities::MPI::max(int(result), subject.mesh().communicator()) == 1;
}

/// A peak far above the mean on a sharp edge, of either side, has no limit as cells get smaller.
template <int dim>
void add_corners(const Subject<dim> &subject, std::vector<Advice> &advice)
{
  const double far_above = 1.3;
  for (const auto &joined : subject.solver.contact().joined_pairs())
    for (const auto &state : subject.states)
      {
        // Of the pairs of the scene that are joined, that with the peak.
        const auto &pair = joined.pair;
        auto        of   = state.pairs[joined.parts.front().pair];
        for (const auto &part : joined.parts)
          if (state.pairs[part.pair].max_pressure > of.max_pressure)
            of = state.pairs[part.pair];
        if (of.active_contacts == 0 ||
            of.max_pressure * of.contact_area < far_above * of.force.norm())
          continue;
        const auto near = [&](const double faces) {
          return [&, faces](const unsigned int node) {
            return (state.positions[node] - of.peak).norm() <= faces * of.peak_size;
          };
        };
        const bool of_slave  = has_edge<dim>(subject, state.positions, pair.slave, near(1e-6)),
                   of_master = !pair.obstacle &&
                               has_edge<dim>(subject, state.positions, pair.master, near(0.6));
        if (of_slave == of_master) // both: they end together, as one body would
          continue;
        std::ostringstream text;
        text << "the largest pressure of '" << pair.name() << "' is at a sharp edge of "
             << (of_slave ? pair.slave_name : pair.master_name)
             << " and grows without limit as cells get smaller: round the edge, or trust energies "
                "and forces alone";
        advice.push_back({"corner", text.str()});
        break;
      }
}
} // namespace

template <int dim>
std::vector<Advice> mesh_advice(const Subject<dim> &subject)
{
  std::vector<Advice> advice;
  add_finer(subject, advice);
  add_facets(subject, advice);
  add_corners(subject, advice);
  return advice;
}

template std::vector<Advice> mesh_advice(const Subject<2> &);
template std::vector<Advice> mesh_advice(const Subject<3> &);
} // namespace snug::advice
