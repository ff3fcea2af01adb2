#include <snug/advice/conditions.h>
#include <snug/elasticity/element.h>
#include <snug/state/rigid_modes.h>
#include <snug/state/thermal.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace snug::advice {
namespace {
/// A region of a body with its parts of the whole model. Parts of energies and errors are the
/// maxima of all load cases.
struct Region
{
  unsigned int body;
  std::string  name;
  double       cells = 0., energy = 0., error = 0.;
  double       inner = 0.; ///< cells without a face in contact, whose size contact does not see
};

/// Return the elastic energy of a cell, u'Ku / 2 without the thermal strain.
template <int dim>
double strain_energy(const AdviceInput<dim>                   &input,
                     const typename mesh::BodyMesh<dim>::Cell &cell,
                     const state::ContactState<dim>           &state)
{
  const auto                         &body = input.model().bodies[cell.body];
  std::vector<dealii::Tensor<1, dim>> X_0, X, u, r(cell.nodes.size());
  for (const unsigned int node : cell.nodes)
    {
      X_0.push_back(input.mesh().reference_positions()[node]);
      X.push_back(state.positions[node]);
      u.push_back(state.displacement[node]);
    }
  const elasticity::Element<dim> element(input.mesh().degree(), input.mesh().idealization(),
                                         body.formulation);
  element.internal_force(X, body.material(cell), u, r);
  double sum = 0.;
  for (unsigned int a = 0; a < u.size(); ++a)
    sum += 0.5 * (u[a] * r[a]);
  if (const auto strain =
        state::thermal_strain<dim>(input.model().load_cases[state.load_case].bodies[cell.body],
                                   body.material(cell), X_0))
    {
      element.thermal_force(X, body.material(cell), strain, r);
      for (unsigned int a = 0; a < u.size(); ++a)
        sum -= u[a] * r[a];
      sum += element.thermal_energy(X, body.material(cell), strain);
    }
  return sum;
}

/// Return the cells of this rank that have no face in contact.
template <int dim>
std::vector<bool> inner_cells(const AdviceInput<dim> &input)
{
  std::vector<bool> result(input.mesh().cells().size(), true);
  const auto        sides = contact::boundaries_of(input.model().pairs);
  for (const auto &face : input.mesh().boundary_faces())
    if (std::binary_search(sides.begin(), sides.end(), contact::Boundary(face.body, face.boundary)))
      result[face.cell] = false;
  return result;
}

/// Return all regions, body by body. Collective.
template <int dim>
std::vector<Region> find_regions(const AdviceInput<dim> &input)
{
  const auto               &mesh = input.mesh();
  std::vector<Region>       regions;
  std::vector<unsigned int> first; // region of each body
  for (unsigned int b = 0; b < mesh.n_bodies(); ++b)
    {
      first.push_back(regions.size());
      for (const auto &name : mesh.geometry(b).region_names())
        regions.push_back({b, name});
    }
  const auto         is_inner = inner_cells(input);
  const unsigned int n = 4, whole = n * regions.size(); // four sums per region, then of the whole
  for (unsigned int c = 0; c < input.states.size(); ++c)
    {
      std::vector<double> sums(whole + n, 0.);
      for (unsigned int i = 0; i < mesh.cells().size(); ++i)
        {
          const auto  &cell     = mesh.cells()[i];
          const double eta      = input.estimates[c].cells[i];
          const double values[] = {1., strain_energy(input, cell, input.states[c]), eta * eta,
                                   is_inner[i] ? 1. : 0.};
          for (const unsigned int at : {n * (first[cell.body] + cell.region), whole})
            for (unsigned int k = 0; k < n; ++k)
              sums[at + k] += values[k];
        }
      dealii::Utilities::MPI::sum(sums, mesh.communicator(), sums);
      for (unsigned int r = 0; r < regions.size(); ++r)
        {
          const auto part = [&](const unsigned int k, const double of) {
            return of > 0. ? sums[n * r + k] / of : 1.;
          };
          regions[r].cells  = part(0, sums[whole]);
          regions[r].energy = std::max(regions[r].energy, part(1, sums[whole + 1]));
          regions[r].error  = std::max(regions[r].error, part(2, sums[whole + 2]));
          regions[r].inner  = part(3, sums[whole]);
        }
    }
  return regions;
}

/// Return whether a response or a shape is on the body. Responses at a point without a body may be
/// on any body.
bool has_response_or_shape(const scene::Scene &scene, const std::string &body)
{
  const auto on = [&](const std::string &face) { return scene::split_face(face).first == body; };
  for (const auto &shape : scene.shapes)
    if (shape.moves() &&
        (on(shape.face) || std::count(shape.bodies.begin(), shape.bodies.end(), body) > 0))
      return true;
  auto responses = scene.responses;
  if (scene.task != scene::Task::state)
    responses.push_back(*scene::response_called(scene, scene.optimization.objective));
  return std::any_of(responses.begin(), responses.end(), [&](const auto &response) {
    const bool at_points =
      !response.point.empty() || response.quantity.find("Mises") != std::string::npos;
    return response.body == body || on(response.face) || (response.body.empty() && at_points);
  });
}

template <int dim>
bool is_loaded(const state::Model<dim> &model, const unsigned int body)
{
  for (const auto &load_case : model.load_cases)
    {
      const auto &loads = load_case.bodies[body];
      if (loads.body_force || loads.temperature || !loads.boundaries.empty())
        return true;
      for (const auto &material : model.bodies[body].materials)
        if (material.density * loads.gravity.norm() > 0.)
          return true;
    }
  return false;
}

/// Return whether supports hold all rigid motions R of a body: the sum of R' P R over points is
/// regular, with the projector P on the held directions. Collective.
template <int dim>
bool is_held(const AdviceInput<dim> &input, const unsigned int body)
{
  const Conditions<dim> conditions(input);
  const auto           &idealization = input.mesh().idealization();
  const unsigned int    n            = idealization.n_rigid_motions();
  std::vector<double>   sums(n * n, 0.);
  for (const auto &at : conditions.on_faces())
    if (at.body == body)
      {
        const auto P = conditions.held(at);
        const auto R =
          state::rigid_motions<dim>(idealization, {at.x}, conditions.centre(), conditions.size());
        for (unsigned int ij = 0; ij < n * n; ++ij)
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int l = 0; l < dim; ++l)
              sums[ij] += R(k, ij / n) * P[k][l] * R(l, ij % n);
      }
  dealii::Utilities::MPI::sum(sums, input.mesh().communicator(), sums);
  dealii::LAPACKFullMatrix<double> A(n);
  for (unsigned int ij = 0; ij < n * n; ++ij)
    A(ij / n, ij % n) = sums[ij];
  A.compute_svd();
  return A.singular_value(n - 1) > 1e-6;
}

