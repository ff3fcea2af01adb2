#include <snug/advice/advice.h>
#include <snug/advice/point_data.h>
#include <snug/elasticity/element.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace snug::advice {
namespace {
/// Shares of a region of a body in the whole, of energies and errors the largest of all load cases.
struct Region
{
  unsigned int body;
  std::string  name;
  double       cells = 0., energy = 0., error = 0.;
  double       inner = 0.; ///< cells that have no face in contact, which feels their size
};

template <int dim>
class NeedlessCells
{
public:
  explicit NeedlessCells(const Subject<dim> &subject)
    : subject(subject), mesh(subject.mesh()), bodies(mesh), data(subject, bodies)
  {
    find_regions();
  }

  std::vector<Advice> advice() const
  {
    std::vector<Advice>    result;
    std::set<unsigned int> rigid;
    for (unsigned int b = 0; b < mesh.n_bodies(); ++b)
      {
        double energy = 0., cells = 0.;
        for (const auto &region : regions)
          if (region.body == b)
            {
              energy += region.energy;
              cells += region.cells;
            }
        if (energy / (1. - energy) <= 0.3 * subject.target && mesh.n_bodies() > 1 &&
            !is_loaded(b) && !is_watched(b) && is_held(b))
          {
            result.push_back(rigid_body(b, energy, cells));
            rigid.insert(b);
          }
      }
    const double worth = 0.05; // of the cells
    for (const auto &region : regions)
      if (rigid.count(region.body) == 0 && region.inner >= worth &&
          region.energy <= 1e-3 * subject.target && region.error <= 1e-2 &&
          !is_watched(region.body))
        result.push_back(idle_region(region));
    return result;
  }

private:
  using Vector = dealii::Tensor<1, dim>;

  /// A body that gives little: driven by displacements, forces rise by s / (1 - s), s its share in
  /// the energy; driven by forces, pressures of Hertz's contact by half or a third of s.
  Advice rigid_body(const unsigned int body, const double energy, const double cells) const
  {
    const bool in_a_line = dim == 2 && !mesh.idealization().is_axisymmetric();
    bool       forces    = false;
    for (unsigned int b = 0; b < mesh.n_bodies(); ++b)
      forces = forces || is_loaded(b);
    std::ostringstream text;
    text << "body " << subject.model().body_names[body] << " has " << 100. * energy
         << " % of the strain energy: an obstacle of its shape would do";
    return {"rigid body", text.str(), 1. / (1. - cells),
            forces ? energy / (in_a_line ? 2. : 3.) : energy / (1. - energy)};
  }

  Advice idle_region(const Region &region) const
  {
    std::ostringstream text;
    text << "region " << region.name << " of body " << subject.model().body_names[region.body]
         << " has " << 100. * region.inner << " % of the cells away from contact, but "
         << 100. * region.energy
         << " % of the strain energy: coarser cells would do there, but not on faces in contact";
    return {"idle region", text.str(), 1. / (1. - region.inner * (1. - std::pow(2., -dim))),
            region.energy};
  }

  /// u'Ku / 2 of a cell.
  double energy(const typename mesh::BodyMesh<dim>::Cell &cell,
                const state::ContactState<dim>           &state) const
  {
    const auto         &of_body = subject.model().bodies[cell.body];
    std::vector<Vector> X, u, r(cell.nodes.size());
    for (const unsigned int node : cell.nodes)
      {
        X.push_back(state.positions[node]);
        u.push_back(state.displacement[node]);
      }
    elasticity::Element<dim>(mesh.degree(), mesh.idealization(), of_body.formulation)
      .internal_force(X, of_body.material(cell), u, r);
    double sum = 0.;
    for (unsigned int a = 0; a < u.size(); ++a)
      sum += 0.5 * (u[a] * r[a]);
    return sum;
  }