/// The strain energy of a body is the part @p energy of the whole. If displacements drive the
/// model, a rigid body changes forces by energy / (1 - energy). If forces drive the model, it
/// changes the pressures of Hertz contacts by a half (lines) or a third (points) of @p energy.
template <int dim>
Advice rigid_body(const AdviceInput<dim> &input,
                  const std::string      &name,
                  const double            energy,
                  const double            cells,
                  const bool              has_loads)
{
  const bool         is_line_contact = dim == 2 && !input.mesh().idealization().is_axisymmetric();
  std::ostringstream text;
  text << "body " << name << " has " << 100. * energy
       << " % of the strain energy: an obstacle of its shape would do";
  return {"rigid body", text.str(), 1. / (1. - cells),
          has_loads ? energy / (is_line_contact ? 2. : 3.) : energy / (1. - energy)};
}

template <int dim>
Advice unstressed_region(const Region &region, const std::string &body)
{
  std::ostringstream text;
  text << "region " << region.name << " of body " << body << " has " << 100. * region.inner
       << " % of the cells away from contact, but " << 100. * region.energy
       << " % of the strain energy: coarser cells would do there, but not on faces in contact";
  return {"unstressed region", text.str(), 1. / (1. - region.inner * (1. - std::pow(2., -dim))),
          region.energy};
}
} // namespace

template <int dim>
std::vector<Advice> unstressed_regions(const AdviceInput<dim> &input)
{
  const double least_cells = 0.05, largest_error = 1e-2;
  const auto  &model     = input.model();
  const auto   regions   = find_regions(input);
  bool         has_loads = false;
  for (unsigned int b = 0; b < model.bodies.size(); ++b)
    has_loads = has_loads || is_loaded(model, b);
  std::vector<Advice>    result;
  std::set<unsigned int> rigid;
  for (unsigned int b = 0; b < model.bodies.size(); ++b)
    {
      double energy = 0., cells = 0.;
      for (const auto &region : regions)
        if (region.body == b)
          {
            energy += region.energy;
            cells += region.cells;
          }
      if (energy / (1. - energy) > 0.3 * input.target || model.bodies.size() == 1 ||
          is_loaded(model, b) || has_response_or_shape(input.scene, model.body_names[b]) ||
          !is_held(input, b))
        continue;
      result.push_back(rigid_body(input, model.body_names[b], energy, cells, has_loads));
      rigid.insert(b);
    }
  for (const auto &region : regions)
    if (rigid.count(region.body) == 0 && region.inner >= least_cells &&
        region.energy <= 1e-3 * input.target && region.error <= largest_error &&
        !has_response_or_shape(input.scene, model.body_names[region.body]))
      result.push_back(unstressed_region<dim>(region, model.body_names[region.body]));
  return result;
}

template std::vector<Advice> unstressed_regions(const AdviceInput<2> &);
template std::vector<Advice> unstressed_regions(const AdviceInput<3> &);
} // namespace snug::advice