  /// Collective.
  void find_regions()
  {
    std::vector<unsigned int> first;
    for (unsigned int b = 0; b < mesh.n_bodies(); ++b)
      {
        first.push_back(regions.size());
        for (const auto &name : mesh.geometry(b).region_names())
          regions.push_back({b, name});
      }
    std::vector<bool> in_contact(mesh.cells().size(), false);
    const auto        sides = contact::boundaries_of(subject.model().pairs);
    for (const auto &face : mesh.boundary_faces())
      if (std::binary_search(sides.begin(), sides.end(),
                             contact::Boundary(face.body, face.boundary)))
        in_contact[face.cell] = true;
    const unsigned int all = 4 * regions.size(); // where the sums of all begin
    for (unsigned int c = 0; c < subject.states.size(); ++c)
      {
        std::vector<double> sums(all + 4, 0.);
        for (unsigned int i = 0; i < mesh.cells().size(); ++i)
          {
            const auto  &cell     = mesh.cells()[i];
            const double eta      = subject.estimates[c].cells[i];
            const double values[] = {1., energy(cell, subject.states[c]), eta * eta,
                                     in_contact[i] ? 0. : 1.};
            for (const unsigned int at : {4 * (first[cell.body] + cell.region), all})
              for (unsigned int k = 0; k < 4; ++k)
                sums[at + k] += values[k];
          }
        dealii::Utilities::MPI::sum(sums, mesh.communicator(), sums);
        for (unsigned int r = 0; r < regions.size(); ++r)
          {
            const auto share = [&](const unsigned int k, const double of) {
              return of > 0. ? sums[4 * r + k] / of : 1.;
            };
            regions[r].cells  = share(0, sums[all]);
            regions[r].energy = std::max(regions[r].energy, share(1, sums[all + 1]));
            regions[r].error  = std::max(regions[r].error, share(2, sums[all + 2]));
            regions[r].inner  = share(3, sums[all]);
          }
      }
  }

  /// Return whether a response or a shape is on the body.
  bool is_watched(const unsigned int body) const
  {
    const auto &scene = subject.scene;
    const auto &name  = scene.bodies[body].name;
    const auto  on = [&](const std::string &face) { return scene::split_face(face).first == name; };
    for (const auto &shape : scene.shapes)
      if (shape.moves() &&
          (on(shape.face) || std::count(shape.bodies.begin(), shape.bodies.end(), name) > 0))
        return true;
    auto asked = scene.responses;
    if (scene.task != scene::Task::state)
      asked.push_back(*scene::response_called(scene, scene.optimization.objective));
    for (const auto &response : asked)
      {
        const bool everywhere = response.body.empty();
        if (response.body == name || on(response.face) ||
            (everywhere && response.quantity.find("Mises") != std::string::npos))
          return true;
        if (!response.point.empty() && everywhere)
          if (const auto at = bodies.find(contact::to_point<dim>(response.point), {}))
            if (at->body == body)
              return true;
      }
    return false;
  }

  bool is_loaded(const unsigned int body) const
  {
    for (const auto &load_case : subject.model().load_cases)
      {
        const auto &loads = load_case.bodies[body];
        if (loads.body_force || !loads.boundaries.empty())
          return true;
        for (const auto &material : subject.model().bodies[body].materials)
          if (material.density * loads.gravity.norm() > 0.)
            return true;
      }
    return false;
  }

  /// Rigid motions at a point, turns by a radian at the distance of the size of all bodies.
  std::vector<Vector> rigid_motions(const dealii::Point<dim> &x) const
  {
    const bool          axisymmetric = mesh.idealization().is_axisymmetric();
    std::vector<Vector> result;
    for (unsigned int d = axisymmetric ? 1 : 0; d < dim; ++d)
      {
        result.emplace_back();
        result.back()[d] = 1.;
      }
    const Vector y = (x - data.surface().front().x) / bodies.size();
    for (unsigned int i = 0; i < dim && !axisymmetric; ++i)
      for (unsigned int j = i + 1; j < dim; ++j)
        {
          result.emplace_back();
          result.back()[i] = -y[j];
          result.back()[j] = y[i];
        }
    return result;
  }

  /// Return whether the supports of the body prevent all rigid motions: the sum of r_i . P r_j over
  /// points is regular, where P projects on the supported directions.
  bool is_held(const unsigned int body) const
  {
    const unsigned int               n = mesh.idealization().n_rigid_motions();
    dealii::LAPACKFullMatrix<double> A(n);
    A = 0.;
    for (const auto &at : data.surface())
      if (at.body == body)
        {
          const auto P = data.held(at);
          const auto r = rigid_motions(at.x);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              A(i, j) += r[i] * (P * r[j]);
        }
    A.compute_svd();
    return A.singular_value(n - 1) > 1e-6;
  }

  const Subject<dim>        &subject;
  const mesh::BodyMesh<dim> &mesh;
  const TrueBodies<dim>      bodies;
  const PointData<dim>       data;
  std::vector<Region>        regions;
};
} // namespace

template <int dim>
std::vector<Advice> needless_cells(const Subject<dim> &subject)
{
  return NeedlessCells<dim>(subject).advice();
}

template std::vector<Advice> needless_cells(const Subject<2> &);
template std::vector<Advice> needless_cells(const Subject<3> &);
} // namespace snug::advice
